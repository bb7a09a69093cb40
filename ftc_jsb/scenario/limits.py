"""[limits] of a scenario: the ranges that a flight must not leave."""

from typing import Self

from pydantic import model_validator

from ftc_jsb.scenario.types import Bound
from ftc_jsb.typed_file import Section

_Range = tuple[Bound, Bound]


class Limits(Section):
    """[limits]: [low, high]; a flight that leaves one fails."""

    airspeed: _Range | None = None  # m/s
    altitude: _Range | None = None  # m
    load_factor: _Range | None = None
    bank_deg: _Range | None = None
    flight_path_deg: _Range | None = None
    alpha_deg: _Range | None = None
    sideslip_deg: _Range | None = None
    mach: _Range | None = None
    error_airspeed: _Range | None = None  # m/s
    error_flight_path_deg: _Range | None = None
    error_heading_deg: _Range | None = None

    @model_validator(mode="after")
    def _ordered(self) -> Self:
        for name in type(self).model_fields:
            bounds = getattr(self, name)
            if bounds is not None and bounds[0] >= bounds[1]:
                raise ValueError(f"limits.{name}: low must be less than high (got {list(bounds)})")
        return self
