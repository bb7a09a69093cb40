"""Whatever write, rename, fsync or read of the cache fails, finished files are whole and it runs again.

In the suite some points of `fly`; `make faults` has every point of `fly`, `compare`, `identify` and
`campaign`, each with a full disk, a disk that fails and a process that is killed.
"""

import os
import tomllib
from pathlib import Path

import pytest

from ftc_jsb.resources import shipped
from ftc_jsb.simulation.fly import fly
from tests.campaign.campaign_files import campaign_file
from tests.reliability.fault_injection import BEYOND, KINDS, damaged, run

EVERY = int(os.environ.get("FTC_JSB_FAULTS", "0"))  # every how manyth point is tried; 0 a few
FEW = 5  # points of a command in the suite
SENTENCE = (
    2,
    3,
)  # exit codes of what could not be done; 3 only where a library's own words are passed on


def _identified() -> None:
    """Identification has its flights behind it: what is tried here is what becomes of its result."""
    import ftc_jsb.identify.identification as identification

    text = (shipped("aircraft") / "f16" / "point_mass.toml").read_text()
    identification.identify = lambda *_: tomllib.loads(text)  # type: ignore[assignment]


def command(name: str, folder: Path) -> list[str]:
    out = ["--out", str(folder / "out"), "--force"]
    short = ["--set", "duration=2"]
    if name == "fly":
        return ["fly", "paper", *short, *out]
    if name == "compare":
        return ["compare", "paper", *short, "--set", "compare.models=['paper']", *out]
    if name == "identify":
        return ["identify", "f16", *out]
    path = campaign_file(folder, cases="4", overrides="{ duration = 6.0 }")
    return ["campaign", str(path), "--workers", "1", "--out", str(folder / "out"), "--resume"]


@pytest.mark.parametrize("kind", KINDS)
@pytest.mark.parametrize("name", ["fly", "compare", "identify", "campaign"])
def test_files_survive_whatever_fails(flown, tmp_path, name, kind):
    if not EVERY and name != "fly":
        pytest.skip("make faults")
    fly(flown("paper", "duration=2").scenario)  # kernels are there
    prepare = _identified if name == "identify" else lambda: None
    arguments, out = command(name, tmp_path), tmp_path / "out"
    folders = [out]
    whole = run(arguments, folders, "count", BEYOND, tmp_path, prepare)
    assert whole.code in (0, 1), whole.said
    assert damaged(out) == []
    before = sorted(str(p.relative_to(out)) for p in out.rglob("*") if p.is_file())
    points = range(1, whole.points + 1, EVERY or max(whole.points // FEW, 1))
    assert points
    for at in points:
        failed = run(arguments, folders, kind, at, tmp_path, prepare)
        if failed.points < at:  # another order of threads
            continue
        assert "Traceback" not in failed.said, (at, failed.said)
        if kind == "kill":
            assert failed.code == -9
        else:
            assert failed.code in (0, 1, *SENTENCE), (at, failed)
        assert damaged(out) == [], (at, failed)
        again = run(arguments, folders, "count", BEYOND, tmp_path, prepare)
        assert again.code == whole.code, (at, again.said)
        assert damaged(out) == []
        now = [str(p.relative_to(out)) for p in out.rglob("*") if p.is_file()]
        assert set(before) <= set(now)
        assert not [name for name in now if name.endswith(".part")], at
    print(f"{name}, {kind}: {len(points)} of {whole.points} points injected, all survived")
