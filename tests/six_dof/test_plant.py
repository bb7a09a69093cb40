"""The JSBSim plant: angles and positions told two ways, inner-loop steps, trim failures."""

import math
from typing import Any

import numpy as np
import pytest

from ftc_jsb.errors import AircraftError, ScenarioError, TrimError
from ftc_jsb.scenario.load import load_scenario
from ftc_jsb.scenario.schema import AircraftChoice, Initial
from ftc_jsb.simulation.fly import fly
from ftc_jsb.six_dof.commanded_flight import DT, fly_commanded, trimmed_aircraft
from ftc_jsb.units import STANDARD_GRAVITY


def flight(initial: Initial, commands: Any, seconds: float, watch: Any = None) -> np.ndarray:
    """Recording of the engaged inner loop at the trim's thrust under `commands(t, row)`."""
    aircraft = trimmed_aircraft(AircraftChoice(), initial, round(seconds / DT))
    return fly_commanded(
        aircraft,
        lambda t, row: (math.nan, *commands(t, row)),
        watch=None if watch is None else lambda i: watch(aircraft.fdm, aircraft.record[i]),
    )


def test_angles_from_attitude_are_jsbsims_own_in_still_air():
    """Flight path and heading from attitude, alpha and beta against JSBSim's velocity: 1e-5 rad.

    A rolling pull-up to the right, in still air, where both must agree.
    """
    differences = []

    def watch(fdm: Any, row: Any) -> None:
        differences.append(row["flight_path_angle"] - fdm["flight-path/gamma-rad"])
        turn = row["heading"] - fdm["flight-path/psi-gt-rad"]
        differences.append(np.arctan2(np.sin(turn), np.cos(turn)))

    start = Initial(heading_deg=170.0)
    flight(start, lambda t, row: (1.0 + 0.5 * min(t, 3.0), min(t, 1.0)), 5.0, watch)
    assert np.abs(differences).max() < 1e-5


def test_position_is_the_integral_of_velocity():
    """North, east and altitude against the sum of velocity over 10 s, 3 km: within 1 m.

    Trapezoids of 0.01 s are good to centimetres; the tangent plane leaves the round Earth by
    0.7 m in 3 km.
    """
    record = flight(Initial(heading_deg=60.0), lambda t, row: (1.2, 0.5), 10.0)
    level = record["airspeed"] * np.cos(record["flight_path_angle"])
    for name, rate in (
        ("north", level * np.cos(record["heading"])),
        ("east", level * np.sin(record["heading"])),
        ("altitude", record["airspeed"] * np.sin(record["flight_path_angle"])),
    ):
        travelled = np.sum((rate[1:] + rate[:-1]) / 2.0) * DT
        assert record[name][-1] - record[name][0] == pytest.approx(travelled, abs=1.0)


def test_accelerometers_feel_the_forces_of_their_own_frame():
    """Along the velocity in moderate turbulence: thrust less drag over mass, to 1e-9 m/s2.

    A frame of 5 ms between them made 0.27 m/s2: JSBSim's own accelerations are those of the frame before.
    """
    gusts = ["model=jsbsim", "duration=5", "wind.turbulence=moderate"]
    row = fly(load_scenario("paper", gusts)).record
    along = np.cos(row["alpha"]) * np.cos(row["sideslip"])
    felt = row["load_factor_x"] * along + row["load_factor_y"] * np.sin(row["sideslip"])
    felt -= row["load_factor_z"] * np.sin(row["alpha"]) * np.cos(row["sideslip"])
    force = (row["thrust"] * along - row["drag"]) / row["mass"]
    np.testing.assert_allclose(STANDARD_GRAVITY * felt, force, rtol=0.0, atol=1e-9)


def test_heading_is_continuous_through_north():
    record = flight(Initial(heading_deg=350.0), lambda t, row: (3.0, 1.2), 6.0)
    assert record["heading"][0] == pytest.approx(np.radians(350.0), abs=1e-3)
    assert record["heading"][-1] > np.radians(365.0)
    assert np.abs(np.diff(record["heading"])).max() < 0.01


@pytest.mark.parametrize("airspeed", [200.0, 300.0])
def test_load_factor_step(airspeed):
    """1 to 3: 10-90 % rise within 0.6 s, overshoot at most 10 %, no steady error (1 % of the step)."""
    record = flight(Initial(airspeed=airspeed), lambda t, row: (3.0 if t >= 1 else 1.0, 0.0), 5.0)
    n, t = (record["load_factor"] - 1.0) / 2.0, record["time"]
    assert t[np.argmax(n > 0.9)] - t[np.argmax(n > 0.1)] <= 0.6
    assert n.max() <= 1.10
    np.testing.assert_allclose(n[400:], 1.0, atol=0.01)


@pytest.mark.parametrize("airspeed", [200.0, 300.0])
def test_bank_step(airspeed):
    """0 to 60 deg: within 5 % and staying there after 2 s, overshoot at most 5 %."""

    def turn(t: float, row: Any) -> tuple[float, float]:
        return 1.0 / np.cos(min(row["bank_angle"], 1.1)), np.radians(60.0) if t >= 1 else 0.0

    record = flight(Initial(airspeed=airspeed), turn, 6.0)
    bank = np.degrees(record["bank_angle"]) / 60.0
    assert bank.max() <= 1.05
    np.testing.assert_allclose(bank[300:], 1.0, atol=0.05)


def test_steady_70_degree_turn_has_no_sideslip():
    """At most 0.5 deg from 3 s on."""
    record = flight(
        Initial(), lambda t, row: (1.0 / np.cos(np.radians(70.0)), np.radians(70.0)), 8.0
    )
    assert np.abs(np.degrees(record["sideslip"][300:])).max() <= 0.5


def test_thrust_command_is_reached_as_fast_as_the_engine_allows():
    """Idle to full reheat and back: the throttle is there within 0.02 s, the rest is the spool's.

    Thrust within 1 % of the span 2.5 s after each step.
    """
    record = fly_commanded(
        trimmed_aircraft(AircraftChoice(), Initial(), 900),
        lambda t, row: (105e3 if 3.0 <= t < 6.0 else -5e3, 1.0, 0.0),
    )
    assert record["throttle"][302] > 1.8
    assert record["throttle"][602] < 0.35
    span = 110e3
    for row, thrust in ((299, -5e3), (550, 105e3), (850, -5e3)):
        assert record["thrust"][row] == pytest.approx(thrust, abs=0.01 * span)


def test_initial_path_and_heading_are_flown():
    record = flight(
        Initial(flight_path_deg=5.0, heading_deg=-45.0),
        lambda t, row: (np.cos(np.radians(5)), 0.0),
        1.0,
    )
    assert np.degrees(record["flight_path_angle"][0]) == pytest.approx(5.0, abs=0.02)
    assert np.degrees(record["heading"][0]) == pytest.approx(-45.0, abs=0.02)


def test_trim_that_cannot_be_is_refused_with_residuals():
    """60 m/s at 15 km: no lift for that."""
    scenario = load_scenario(
        "paper", ["model=jsbsim", "initial.airspeed=60", "initial.altitude=15000"]
    )
    with pytest.raises(TrimError) as refusal:
        fly(scenario)
    assert "no trim at 60 m/s, 15000 m" in str(refusal.value)
    assert "Residuals: udot" in str(refusal.value)


def test_bank_is_continuous_through_inverted_flight():
    """Rolling on past 180 deg the bank angle goes on growing, as heading does."""
    record = flight(Initial(airspeed=250.0), lambda t, row: (1.0, min(1.2 * t, 4.0)), 5.0)
    assert record["bank_angle"].max() > np.radians(200.0)
    assert np.abs(np.diff(record["bank_angle"])).max() < 0.1


def test_jsbsim_that_runs_too_slowly_for_its_inner_loop_is_refused():
    with pytest.raises(ScenarioError, match="2 Hz; the inner loop needs at least 80 Hz"):
        fly(load_scenario("paper", ["model=jsbsim", "loop.rate=1"]))


def test_aircraft_that_is_none_is_refused():
    with pytest.raises(
        AircraftError, match=r"no aircraft 'f99'; expected one of 737, A4, F4N, T37, T38, f15, f16"
    ):
        fly(load_scenario("paper", ["model=jsbsim", "aircraft.name=f99"]))
    with pytest.raises(AircraftError, match=r"aircraft\.toml: not found"):
        fly(load_scenario("paper", ["model=jsbsim", "aircraft.name=paper"]))


def test_fuel_fraction_sets_the_mass():
    """Both models start from the same mass at any fuel state, to 1 kg."""
    for fraction in (0.1, 0.43, 0.9):
        key = f"aircraft.fuel_fraction={fraction}"
        masses = [
            fly(load_scenario("nominal", [f"model={model}", key, "duration=0.1"])).record["mass"][0]
            for model in ("identified", "jsbsim")
        ]
        assert masses[0] == pytest.approx(masses[1], abs=1.0)


def test_flight_ends_where_the_fuel_does():
    """3 % of the internal fuel in full reheat: over within minutes, with the reason."""
    flight = fly(
        load_scenario(
            "nominal",
            [
                "model=jsbsim", "duration=600", "aircraft.fuel_fraction=0.03",
                "reference.airspeed=[[0,300],[1,340]]", "loop.gains=[5,1,1]",
            ],
        )
    )  # fmt: skip
    assert flight.outcome.status == "departed"
    assert flight.outcome.reason == "no fuel is left"
    assert flight.record["fuel"][-2] > 0.5
    assert np.all(np.diff(flight.record["fuel"]) <= 0.0)
