"""A comparison that is stopped keeps what was flown."""

from contextlib import nullcontext

import pytest

from ftc_jsb.runs.comparison import compare_and_save
from ftc_jsb.scenario.load import load_scenario

SCENARIO = load_scenario("paper", ["duration=1", "compare.models=['paper']"])


def stopped_at(wanted):
    """Observers of every flight; Ctrl-C before the flight of the label that is wanted."""

    def observers_for(label):
        if label == wanted:
            raise KeyboardInterrupt
        return nullcontext(())

    return observers_for


def test_every_flight_is_saved(tmp_path):
    flights, interrupted = compare_and_save(SCENARIO, tmp_path, stopped_at(None))
    assert list(flights) == ["paper-ftc", "paper-no-ftc"]
    assert not interrupted
    assert {path.name for path in tmp_path.iterdir()} == {"paper-ftc.nc", "paper-no-ftc.nc"}


def test_flights_before_the_interruption_are_kept(tmp_path):
    flights, interrupted = compare_and_save(SCENARIO, tmp_path, stopped_at("paper-no-ftc"))
    assert list(flights) == ["paper-ftc"]
    assert interrupted
    assert [path.name for path in tmp_path.iterdir()] == ["paper-ftc.nc"]


def test_interruption_before_the_first_flight_is_one(tmp_path):
    with pytest.raises(KeyboardInterrupt):
        compare_and_save(SCENARIO, tmp_path, stopped_at("paper-ftc"))
