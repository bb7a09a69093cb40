"""Wind: what it does to a flight, and the statistics of turbulence."""

from typing import Any

import numpy as np
import pytest
from scipy.signal import welch

from ftc_jsb.disturbance.weather import intensity, scale_length, wind_record
from ftc_jsb.disturbance.wind import wind_step
from ftc_jsb.recording.columns import ROW
from ftc_jsb.scenario.load import load_scenario
from ftc_jsb.scenario.wind import Wind
from ftc_jsb.simulation.fly import fly


def flown(model: str, *overrides: str) -> Any:
    return fly(load_scenario("paper", [f"model={model}", *overrides])).record


@pytest.mark.parametrize("model", ["paper", "identified", "jsbsim"])
def test_steady_wind_carries_the_aircraft_and_leaves_tracking_untouched(model):
    """30 m/s from 200 deg for 60 s: displaced by the wind, and through the air the same flight.

    Air-relative states agree exactly on a point mass; on JSBSim, whose round Earth turns under
    another path, to 0.01 m/s and 0.03 deg; displacement to 0.2 %.
    """
    calm = flown(model)
    windy = flown(model, "wind.speed=30", "wind.from_deg=200")
    exact = model != "jsbsim"
    for name, within in (("airspeed", 0.01), ("flight_path_angle", 5e-4), ("heading", 5e-4)):
        assert np.abs(windy[name] - calm[name]).max() <= (0.0 if exact else within)
    north, east = -30.0 * np.cos(np.radians(200.0)), -30.0 * np.sin(np.radians(200.0))
    assert windy["north"][-1] - calm["north"][-1] == pytest.approx(60.0 * north, rel=2e-3)
    assert windy["east"][-1] - calm["east"][-1] == pytest.approx(60.0 * east, rel=2e-3)


def test_shear_is_felt_as_airspeed():
    """A climb at 5 deg into a head wind that grows by 0.02 m/s a metre gains airspeed unless thrust
    gives it back: over the climb the filter, which knows no shear, sees the thrust it would take.

    dV/dt = shear V sin(gamma) = 0.52 m/s^2, of 36 to 62 kN on 9.3 t: estimate up by 0.02 to 0.15.
    """
    shear = flown("identified", "fault=[]", "wind.shear=0.02", "wind.from_deg=0.0")
    climbing = (shear["time"] > 30.0) & (shear["time"] < 34.0)
    east = shear["wind_north"][climbing]
    height = shear["altitude"][climbing] - 3048.0
    np.testing.assert_allclose(east, -0.02 * height, rtol=1e-9)
    assert 1.02 < shear["effectiveness_thrust_est"][climbing].mean() < 1.15


@pytest.mark.parametrize("model", ["identified", "jsbsim"])
def test_discrete_gust_has_its_shape(model):
    """1 - cosine: half the size half way up, all of it while held; felt as airspeed at once."""
    gust = "wind.gust=[{speed=8.0, from_deg=0.0, start=2.0, length=1.0, hold=1.0}]"
    record = flown(model, "duration=6", gust)
    north = record["wind_north"]
    lag = 1 if model == "jsbsim" else 0  # JSBSim's wind of a row is that of the frame before
    assert north[200 + lag] == pytest.approx(0.0, abs=1e-9)
    assert north[250 + lag] == pytest.approx(-4.0, abs=0.05)
    assert north[350] == pytest.approx(-8.0, abs=1e-6)
    assert north[500 + lag] == pytest.approx(0.0, abs=1e-9)
    assert 300.5 < record["airspeed"][250:350].max() < 308.0


def dryden(samples: int, dt: float) -> Any:
    """Turbulence alone, met at 250 m/s in level flight to the north."""
    wind = wind_record(Wind(turbulence="moderate"), 3048.0, 5, dryden=True)
    record = np.zeros(samples, ROW)
    record["time"] = np.arange(samples) * dt
    record["airspeed"], record["altitude"] = 250.0, 3048.0
    for i in range(samples):
        wind_step(wind, record, i, dt)
        record[i]["wind_north"], record[i]["wind_east"], record[i]["wind_up"] = wind[0]["now"]
    return record


def test_dryden_turbulence_has_the_rms_and_the_spectrum_of_the_report():
    """MIL-F-8785C at 3048 m: rms 2.87 m/s in each axis within 8 %, over 4000 s of flight.

    Power along the path falls to one half at V / L = 0.469 rad/s, within 20 % (Welch's estimate).
    """
    dt = 0.02
    record = dryden(200_000, dt)
    expected = intensity("moderate", 3048.0)
    assert expected == pytest.approx(2.87, abs=0.05)
    for name in ("wind_north", "wind_east", "wind_up"):
        assert record[name].std() == pytest.approx(expected, rel=0.08)
    frequency, power = welch(record["wind_north"], fs=1.0 / dt, nperseg=16384)
    shape = (
        2.0
        * expected**2
        * (533.4 / 250.0)
        * 2.0
        / (1.0 + (533.4 / 250.0 * 2 * np.pi * frequency) ** 2)
    )
    band = (frequency > 0.02) & (frequency < 2.0)
    ratio = power[band] / shape[band]
    assert np.mean(ratio) == pytest.approx(1.0, abs=0.2)


def test_jsbsim_turbulence_is_as_strong_as_the_report_says():
    """JSBSim's own at the same altitude, vertical and lateral, 60 s: within 50 %, one short sample.

    The severity that stands for moderate is taken from the same figure of the same report.
    """
    record = flown("jsbsim", "wind.turbulence=moderate", "loop.name=robust", "fault=[]")
    for name in ("wind_east", "wind_up"):
        assert record[name].std() == pytest.approx(intensity("moderate", 3048.0), rel=0.5)
    weak = flown("jsbsim", "wind.turbulence=light", "loop.name=robust", "fault=[]")
    assert weak["wind_up"].std() < record["wind_up"].std()


def test_jsbsim_turbulence_is_there_near_the_ground():
    """At 250 m, where it goes by the wind at 20 ft: MIL-F-8785C has 0.1 x 50.6 ft/s, 1.54 m/s, up and down."""
    record = flown(
        "jsbsim", "wind.turbulence=moderate", "loop.name=robust", "fault=[]", "initial.altitude=250",
        "initial.airspeed=200", "reference.airspeed=[[0,200]]", "reference.flight_path_deg=[[0,0]]",
        "reference.heading_deg=[[0,0]]",
    )  # fmt: skip
    assert record["wind_up"].std() == pytest.approx(1.54, rel=0.5)


def test_scale_length_goes_from_one_rule_to_the_other():
    """MIL-F-8785C, 3.7.3: 1750 ft from 2000 ft up, h / (0.177 + 0.000823 h)^1.2 up to 1000 ft."""
    assert scale_length(3048.0) == pytest.approx(1750.0 * 0.3048)
    assert scale_length(1000.0 * 0.3048) == pytest.approx(1000.0 * 0.3048)
    assert scale_length(1500.0 * 0.3048) == pytest.approx(1375.0 * 0.3048)
    assert scale_length(500.0 * 0.3048) == pytest.approx(500.0 / (0.177 + 0.4115) ** 1.2 * 0.3048)


@pytest.mark.parametrize("model", ["identified", "jsbsim"])
def test_turbulence_is_seeded(model):
    short = ("duration=5", "wind.turbulence=severe", "loop.name=robust")
    one, same = flown(model, *short), flown(model, *short)
    other = flown(model, *short, "seed=1")
    np.testing.assert_array_equal(one["airspeed"], same["airspeed"])
    assert np.abs(one["wind_up"] - other["wind_up"]).max() > 0.5
