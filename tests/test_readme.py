"""The figures of README's table are what its command gives."""

import re
from pathlib import Path

import pytest

import ftc_jsb as ftc

TABLE = (Path(__file__).parents[1] / "README.md").read_text(encoding="utf-8")
ROWS = {
    "RMSE airspeed [m/s]": "rmse_airspeed_mps",
    "RMSE flight path [°]": "rmse_flight_path_deg",
    "RMSE heading [°]": "rmse_heading_deg",
    "largest error of the effectiveness¹": "effectiveness_thrust_error_max",
    "fault declared after [s]": "detection_delay_s",
}


@pytest.fixture(scope="module")
def flights():
    return ftc.compare("paper", progress=False)


@pytest.mark.parametrize("title", ROWS)
def test_a_row_has_the_digits_that_are_flown(flights, title):
    """With FTC and without, to the last digit that is printed."""
    cells = next(line for line in TABLE.splitlines() if line.startswith(f"| {title} |")).split("|")
    for model, cell in zip(("paper", "identified", "jsbsim"), cells[2:5], strict=True):
        for loop, printed in zip(("ftc", "no-ftc"), cell.split("/"), strict=True):
            flown = flights[f"{model}-{loop}"].metrics[ROWS[title]]
            digits = len(printed.strip().partition(".")[2])
            assert f"{flown:.{digits}f}" == printed.strip()


def test_verdicts_are_as_the_table_has_them(flights):
    row = next(line for line in TABLE.splitlines() if line.startswith("| verdict;"))
    assert re.findall(r"inside limits; helped", row) == ["inside limits; helped"] * 3
    assert {flight.verdict for flight in flights.values()} == {"inside limits"}
    assert {pair["answer"] for pair in flights.ftc_helped} == {"helped"}
