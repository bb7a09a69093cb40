"""The aerodynamics of a `point_mass.toml`: polar, angle of attack, coefficients from measured angles."""

from typing import Self

import numpy as np
from pydantic import model_validator

from ftc_jsb.aircraft.knot_tables import Number, Positive, Row, Table, check_increasing, check_shape
from ftc_jsb.point_mass.model import (
    ALPHA_KNOTS,
    ALPHA_TERMS,
    DRAG_TERMS,
    ELEVATOR_KNOTS,
    LIFT_KNOTS,
    MACH_KNOTS,
)
from ftc_jsb.typed_file import Section


class DragTable(Section):
    """Drag coefficient to be added to the parabola, over Mach and equally spaced C_L."""

    lift_coefficient: Row
    values: Table

    @model_validator(mode="after")
    def _equally_spaced(self) -> Self:
        name = "aerodynamics.drag_table.lift_coefficient"
        check_increasing(name, self.lift_coefficient, LIFT_KNOTS)
        steps = np.diff(self.lift_coefficient)
        if len(steps) == 0 or np.ptp(steps) > 1e-6:
            raise ValueError(f"{name}: expected equal steps")
        return self

    @property
    def first(self) -> float:
        """The least lift coefficient."""
        return self.lift_coefficient[0]

    @property
    def spacing(self) -> float:
        """Step from one lift coefficient to the next."""
        return self.lift_coefficient[1] - self.lift_coefficient[0]


class Aerodynamics(Section):
    """Drag polar and angle of attack: a polynomial in C_L for each Mach knot."""

    area: Positive  # m2
    mach: Row
    drag: Table  # C_D = sum c_j C_L^j, j = 0..2
    alpha: Table  # rad, sum a_j C_L^j, j = 0..3
    drag_table: DragTable | None = None

    @model_validator(mode="after")
    def _shapes(self) -> Self:
        rows = len(self.mach)
        check_increasing("aerodynamics.mach", self.mach, MACH_KNOTS)
        check_shape("aerodynamics.drag", self.drag, rows, DRAG_TERMS)
        check_shape("aerodynamics.alpha", self.alpha, rows, ALPHA_TERMS)
        if self.drag_table is not None:
            columns = len(self.drag_table.lift_coefficient)
            check_shape("aerodynamics.drag_table.values", self.drag_table.values, rows, columns)
        return self


class MeasuredDrag(Section):
    """Drag coefficient from measured angles, surfaces and pitch rate, for the estimator."""

    mach: Row
    alpha: Row  # rad
    elevator: Row  # rad
    mach_alpha: Table
    alpha_elevator: Table
    pitch_rate: Row  # m/rad, for each alpha; times q / V
    flap: Number  # 1/rad
    sideslip: Row = ()  # 1/rad, for each alpha; times its magnitude
    sideslip_squared: Number  # 1/rad2

    @model_validator(mode="after")
    def _shapes(self) -> Self:
        check_increasing("measured_drag.mach", self.mach, MACH_KNOTS)
        check_increasing("measured_drag.alpha", self.alpha, ALPHA_KNOTS)
        check_increasing("measured_drag.elevator", self.elevator, ELEVATOR_KNOTS)
        rows, columns = len(self.alpha), len(self.elevator)
        check_shape("measured_drag.mach_alpha", self.mach_alpha, len(self.mach), rows)
        check_shape("measured_drag.alpha_elevator", self.alpha_elevator, rows, columns)
        check_shape("measured_drag.pitch_rate", (self.pitch_rate,), 1, rows)
        if self.sideslip:
            check_shape("measured_drag.sideslip", (self.sideslip,), 1, rows)
        return self


class MeasuredLift(Section):
    """Lift coefficient from measured angles and rates, at the knots of [measured_drag]."""

    mach_alpha: Table
    alpha_elevator: Table
    pitch_rate: Row  # m/rad, for each alpha; times q / V
    path_rate: Number  # m/rad, times the rate of the path over V
    flap: Number  # 1/rad

    def check_knots(self, drag: MeasuredDrag) -> None:
        """See that tables and rows are as long as the knots.

        Args:
            drag: whose knots they are.

        Raises:
            ValueError: they are not.
        """
        rows, columns = len(drag.alpha), len(drag.elevator)
        check_shape("measured_lift.mach_alpha", self.mach_alpha, len(drag.mach), rows)
        check_shape("measured_lift.alpha_elevator", self.alpha_elevator, rows, columns)
        check_shape("measured_lift.pitch_rate", (self.pitch_rate,), 1, rows)


class SideForce(Section):
    """Side-force coefficient along the body's y axis, at the knots of [measured_drag]."""

    sideslip_mach: Row  # 1/rad, for each Mach number; times sideslip
    sideslip_alpha: Row  # 1/rad, for each alpha; times sideslip
    sideslip_squared: Number  # 1/rad2, times sideslip and its magnitude
    roll_rate: Row  # m/rad, for each alpha; times p / V
    yaw_rate: Row  # m/rad, for each alpha; times r / V
    aileron: Number  # 1/rad
    rudder: Number  # 1/rad

    def check_knots(self, drag: MeasuredDrag) -> None:
        """See that rows are as long as the knots.

        Args:
            drag: whose knots they are.

        Raises:
            ValueError: they are not.
        """
        check_shape("side_force.sideslip_mach", (self.sideslip_mach,), 1, len(drag.mach))
        for name in ("sideslip_alpha", "roll_rate", "yaw_rate"):
            check_shape(f"side_force.{name}", (getattr(self, name),), 1, len(drag.alpha))
