"""The engines of a `point_mass.toml`: thrust deck and spool."""

from typing import Annotated, Self

from pydantic import Field, model_validator

from ftc_jsb.aircraft.knot_tables import Number, Row, Table, check_increasing, check_shape
from ftc_jsb.point_mass.model import ALTITUDE_KNOTS, MACH_KNOTS
from ftc_jsb.typed_file import Section
from ftc_jsb.vocabulary.channels import ENGINES


class Thrust(Section):
    """Thrust deck [N] of all engines, healthy, over Mach and altitude; and the spool."""

    engines: Annotated[int, Field(ge=1, le=ENGINES)] = 1
    mach: Row
    altitude: Row  # m
    idle: Table
    military: Table
    maximum: Table
    spool_up: tuple[Number, Number, Number] = (0.0, 0.0, 0.0)  # see `thrust.spool_rate`
    spool_down: tuple[Number, Number, Number] = (0.0, 0.0, 0.0)

    @model_validator(mode="after")
    def _shapes(self) -> Self:
        check_increasing("thrust.mach", self.mach, MACH_KNOTS)
        check_increasing("thrust.altitude", self.altitude, ALTITUDE_KNOTS)
        for name in ("idle", "military", "maximum"):
            check_shape(f"thrust.{name}", getattr(self, name), len(self.mach), len(self.altitude))
        return self
