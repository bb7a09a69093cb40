"""One flight: saved, measured, and flown again where the ground asks for it."""

import json
from contextlib import nullcontext

from ftc_jsb.recording.netcdf import load
from ftc_jsb.runs.single import fly_and_save
from ftc_jsb.scenario.load import load_scenario


class FlownTwice:
    """A `Live` whose ground asks once for the same flight again."""

    observers = ()
    commands = None

    def __init__(self):
        self.flights = []

    def flies_again(self, flight):
        self.flights.append(flight)
        return len(self.flights) < 2

    def summary(self):
        return []


def test_flight_is_saved_with_its_metrics(tmp_path):
    labels = []
    scenario = load_scenario("paper", ["duration=1"])
    result = fly_and_save(scenario, tmp_path, lambda label: nullcontext(labels.append(label) or ()))
    assert labels == ["paper"]
    assert result.label == "paper-ftc"
    assert json.loads((tmp_path / "metrics.json").read_text()) == result.document
    assert load(tmp_path / "flight.nc").record.size == scenario.samples + 1  # trim included


def test_flight_that_is_flown_again_leaves_the_earlier_one_beside_it(tmp_path):
    live = FlownTwice()
    fly_and_save(
        load_scenario("paper", ["duration=1"]), tmp_path, lambda label: nullcontext(()), live
    )
    assert len(live.flights) == 2
    names = sorted(path.name for path in tmp_path.iterdir())
    assert names == ["flight-1.nc", "flight.nc", "metrics.json"]
