"""The robustness margin: its sign is the verdict's, its size the distance from the nearest limit."""

import pytest

from ftc_jsb.analysis.metrics import flight_metrics
from ftc_jsb.analysis.robustness import LOST, estimate_margin, robustness_margin


@pytest.mark.parametrize(
    ("scenario", "overrides"),
    [
        ("paper", ["duration=20"]),
        ("paper", ["duration=22", "loop.name='no-ftc'", "limits.error_airspeed=[-0.5,0.5]"]),
        ("total-loss", ["duration=30", "loop.priority='none'"]),
        ("nominal", ["duration=5"]),
    ],
)
def test_sign_is_the_verdicts(flown, scenario, overrides):
    flight = flown(scenario, *overrides)
    metrics = flight_metrics(flight)
    margin = robustness_margin(flight, metrics)
    assert (margin.value >= 0.0) == (metrics["verdict"] == "inside limits")
    assert -2.0 <= margin.value <= 1.0


def test_size_is_the_distance_from_the_nearest_limit(flown):
    """Alone a limit of +-2 m/s on the airspeed error: one less half of the worst error."""
    far = "[-1e5,1e5]"
    others = ("altitude", "bank_deg", "alpha_deg", "load_factor", "sideslip_deg")
    others += ("airspeed", "error_flight_path_deg", "error_heading_deg")
    text = "limits={error_airspeed=[-2,2]" + "".join(f", {name}={far}" for name in others) + "}"
    flight = flown("paper", "duration=22", "sensors.profile='tactical'", text)
    metrics = flight_metrics(flight)
    margin = robustness_margin(flight, metrics)
    assert margin.limit == "error_airspeed"
    assert margin.value == pytest.approx(1.0 - metrics["peak_error_airspeed_mps"] / 2.0, abs=1e-12)


def test_lost_control_is_worse_the_earlier(flown):
    flight = flown("paper", "duration=10")
    metrics = flight_metrics(flight) | {"verdict": "departed"}
    early, late = (
        robustness_margin(flight, metrics | {"loss_of_control_time_s": time}) for time in (2.0, 8.0)
    )
    assert early.limit == LOST
    assert (early.value, late.value) == pytest.approx((-1.8, -1.2))


def test_estimate_margin():
    assert estimate_margin({"effectiveness_thrust_error_p95": None}) is None
    assert estimate_margin({"effectiveness_thrust_error_p95": 0.05}) == pytest.approx(0.5)
