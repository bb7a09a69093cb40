"""The closed-loop flight against an independent integration, and the integrator's order."""

from typing import Any

import numpy as np
import pytest
from scipy.integrate import solve_ivp

from ftc_jsb.scenario.load import load_scenario
from ftc_jsb.simulation.fly import fly

STATE = ("airspeed", "flight_path_angle", "heading", "north", "east", "altitude")


class IndependentPlant:
    """(41)-(43) and Table 1 written out once more, integrated by SciPy's DOP853.

    Nothing of the package's kernels is used. Commands are held over a sample.
    """

    def __init__(self, dt: float) -> None:
        self.dt = dt
        self.x = np.array([300.0, 0.0, 0.0, 0.0, 0.0, 3048.0])
        self.n, self.bank, self.thrust = 1.0, 0.0, 0.0

    def reset(self, record: Any) -> None:
        self.record = record

    def truth(self, i: int) -> None:
        row = self.record[i]
        for name, value in zip(STATE, self.x, strict=True):
            row[name] = value
        row["load_factor"], row["bank_angle"] = self.n, self.bank
        row["thrust"], row["alpha"] = self.thrust, 0.0

    def step(self, i: int) -> None:
        row = self.record[i]
        g, rho, s = 9.81, 1.2251, 37.16
        w = 14515.0 * g
        thrust = row["effectiveness_thrust"] * min(max(row["thrust_cmd"], 0.0), 113868.0)
        n, bank = row["load_factor_cmd"], row["bank_angle_cmd"]

        def motion(_: float, x: np.ndarray) -> list[float]:
            v, path, heading = x[:3]
            d = 0.5 * rho * v**2 * s * 0.02 + 2.0 * 0.1 * n**2 * w**2 / (rho * v**2 * s)
            return [
                g * ((thrust - d) / w - np.sin(path)),
                g / v * (n * np.cos(bank) - np.cos(path)),
                g * n * np.sin(bank) / (v * np.cos(path)),
                v * np.cos(path) * np.cos(heading),
                v * np.cos(path) * np.sin(heading),
                v * np.sin(path),
            ]

        solution = solve_ivp(
            motion, (0.0, self.dt), self.x, method="DOP853", rtol=1e-13, atol=1e-13
        )
        self.x = solution.y[:, -1]
        self.n, self.bank, self.thrust = n, bank, thrust

    def close(self) -> None:
        pass


@pytest.mark.parametrize("loop", ["ftc", "no-ftc"])
def test_whole_flight_agrees_with_dop853(flown, loop):
    """The paper's 60 s in closed loop, plant by Runge-Kutta and by DOP853 at 1e-13.

    1e-9 of each variable's largest value, over the whole flight and all six states.
    """
    scenario = load_scenario("paper", [f"loop.name={loop}"])
    ours = flown("paper", f"loop.name={loop}").record
    theirs = fly(scenario, plant=IndependentPlant(1.0 / scenario.loop.rate)).record
    for name in STATE:
        scale = np.abs(theirs[name]).max()
        np.testing.assert_allclose(
            ours[name], theirs[name], rtol=0.0, atol=1e-9 * scale, err_msg=name
        )


@pytest.mark.parametrize("name", ["airspeed", "flight_path_angle", "heading", "north", "altitude"])
def test_integrator_converges_at_fourth_order(flown, name):
    """2 Hz control held fixed, the plant's substeps doubled twice: the error falls 16-fold each time.

    64 substeps are the reference. Order 4 +- 0.1; control is slow so that errors stand far above
    rounding (at 100 Hz there is nothing but rounding left to see), and the loop has no filter, which
    magnifies rounding.
    """
    slow = ("loop.name=integral", "loop.rate=2", "loop.trim_filter=1", "duration=30")
    flights = {
        steps: flown("paper", *slow, f"simulation.point_mass_steps={steps}").record[name]
        for steps in (1, 2, 4, 64)
    }
    error = [np.abs(flights[steps] - flights[64]).max() for steps in (1, 2, 4)]
    assert np.log2(error[0] / error[1]) == pytest.approx(4.0, abs=0.1)
    assert np.log2(error[1] / error[2]) == pytest.approx(4.0, abs=0.1)


def test_plant_holds_the_load_factor_within_what_lift_allows():
    """A loop that asks for 7 g at 120 m/s gets C_Lmax q S / W = 4.6 of the paper's aircraft, no more."""
    name = "loop.name='tests.control.my_loop:PullingLoop'"
    slow = ("initial.airspeed=120", "reference.airspeed=[[0,120]]", "duration=1", "limits={}")
    record = fly(load_scenario("nominal", [name, *slow])).record
    limit = 2.0 * 0.5 * 1.2251 * record["airspeed"] ** 2 * 37.16 / (14515.0 * 9.81)
    np.testing.assert_allclose(record["load_factor"][1:-1], limit[1:-1], rtol=2e-3)
