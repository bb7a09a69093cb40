"""The point mass as a plant."""

import math
from collections.abc import Callable
from functools import cached_property
from typing import Any

import numpy as np
import numpy.typing as npt

from ftc_jsb.compiled import direct
from ftc_jsb.point_mass.motion import (
    POINT_MASS_STATE,
    PointMassArrays,
    point_mass_step,
    point_mass_truth,
    trim_thrust,
)
from ftc_jsb.scenario.schema import Initial

SHORT_STEP = 0.0025  # [s], where engine, inner loop or changing wind are integrated
LONG_STEP = 0.01  # [s], where (41)-(42) are all there is: RK4 is exact to rounding then


class PointMassPlant:
    """A `Plant` on the equations of motion (41)-(42)."""

    def __init__(
        self,
        model: npt.NDArray[Any],
        wind: npt.NDArray[Any],
        initial: Initial,
        dt: float,
        substeps: int | None = None,
    ) -> None:
        """Args: (1,) MODEL; (1,) WIND; initial condition; sample time [s]; Runge-Kutta steps a sample."""
        self.arrays = PointMassArrays(model, wind, np.zeros(1, POINT_MASS_STATE))
        self._initial = initial
        self.dt = dt
        self.substeps = substeps or substeps_needed(model, wind, dt)

    def reset(self, record: npt.NDArray[Any]) -> None:
        """Level trim at the initial condition, the fuel of the start; binds the recording to write to."""
        model = self.arrays.model[0]
        model["mass"] = model["mass_start"]
        initial = self._initial
        path = math.radians(initial.flight_path_deg)
        state = self.arrays.state[0]
        x = state["x"]
        x[:] = 0.0
        x[0], x[1], x[2] = initial.airspeed, path, math.radians(initial.heading_deg)
        x[5], x[6] = initial.altitude, math.cos(path)
        state["thrust"], state["rotor_speed"] = trim_thrust(
            self.arrays.model, initial.airspeed, initial.altitude, path
        )
        state["fuel_flow"] = model["fuel_flow"][3]  # idling
        self._record = record

    @cached_property  # a flight in compiled stretches needs neither
    def _truth(self) -> Callable[..., Any]:
        return direct(point_mass_truth, self.arrays, self._record, 0, self.dt)

    @cached_property
    def _step(self) -> Callable[..., Any]:
        return direct(point_mass_step, self.arrays, self._record, 0, self.dt, self.substeps)

    def truth(self, i: int) -> None:
        """Write the state to row `i`."""
        self._truth(self.arrays, self._record, i, self.dt)

    def step(self, i: int) -> None:
        """Fly the commands of row `i` for one sample."""
        self._step(self.arrays, self._record, i, self.dt, self.substeps)

    def close(self) -> None:
        """Nothing to release."""


def substeps_needed(model: npt.NDArray[Any], wind: npt.NDArray[Any], dt: float) -> int:
    """Runge-Kutta steps that a sample of `dt` seconds takes."""
    m = model[0]
    lags = m["spool_up"][0] > 0.0 or np.any(m["response_frequency"] > 0.0)
    w = wind[0]
    changing = np.any(w["shear"]) or w["gusts"] > 0 or np.any(w["turbulence"])
    longest = SHORT_STEP if lags or changing else LONG_STEP
    return max(1, math.ceil(dt / longest - 1e-9))
