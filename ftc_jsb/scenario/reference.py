"""[reference] of a scenario: breakpoints of the raw commands, (44) for the paper's, sampled over a flight."""

import math
from typing import Annotated, Self

import numpy as np
import numpy.typing as npt
from pydantic import Field, model_validator

from ftc_jsb.scenario.types import Point
from ftc_jsb.typed_file import Section

_Breakpoints = Annotated[tuple[Point, ...], Field(min_length=1, max_length=10000)]


class Reference(Section):
    """[reference]: breakpoints [time s, value], linear between and held outside; command filter."""

    filter_frequency: float = Field(3.0, ge=0.05, le=50.0)  # rad/s
    filter_damping: float = Field(1.0, ge=0.1, le=5.0)
    airspeed: _Breakpoints  # m/s
    flight_path_deg: _Breakpoints | None = None  # or altitude
    altitude: _Breakpoints | None = None  # m, steps are flown as climbs:
    climb_deg: float = Field(5.0, ge=0.5, le=30.0)  # the path to a new altitude
    climb_deg_per_s: float = Field(1.0, ge=0.05, le=10.0)  # how fast the path gets there
    heading_deg: _Breakpoints

    @model_validator(mode="after")
    def _one_of_path_and_altitude(self) -> Self:
        if (self.flight_path_deg is None) == (self.altitude is None):
            given = "both" if self.altitude is not None else "neither"
            raise ValueError(f"reference: {given} given; expected flight_path_deg or altitude")
        return self

    @model_validator(mode="after")
    def _in_range(self) -> Self:
        bounds = {
            "airspeed": (50.0, 600.0),
            "flight_path_deg": (-60.0, 60.0),
            "altitude": (100.0, 20000.0),
            "heading_deg": (-36000.0, 36000.0),
        }
        for name, (low, high) in bounds.items():
            points: tuple[Point, ...] = getattr(self, name) or ()
            times = [time for time, _ in points]
            if times != sorted(set(times)):
                raise ValueError(f"reference.{name}: times must increase from point to point")
            for time, value in points:
                if not low <= value <= high:
                    raise ValueError(
                        f"reference.{name}: {value} at {time} s is outside [{low:g}, {high:g}]"
                    )
        return self


def raw_commands(reference: Reference, times: npt.NDArray[np.float64]) -> npt.NDArray[np.float64]:
    """Commands of airspeed [m/s], flight path angle [rad], heading [rad] and altitude [m] before the filter.

    Where an altitude is commanded, the flight path command is level until it is made in flight; where none
    is, the altitude is nan.

    Args:
        reference: breakpoints; linear between, held outside. (44) leaves t = 5 s open, which is
            no matter: both pieces are 0 there.
        times: (rows,) [s].

    Returns:
        (rows, 4).
    """
    level, free = ((0.0, 0.0),), ((0.0, math.nan),)
    airspeed, path, heading, altitude = (
        np.interp(times, *np.array(points, dtype=float).T)
        for points in (
            reference.airspeed,
            reference.flight_path_deg or level,
            reference.heading_deg,
            reference.altitude or free,
        )
    )
    return np.stack([airspeed, np.radians(path), np.radians(heading), altitude], axis=1)


def climb_of(reference: Reference) -> tuple[float, float]:
    """Path to a new altitude [rad], and the rate at which the path gets there [rad/s]."""
    return math.radians(reference.climb_deg), math.radians(reference.climb_deg_per_s)


def filter_lag(reference: Reference) -> float:
    """How late the command filter is for a ramp [s]: 2 z / w."""
    return 2.0 * reference.filter_damping / reference.filter_frequency
