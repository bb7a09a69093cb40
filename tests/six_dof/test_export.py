"""An exported aircraft: plain JSBSim loads and flies it from its script; licences are told."""

import csv
import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest

from ftc_jsb.six_dof.aircraft import load_aircraft
from ftc_jsb.six_dof.export import export
from ftc_jsb.units import FOOT, POUND_FORCE
from tests.test_cli import assert_refused, run


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
    """Each step is there 2 s later: load factor to 0.01, bank to 0.5 deg, thrust to 0.5 %; trim held."""
    out = columns(path)
    time = out["Time"]
    assert time[-1] == pytest.approx(40.0, abs=0.1)
    settled = time > 0.2  # trimmed in the first frame
    for k in range(1, time.size):
        if (out["ftc/command/load-factor"][max(0, k - 40) : k + 1].std() > 0) or not settled[k]:
            settled[k] = False  # 2 s at 20 Hz
    assert settled.sum() > 400
    n = out["ftc/load-factor/actual"] - out["ftc/command/load-factor"]
    assert np.abs(n[settled]).max() < 0.01
    bank = np.degrees(out["ftc/bank/actual"] - out["ftc/command/bank-rad"])
    assert np.abs(bank[settled]).max() < 0.5
    for when in (5.9, 21.9, 32.9, 39.9):
        at = np.argmin(np.abs(time - when))
        thrust = out["propulsion/engine/thrust-lbs"][at] * POUND_FORCE
        assert thrust == pytest.approx(out["ftc/command/thrust-n"][at], rel=0.005)
    assert np.ptp(out["ftc/command/thrust-n"][time > 2.0]) > 10e3
    before = (time > 0.5) & (time < 2.9)
    assert np.ptp(out["velocities/vt-fps"][before]) * FOOT < 0.1  # [m/s]


def test_jsbsims_own_command_flies_the_script(folder):
    """`jsbsim --root=. --script=...`, at the script's 200 Hz and at the command's own 120 Hz."""
    command = Path(sys.executable).parent / "jsbsim"
    for extra in (["--simulation-rate=200"], []):
        output = folder / "f16.csv"
        output.unlink(missing_ok=True)
        subprocess.run(
            [command, "--root=.", "--script=scripts/f16.xml", *extra],
            cwd=folder, capture_output=True, timeout=60, check=True,
        )  # fmt: skip
        assert_flown_as_scripted(output)


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
    own = {"ftc_inner_loop.xml", "ftc_engine_deck.xml", "ftc_level.xml"}
    for part in ("aircraft", "engine", "systems"):
        for path in (folder / part).rglob("*.xml"):
            assert path.name in own or f"\n{path.relative_to(folder)}\n" in notice
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
