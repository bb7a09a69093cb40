"""Where kernels are cached, and that they do the same with the compiler switched off."""

import os
import subprocess
import sys
from typing import Any, NamedTuple

import numba
import numpy as np
import platformdirs
import pytest

from ftc_jsb.compiled import compiled, direct, is_first_run
from ftc_jsb.kernel_cache import kernel_folders
from ftc_jsb.sources import PACKAGE

LEVELS = np.dtype([("gain", float), ("steps", int, (2,))], align=True)
ROW = np.dtype([("speed", float), ("levels", LEVELS), ("ratio", float)], align=True)


class Bundle(NamedTuple):
    """As kernels are given what belongs together."""

    rows: Any  # (n,) ROW
    scale: float


def _fill(bundle: Any, i: int) -> float:
    row = bundle.rows[i]
    row.levels.steps[1] += 2
    row.levels.gain = bundle.scale * row.speed
    row.ratio = row.speed / row.levels.steps[0]
    return row.levels.gain


def _twice(bundle: Any) -> float:
    return FILL(bundle, 0) + FILL(bundle, 1)


FILL = compiled(_fill)


@pytest.fixture
def caches(tmp_path, monkeypatch):
    """Caches in a folder of this test's own."""
    monkeypatch.setattr(platformdirs, "user_cache_dir", lambda name: str(tmp_path / name))
    monkeypatch.setattr("tempfile.tempdir", str(tmp_path / "temporary"))
    return tmp_path / "ftc-jsb"


@pytest.fixture
def switched_off(monkeypatch):
    monkeypatch.setattr(numba.config, "DISABLE_JIT", True)


def test_cache_is_in_the_users_folder_and_one_for_each_module(caches):
    one = next(kernel_folders("ftc_jsb.frames"))
    other = next(kernel_folders("ftc_jsb.simulation.sample"))
    assert one != other
    assert one.parent == other.parent == caches / "kernels"


def test_first_run_is_one_until_something_is_compiled(caches, monkeypatch):
    monkeypatch.setattr(numba.config, "DISABLE_JIT", False)
    assert is_first_run("ftc_jsb.frames")
    folder = next(kernel_folders("ftc_jsb.frames"))
    folder.mkdir(parents=True)
    (folder / "a.kernel").touch()
    assert not is_first_run("ftc_jsb.frames")


def test_nothing_is_compiled_where_the_compiler_is_switched_off(caches, switched_off):
    assert not is_first_run("ftc_jsb.frames")


def rows() -> Any:
    made = np.zeros(2, ROW)
    made["speed"] = 3.0, -5.0
    made["levels"]["steps"][1, 0] = 4
    return made


def test_kernel_does_the_same_with_the_compiler_switched_off(switched_off, monkeypatch):
    """Fields as attributes, nested and inside a NamedTuple; 3 / 0 is inf, and no warning."""
    plain = compiled(_fill)
    monkeypatch.setitem(globals(), "FILL", plain)
    seen = rows()
    assert compiled(_twice)(Bundle(seen, 2.0)) == 6.0 - 10.0
    assert direct(plain, Bundle(seen, 2.0), 0) is plain
    expected = rows()
    expected["levels"]["gain"] = 6.0, -10.0
    expected["levels"]["steps"][:, 1] = 2
    expected["ratio"] = np.inf, -1.25
    np.testing.assert_array_equal(seen, expected)


def test_entry_point_is_the_kernel():
    """Compiled, too, 3 / 0 is inf."""
    bundle = Bundle(rows(), 2.0)
    assert direct(FILL, bundle, 0)(bundle, 0) == 6.0
    assert bundle.rows["ratio"][0] == np.inf


def test_kernel_that_fails_leaves_the_next_one_the_outermost(switched_off):
    plain = compiled(_fill)
    with pytest.raises(IndexError):
        plain(Bundle(rows(), 2.0), 7)
    assert plain(Bundle(rows(), 2.0), 0) == 6.0


def test_field_that_is_none_is_refused(switched_off):
    with pytest.raises(ValueError, match="sped"):
        compiled(lambda row: row.sped)(rows()[0])


FLIGHT = """
from ftc_jsb.scenario.load import load_scenario
from ftc_jsb.simulation.fly import fly
flight = fly(load_scenario("severe", ["model={model}", "loop.name=robust", "duration=9"]))
print(flight.outcome.status, flight.record.tobytes().hex())
"""


@pytest.mark.parametrize("model", ["paper", "identified"])
def test_flight_is_the_same_with_the_compiler_switched_off(model):
    """A fault at 8 s found by the filter; the same but for the last bits of sin, cos and pow: 1e-9."""
    records = []
    for switch in ("0", "1"):
        shown = subprocess.run(
            [sys.executable, "-c", FLIGHT.format(model=model)],
            cwd=PACKAGE.parent, env={**os.environ, "NUMBA_DISABLE_JIT": switch},
            capture_output=True, text=True, check=True,
        )  # fmt: skip
        status, data = shown.stdout.split()
        assert status == "complete"
        records.append(np.frombuffer(bytes.fromhex(data)))
    np.testing.assert_allclose(records[0], records[1], rtol=1e-9, atol=1e-12)
