"""`ftc-jsb theory` on a system that is not shipped, on one that is, and on files that are none."""

import json
from pathlib import Path

import netCDF4
import numpy as np
import pytest

from tests.cli.command import run

PAGE = Path(__file__).parents[2] / "docs" / "theory.md"


def test_example_of_the_page_is_analysed_and_flown(tmp_path):
    """The pendulum of docs/theory.md: index 2, G through tanh, no hidden state; with FTC the error after
    the loss is a tenth of that without, and the recordings hold it.
    """
    file = tmp_path / "pendulum.py"
    file.write_text(PAGE.read_text().split("```python")[1].split("```")[0])
    done = run("theory", str(file), "--out", str(tmp_path / "out"), cwd=tmp_path)
    assert done.returncode == 0, done.stderr
    assert "index of each output: 2" in done.stdout
    assert "tanh" in done.stdout
    found = json.loads((tmp_path / "out" / "theory.json").read_text())
    assert found["zero_dynamics"]["verdict"] == "none"
    assert found["bounds"]["gain"]["certified"]
    assert found["unbounded"] == []
    largest = {}
    for loop in ("ftc", "no-ftc"):
        with netCDF4.Dataset(tmp_path / "out" / f"{loop}.nc") as flight:
            late = flight["time"][:] > 7.0
            largest[loop] = np.abs(flight["error_0"][:][late]).max()
            if loop == "ftc":
                assert flight["effectiveness_u_est"][-1] == pytest.approx(0.7, abs=0.01)
    assert largest["ftc"] < 0.1 * largest["no-ftc"]
    assert (tmp_path / "out" / "theory.png").is_file()
    assert not (
        tmp_path / "out" / "theory.pdf"
    ).exists()  # with --print; half of the command's time


def test_flight_that_cannot_go_on_leaves_what_was_flown(tmp_path):
    """The same pendulum asked for more than its torque: 𝓖 goes to zero with tanh, on the way."""
    file = tmp_path / "pendulum.py"
    text = PAGE.read_text().split("```python")[1].split("```")[0]
    text = text.replace("(sp.sin(2 * TIME) / 2,)", "(sp.sin(2 * TIME) / 2 + TIME**3 / 20,)")
    limits = next(line for line in text.splitlines() if "conditions=" in line)
    file.write_text(text.replace(limits, ""))
    done = run("theory", str(file), "--out", str(tmp_path / "out"), cwd=tmp_path)
    assert done.returncode == 1, done.stderr
    found = json.loads((tmp_path / "out" / "theory.json").read_text())["flights"]["ftc"]
    assert "G of (14) is singular" in found["problem"]
    with netCDF4.Dataset(tmp_path / "out" / "ftc.nc") as flight:
        assert 0.1 < found["end_time"] < 14.0
        assert float(flight["time"][-1]) == found["end_time"]
        assert np.isfinite(flight["error_0"][:].filled(np.nan)).all()
    assert (tmp_path / "out" / "theory.png").is_file()


@pytest.mark.parametrize(
    ("text", "says"),
    [
        ("x = 1", "CASE is None; expected a ftc_jsb.theory.case.Case"),
        ("1 / 0", "ZeroDivisionError: division by zero"),
        (None, "no such case; expected a FILE.py or one of fighter, levitator"),
    ],
)
def test_file_that_is_no_case_is_one_sentence(tmp_path, text, says):
    file = tmp_path / "none.py"
    if text is not None:
        file.write_text(text)
    done = run("theory", str(file), "--out", str(tmp_path / "out"), cwd=tmp_path)
    assert done.returncode == 2
    assert says in done.stderr
    assert "Traceback" not in done.stderr
    assert not (tmp_path / "out").exists()
