"""[reference] of a scenario: breakpoints of the raw commands, (44) for the paper's, sampled over a flight."""

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
    flight_path_deg: _Breakpoints
    heading_deg: _Breakpoints

    @model_validator(mode="after")
    def _in_range(self) -> Self:
        bounds = {
            "airspeed": (50.0, 600.0),
            "flight_path_deg": (-60.0, 60.0),
            "heading_deg": (-36000.0, 36000.0),
        }
        for name, (low, high) in bounds.items():
            points: tuple[Point, ...] = getattr(self, name)
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
    """Commands of airspeed [m/s], flight path angle [rad] and heading [rad] before the filter.

    Args:
        reference: breakpoints; linear between, held outside. (44) leaves t = 5 s open, which is
            no matter: both pieces are 0 there.
        times: (rows,) [s].

    Returns:
        (rows, 3).
    """
    columns = [
        np.interp(times, *np.array(points, dtype=float).T)
        for points in (reference.airspeed, reference.flight_path_deg, reference.heading_deg)
    ]
    columns[1:] = [np.radians(column) for column in columns[1:]]
    return np.stack(columns, axis=1)
