"""A `point_mass.toml` as the MODEL record that the kernels read: which field takes which key."""

from typing import Any

import numpy as np
import numpy.typing as npt

from ftc_jsb.point_mass.model import MODEL

# Each field and the key of the file that it takes. Rows and tables fill the beginning of their
# array, the rest stays 0; a part that the file does not have leaves its fields 0.
VALUES = {
    "gravity": "mass.gravity",
    "mass_empty": "mass.empty",
    "fuel_flow": "fuel_flow.coefficients",
    "fuel_flow_rate": "fuel_flow.rates",
    "area": "aerodynamics.area",
    "load_factor_min": "load_factor.minimum",
    "load_factor_max": "load_factor.maximum",
    "lift_coefficient_max": "load_factor.lift_coefficient_max",
    "constant_density": "atmosphere.density",
    "constant_sound_speed": "atmosphere.sound_speed",
    "valid_mach": "valid.mach",
    "valid_lift": "valid.lift_coefficient",
    "valid_altitude": "valid.altitude",
    "mach": "aerodynamics.mach",
    "drag": "aerodynamics.drag",
    "alpha": "aerodynamics.alpha",
    "lift_first": "aerodynamics.drag_table.first",
    "lift_spacing": "aerodynamics.drag_table.spacing",
    "drag_table": "aerodynamics.drag_table.values",
    "measured_mach": "measured_drag.mach",
    "measured_alpha": "measured_drag.alpha",
    "measured_elevator": "measured_drag.elevator",
    "measured_mach_alpha": "measured_drag.mach_alpha",
    "measured_alpha_elevator": "measured_drag.alpha_elevator",
    "measured_pitch_rate": "measured_drag.pitch_rate",
    "measured_flap": "measured_drag.flap",
    "measured_sideslip": "measured_drag.sideslip",
    "measured_sideslip_squared": "measured_drag.sideslip_squared",
    "lift_mach_alpha": "measured_lift.mach_alpha",
    "lift_alpha_elevator": "measured_lift.alpha_elevator",
    "lift_pitch_rate": "measured_lift.pitch_rate",
    "lift_path_rate": "measured_lift.path_rate",
    "lift_flap": "measured_lift.flap",
    "side_sideslip_mach": "side_force.sideslip_mach",
    "side_sideslip_alpha": "side_force.sideslip_alpha",
    "side_sideslip_squared": "side_force.sideslip_squared",
    "side_roll_rate": "side_force.roll_rate",
    "side_yaw_rate": "side_force.yaw_rate",
    "side_aileron": "side_force.aileron",
    "side_rudder": "side_force.rudder",
    "deck_mach": "thrust.mach",
    "deck_altitude": "thrust.altitude",
    "thrust_idle": "thrust.idle",
    "thrust_military": "thrust.military",
    "thrust_maximum": "thrust.maximum",
    "spool_up": "thrust.spool_up",
    "spool_down": "thrust.spool_down",
    "response_frequency": "response.frequencies",
    "response_damping": "response.dampings",
    "bank_rate_max": "response.bank_rate_max",
    "bank_acceleration_max": "response.bank_acceleration_max",
}
# Each count and the knots that it counts.
COUNTS = {
    "mach_count": "aerodynamics.mach",
    "lift_count": "aerodynamics.drag_table.lift_coefficient",
    "measured_mach_count": "measured_drag.mach",
    "measured_alpha_count": "measured_drag.alpha",
    "measured_elevator_count": "measured_drag.elevator",
    "measured_lift_count": "measured_lift.pitch_rate",
    "side_force_count": "side_force.roll_rate",
    "deck_mach_count": "thrust.mach",
    "deck_altitude_count": "thrust.altitude",
}


def model_record(point_mass: Any, mass: float) -> npt.NDArray[Any]:
    """(1,) MODEL of a point mass.

    Args:
        point_mass: `PointMass` of the file.
        mass: at the start of the flight [kg], which the file does not have: it goes by the fuel.
    """
    model = np.zeros(1, MODEL)
    model["mass"] = model["mass_start"] = mass
    for field, key in VALUES.items():
        value = _at(point_mass, key)
        if value is not None:
            array: npt.NDArray[np.float64] = np.asarray(value, dtype=float)
            filled: tuple[int | slice, ...] = (0, *(slice(size) for size in array.shape))
            model[field][filled] = array
    for field, key in COUNTS.items():
        model[field] = len(_at(point_mass, key) or ())
    return model


def _at(part: Any, key: str) -> Any:
    """Value at a dotted key; None where the file does not have the part."""
    for name in key.split("."):
        if part is None:
            return None
        part = getattr(part, name)
    return part
