"""An exported aircraft: plain JSBSim loads and flies it from its script; licences are told."""

import csv
import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest

from ftc_jsb.aircraft.description import load_aircraft
from ftc_jsb.export.aircraft_folder import export
from ftc_jsb.units import FOOT, POUND_FORCE
from tests.cli.command import assert_refused, run


@pytest.fixture(scope="module")
def folder(tmp_path_factory):
    where = tmp_path_factory.mktemp("exported") / "f16"
    where.mkdir()
    export(load_aircraft("f16"), True, where)
    return where


def columns(path: Path) -> dict[str, np.ndarray]:
    with path.open() as file:
        names, *rows = csv.reader(file)
    values = np.array(rows, dtype=float).T
    return {name.removeprefix("/fdm/jsbsim/"): values[k] for k, name in enumerate(names)}


def assert_flown_as_scripted(path: Path) -> None:
    """Just before the next step each command is there: load factor to 0.02 (the F-15's creeps by
    0.013 after 3 s), bank to 0.5 deg, thrust of all engines to 0.5 %; and the trim is held before the
    first (0.3 m/s in 2.5 s).
    """
    out = columns(path)
    time = out["Time"]
    assert time[-1] == pytest.approx(40.0, abs=0.1)
    thrust = sum(out[name] for name in out if name.endswith("thrust-lbs")) * POUND_FORCE
    commands = {"ftc/command/load-factor": set(), "ftc/command/bank-rad": set()}
    for when in (2.9, 5.9, 9.9, 21.9, 25.9, 32.9, 39.9):
        at = int(np.argmin(np.abs(time - when)))
        n = out["ftc/load-factor/actual"][at] - out["ftc/command/load-factor"][at]
        assert abs(n) < 0.02
        assert abs(np.degrees(out["ftc/bank/actual"][at] - out["ftc/command/bank-rad"][at])) < 0.5
        assert thrust[at] == pytest.approx(out["ftc/command/thrust-n"][at], rel=0.005)
        for name, seen in commands.items():
            seen.add(round(out[name][at], 3))
    assert commands["ftc/command/load-factor"] == {1.0, 1.5, 1.414}
    assert commands["ftc/command/bank-rad"] == {0.0, 0.785}
    assert np.ptp(out["ftc/command/thrust-n"][time > 2.0]) > 2e3
    before = (time > 0.5) & (time < 2.9)
    assert np.ptp(out["velocities/vt-fps"][before]) * FOOT < 0.3  # [m/s]


@pytest.mark.parametrize("name", ["f16", "f15", "F4N", "A4", "T38"])
def test_jsbsims_own_command_flies_every_fighter(name, tmp_path):
    """`jsbsim --root=. --script=...` at the script's 200 Hz."""
    export(load_aircraft(name), True, tmp_path)
    assert_flown_as_scripted(jsbsim_command(tmp_path, name, "--simulation-rate=200"))


def jsbsim_command(folder: Path, name: str, *extra: str) -> Path:
    """The CSV of JSBSim's own command on an exported aircraft."""
    output = folder / f"{name}.csv"
    output.unlink(missing_ok=True)
    subprocess.run(
        [Path(sys.executable).parent / "jsbsim", "--root=.", f"--script=scripts/{name}.xml", *extra],
        cwd=folder, capture_output=True, timeout=60, check=True,
    )  # fmt: skip
    return output


def test_script_flies_at_the_commands_own_120_hz(folder):
    assert_flown_as_scripted(jsbsim_command(folder, "f16"))


def test_python_of_the_readme_flies_it(folder):
    """The lines of README.txt, in a process that knows no ftc-jsb."""
    readme = (folder / "README.txt").read_text()
    lines = [line[4:] for line in readme.splitlines() if line.startswith("    ")][1:]
    (folder / "f16.csv").unlink(missing_ok=True)
    program = "\n".join(
        ["import jsbsim", *lines, "import sys; assert 'ftc_jsb' not in sys.modules"]
    )
    subprocess.run(
        [sys.executable, "-c", program], cwd=folder, capture_output=True, timeout=60, check=True
    )
    assert_flown_as_scripted(folder / "f16.csv")


def test_notice_quotes_what_the_installed_files_say(folder):
    """Author and licence of the F-16, of the engine; every file is named, changed or copied."""
    notice = (folder / "NOTICE").read_text()
    assert "license: GPL (General Public License) http://www.gnu.org/licenses/gpl.html" in notice
    assert "author: Erik Hofman" in notice
    assert "Author: Aero-Matic v 0.8" in notice
    changed, copied = notice.split("COPIED unchanged")
    assert "aircraft/f16/f16.xml" in changed
    assert "engine/F100-PW-229.xml" in changed
    assert "engine/direct.xml" in copied
    for part in ("aircraft", "engine", "systems"):
        for path in (folder / part).rglob("*.xml"):
            assert path.name.startswith("ftc_") or f"\n{path.relative_to(folder)}\n" in notice
    licence = (folder / "JSBSIM-LICENSE.txt").read_text()
    assert "GNU LESSER GENERAL PUBLIC LICENSE" in licence


def test_export_command_refuses_a_folder_that_is_not_empty(tmp_path):
    (tmp_path / "full").mkdir()
    (tmp_path / "full" / "mine.txt").write_text("mine")
    refused = run("export", "f16", "full", cwd=tmp_path)
    assert_refused(refused, "DIR full: is not empty", "--force")
    assert [path.name for path in (tmp_path / "full").iterdir()] == ["mine.txt"]
    done = run("export", "f16", "full", "--force", cwd=tmp_path)
    assert done.returncode == 0, done.stderr
    assert (tmp_path / "full" / "mine.txt").read_text() == "mine"
    assert (tmp_path / "full" / "scripts" / "f16.xml").is_file()
    assert_refused(run("export", "f99", "new", cwd=tmp_path), "no aircraft 'f99'")
    assert_refused(run("export", "paper", "new", cwd=tmp_path), "aircraft.toml: not found")
    assert not (tmp_path / "new").exists()
