"""`--quiet` prints nothing of a flight that goes well, says what went wrong, and leaves --json alone."""

import json

import pytest

from tests.cli.command import run

SHORT = ("fly", "paper", "--set", "duration=2", "--quiet")


def test_a_good_flight_is_silent(tmp_path):
    result = run(*SHORT, "--out", "a", cwd=tmp_path)
    assert (result.returncode, result.stdout, result.stderr) == (0, "", "")
    assert (tmp_path / "a" / "flight.nc").is_file()


def test_a_broken_limit_is_said(tmp_path):
    result = run(*SHORT, "--set", "limits.airspeed=[310, 320]", "--out", "a", cwd=tmp_path)
    assert result.returncode == 1
    assert result.stdout == ""
    assert "limit broken: airspeed" in result.stderr


@pytest.mark.parametrize("quiet", [True, False])
def test_json_says_where_the_recording_is(quiet, tmp_path):
    result = run(*(SHORT if quiet else SHORT[:-1]), "--json", "--out", "a", cwd=tmp_path)
    assert json.loads(result.stdout)["recording"] == "a/flight.nc"
