"""What the charts are thinned to: extremes and faults are kept, and it is said by how much."""

import base64

import numpy as np

from ftc_jsb.report.findings import analyse
from ftc_jsb.report.page.chart_series import ALL_POINTS, flight_series


def unpacked(text: str) -> np.ndarray:
    return np.frombuffer(base64.b64decode(text), "<f4")


def test_extremes_and_faults_survive_thinning(flown):
    """Ten times the same flight: one sample in four, but every one near 20 s and every peak."""
    flight = flown("paper", "model=jsbsim")
    flights = {f"flight {number}": flight for number in range(10)}
    series = flight_series(flights, analyse(flights))["flight 3"]
    time = unpacked(series.columns["time"])
    assert series.every == np.ceil(flight.record.size / (ALL_POINTS / 10))
    near = (time > 19.2) & (time < 20.8)
    assert np.allclose(np.diff(time[near]), 0.01, atol=1e-5)
    error = flight.record["airspeed"] - flight.record["airspeed_ref"]
    assert np.abs(unpacked(series.columns["error_airspeed"])).max() == np.float32(
        np.abs(error).max()
    )


def test_series_are_the_recording(flown):
    """Every shown sample is the recorded one, in the unit of the chart."""
    flight = flown("paper")
    series = flight_series({"f": flight}, analyse({"f": flight}))["f"]
    rows = np.searchsorted(flight.record["time"], unpacked(series.columns["time"]) - 1e-4)
    for name, values in (
        ("bank_angle_flown", np.degrees(flight.record["bank_angle"])),
        ("thrust_command", flight.record["thrust_cmd"] / 1e3),
        ("effectiveness_thrust_estimate", flight.record["effectiveness_thrust_est"]),
    ):
        shown = unpacked(series.columns[name])
        assert np.allclose(shown, values[rows], rtol=1e-6, atol=1e-6, equal_nan=True)


def test_column_that_a_flight_has_not_is_left_out(flown):
    flight = flown("paper", "loop.name=integral", "duration=5")
    columns = flight_series({"f": flight}, analyse({"f": flight}))["f"].columns
    assert "airspeed" in columns
    assert "effectiveness_thrust_estimate" not in columns
    assert "lyapunov" not in columns
