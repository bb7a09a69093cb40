"""Did FTC help? Pairs of flights of one scenario and model, with FTC and without."""

from collections.abc import Mapping
from typing import Any

from ftc_jsb.analysis.verdict import VERDICTS
from ftc_jsb.recording.flight import Flight

Metrics = dict[str, Any]

PAIRS = {"ftc": "no-ftc", "law": "law-no-ftc", "robust": "no-ftc", "ekf": "no-ftc"}
NOTABLE = 1.05  # ratio of the RMSE of airspeed below which there is no difference
SAME = 0.1  # [m/s]: neither is a difference that nobody could measure
HELPED, NO_DIFFERENCE, HURT = "helped", "no difference", "hurt"


def effects(flights: Mapping[str, Flight], metrics: Mapping[str, Metrics]) -> list[dict[str, Any]]:
    """An entry for each pair of flights; the contents of `ftc_helped` in metrics.json.

    Args:
        flights: by label.
        metrics: of each flight, by the same labels.
    """
    found = []
    for label, flight in flights.items():
        without = PAIRS.get(flight.scenario.loop.name)
        for other_label, other in flights.items():
            if other.scenario.loop.name == without and _same_but_loop(flight, other):
                one, two = metrics[label], metrics[other_label]
                found.append(
                    {
                        "scenario": flight.scenario.name,
                        "model": flight.scenario.model,
                        "with_ftc": label,
                        "without_ftc": other_label,
                        "answer": answer(one, two),
                        "rmse_airspeed_with_mps": one["rmse_airspeed_mps"],
                        "rmse_airspeed_without_mps": two["rmse_airspeed_mps"],
                    }
                )
    return found


def answer(with_ftc: Metrics, without: Metrics) -> str:
    """Helped, no difference or hurt: by the verdicts where they differ, else by the RMSE of the airspeed."""
    ranks = [VERDICTS.index(metrics["verdict"]) for metrics in (with_ftc, without)]
    if ranks[0] != ranks[1]:
        return HELPED if ranks[0] < ranks[1] else HURT
    one, two = with_ftc["rmse_airspeed_mps"], without["rmse_airspeed_mps"]
    if one is None or two is None or abs(one - two) < SAME:
        return NO_DIFFERENCE
    if two > NOTABLE * one:
        return HELPED
    return HURT if one > NOTABLE * two else NO_DIFFERENCE


def _same_but_loop(flight: Flight, other: Flight) -> bool:
    one, two = flight.scenario, other.scenario
    return one.model_copy(update={"loop": two.loop}) == two
