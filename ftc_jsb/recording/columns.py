"""The columns of a recording: name, unit and meaning of every variable, defined once, and its row."""

from typing import Any, NamedTuple

import numpy as np
import numpy.typing as npt

from ftc_jsb.vocabulary.channels import CHANNELS, ENGINES, SURFACES, TRACKED
from ftc_jsb.vocabulary.signals import SIGNALS


class Variable(NamedTuple):
    """A column of the recording."""

    name: str
    unit: str  # as in the NetCDF `units` attribute; "1" has no dimension
    meaning: str


_STATE: tuple[tuple[str, str, str], ...] = tuple(  # name, unit, meaning
    zip(
        TRACKED,
        ("m/s", "rad", "rad"),
        ("true airspeed", "flight path angle", "heading"),
        strict=True,
    )
)
_CHANNEL: tuple[tuple[str, str, str], ...] = tuple(
    zip(CHANNELS, ("N", "1", "rad"), ("thrust", "load factor", "bank angle"), strict=True)
)


def _reference() -> list[Variable]:
    columns = []
    for name, unit, meaning in _STATE:
        columns += [
            Variable(f"{name}_cmd_raw", unit, f"{meaning} command (44), before the command filter"),
            Variable(f"{name}_ref", unit, f"{meaning} reference, output of the command filter"),
            Variable(
                f"{name}_ref_rate",
                f"{unit}/s" if unit == "rad" else "m/s^2",
                f"rate of the {meaning} reference",
            ),
        ]
    return [
        *columns,
        Variable("north_ref", "m", "position north of the path that the references make"),
        Variable("east_ref", "m", "position east of the path that the references make"),
        Variable(
            "altitude_ref", "m", "altitude of that path, or planned where an altitude is commanded"
        ),
        Variable(
            "altitude_cmd_raw", "m", "altitude command; nan where the flight path is commanded"
        ),
    ]


def _truth() -> list[Variable]:
    return [
        *(Variable(*column) for column in _STATE),
        Variable("north", "m", "position north of the origin"),
        Variable("east", "m", "position east of the origin"),
        Variable("altitude", "m", "altitude above mean sea level"),
        Variable("thrust", "N", "delivered thrust"),
        Variable("load_factor", "1", "load factor, non-gravity force normal to the velocity over weight"),
        Variable("bank_angle", "rad", "bank angle about the velocity"),
        Variable("drag", "N", "drag"),
        Variable("mach", "1", "Mach number"),
        Variable("mass", "kg", "mass"),
        Variable("fuel", "kg", "fuel on board"),
        Variable("alpha", "rad", "angle of attack"),
        Variable("sideslip", "rad", "angle of sideslip, positive with the wind from the right"),
        Variable("roll", "rad", "Euler roll angle"),
        Variable("pitch", "rad", "Euler pitch angle"),
        Variable("yaw", "rad", "Euler yaw angle, continuous"),
        Variable("roll_rate", "rad/s", "body roll rate"),
        Variable("pitch_rate", "rad/s", "body pitch rate"),
        Variable("yaw_rate", "rad/s", "body yaw rate"),
        Variable("load_factor_x", "1", "non-gravity force along the body's x axis over weight"),
        Variable("load_factor_y", "1", "the same along the y axis, positive to the right"),
        Variable("load_factor_z", "1", "the same against the z axis, positive up"),
        Variable("wind_north", "m/s", "wind towards the north"),
        Variable("wind_east", "m/s", "wind towards the east"),
        Variable("wind_up", "m/s", "wind upwards"),
        Variable("throttle", "1", "throttle position: 1 military, 2 full reheat"),
        Variable("elevator", "rad", "elevator, positive pitches down"),
        Variable("aileron", "rad", "left aileron, positive rolls to the right"),
        Variable("rudder", "rad", "rudder, positive yaws to the left"),
        Variable("flap", "rad", "flap position that drag depends on, as aircraft.toml names it"),
        *(
            Variable(f"{name}_cmd", "rad", f"{name} where flight control sends it")
            for name in SURFACES
        ),
    ]  # fmt: skip


def _faults() -> list[Variable]:
    parts = [(f"engine_{number}", f"engine {number}") for number in range(ENGINES)]
    parts += [(name, name) for name in SURFACES]
    return [
        *(
            Variable(f"effectiveness_{name}", "1", f"effectiveness of {meaning}, the truth")
            for name, _, meaning in _CHANNEL
        ),
        *(
            Variable(f"{name}_effectiveness", "1", f"effectiveness of {text}")
            for name, text in parts
        ),
        *(
            Variable(f"{name}_state", "1", f"{text}: 0 healthy, 1 out, 2 stuck, 3 and 4 hard over")
            for name, text in parts
        ),
    ]


def _measured() -> list[Variable]:
    truth = {column.name: column for column in _truth()}
    names = [signal.column or signal.name for signal in SIGNALS]
    names += ["flight_path_angle", "heading", "load_factor", "bank_angle"]
    return [
        *(
            Variable(f"{name}_meas", truth[name].unit, f"{truth[name].meaning}, measured")
            for name in names
        ),
        Variable(
            "acceleration_meas",
            "m/s^2",
            "non-gravity force along the velocity over mass, from the accelerometers",
        ),
    ]


def _outer_loop() -> list[Variable]:
    columns = []
    for name, unit, meaning in _CHANNEL:
        columns += [
            Variable(f"{name}_cmd", unit, f"{meaning} commanded to the plant"),
            Variable(f"trim_input_{name}", unit, f"{meaning} of the trim input u_n (10)"),
            Variable(f"effectiveness_{name}_est", "1", f"effectiveness of {meaning}, estimate"),
            Variable(f"effectiveness_{name}_std", "1", f"standard deviation of effectiveness_{name}_est"),
        ]  # fmt: skip
    for name, unit, meaning in _STATE:
        columns += [
            Variable(f"{name}_est", unit, f"{meaning}, estimate"),
            Variable(f"{name}_std", unit, f"standard deviation of {name}_est"),
            Variable(f"{name}_innovation", unit, f"innovation of {meaning}"),
            Variable(f"{name}_innovation_std", unit, f"standard deviation of {name}_innovation"),
        ]
    return [
        *columns,
        Variable("acceleration_innovation", "m/s^2", "innovation of the force along the velocity"),
        Variable("acceleration_innovation_std", "m/s^2", "its standard deviation"),
        Variable("innovation_squared", "1", "normalised innovation squared"),
        Variable("load_factor_demand", "1", "load factor of the law, before the response lead"),
        Variable("bank_angle_demand", "rad", "bank angle of the law, before the response lead"),
        Variable("climb_given_up", "rad", "path angle below the reference for want of thrust"),
        Variable(
            "turn_given_up",
            "rad/s",
            "part of the heading reference's rate given up for want of thrust",
        ),
        Variable("airspeed_given_up", "m/s", "airspeed below the reference for want of thrust"),
        Variable(
            "unattainable",
            "1",
            "1 while the references cannot be flown, for thrust or the envelope",
        ),
        Variable("thrust_saturated", "1", "1 while a limit holds the thrust command"),
        Variable("load_factor_saturated", "1", "1 while a limit holds the load factor command"),
        Variable(
            "outside_range", "1", "1 while outside the range that the point mass was fitted in"
        ),
        Variable("thrust_model", "N", "thrust that the loop expects of a healthy engine"),
        Variable("fault_statistic", "1", "detector statistic; a fault is declared above 1"),
        Variable("fault_declared", "1", "1 while the detector declares a fault"),
        Variable(
            "suspect", "1", "whose fault it is believed to be: its number in the list of hypotheses"
        ),
        Variable(
            "suspect_probability", "1", "probability of that hypothesis when it was decided on"
        ),
        Variable(
            "isolation_statistic",
            "1",
            "log likelihood ratio of the best hypothesis, over its threshold",
        ),
        Variable(
            "excluded",
            "1",
            "instruments that something stands in for: bits in the order of the sensors",
        ),
    ]


VARIABLES: tuple[Variable, ...] = (
    Variable("time", "s", "time since the start"),
    *_reference(),
    *_truth(),
    *_faults(),
    *_measured(),
    *_outer_loop(),
)

ROW = np.dtype([(variable.name, float) for variable in VARIABLES])


def numbers(record: npt.NDArray[Any]) -> npt.NDArray[np.float64]:
    """(rows, columns): a recording's memory as plain numbers."""
    return record.view(np.float64).reshape(record.size, -1)
