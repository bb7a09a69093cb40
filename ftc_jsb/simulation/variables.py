"""The recording: every variable of a flight, its unit and its meaning, as one structured row."""

from typing import NamedTuple

import numpy as np


class Variable(NamedTuple):
    """A column of the recording."""

    name: str
    unit: str  # as in the NetCDF `units` attribute; "1" has no dimension
    meaning: str


_STATE = (
    ("airspeed", "m/s", "true airspeed"),
    ("flight_path_angle", "rad", "flight path angle"),
    ("heading", "rad", "heading"),
)
_CHANNEL = (
    ("thrust", "N", "thrust"),
    ("load_factor", "1", "load factor"),
    ("bank_angle", "rad", "bank angle"),
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
        Variable("altitude_ref", "m", "altitude of the path that the references make"),
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
        Variable("alpha", "rad", "angle of attack"),
        Variable("sideslip", "rad", "angle of sideslip, positive with the wind from the right"),
        Variable("roll", "rad", "Euler roll angle"),
        Variable("pitch", "rad", "Euler pitch angle"),
        Variable("yaw", "rad", "Euler yaw angle, continuous"),
        Variable("roll_rate", "rad/s", "body roll rate"),
        Variable("pitch_rate", "rad/s", "body pitch rate"),
        Variable("yaw_rate", "rad/s", "body yaw rate"),
        Variable("throttle", "1", "throttle position: 1 military, 2 full reheat"),
        Variable("elevator", "rad", "elevator, positive pitches down"),
        Variable("aileron", "rad", "left aileron, positive rolls to the right"),
        Variable("rudder", "rad", "rudder, positive yaws to the left"),
        Variable("flap", "rad", "flap position that drag depends on, as aircraft.toml names it"),
        *(
            Variable(f"effectiveness_{name}", "1", f"effectiveness of {meaning}, the truth")
            for name, _, meaning in _CHANNEL
        ),
    ]  # fmt: skip


def _measured() -> list[Variable]:
    measured = (
        "airspeed", "flight_path_angle", "heading", "north", "east", "altitude", "load_factor", "bank_angle",
        "alpha", "sideslip", "pitch_rate", "elevator", "flap",
    )  # fmt: skip
    truth = {column.name: column for column in _truth()}
    return [
        Variable(f"{name}_meas", truth[name].unit, f"{truth[name].meaning}, measured")
        for name in measured
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
        Variable("innovation_squared", "1", "normalised innovation squared"),
        Variable("load_factor_demand", "1", "load factor of the law, before the response lead"),
        Variable("bank_angle_demand", "rad", "bank angle of the law, before the response lead"),
        Variable("thrust_saturated", "1", "1 while a limit holds the thrust command"),
        Variable("load_factor_saturated", "1", "1 while a limit holds the load factor command"),
        Variable(
            "outside_range", "1", "1 while outside the range that the point mass was fitted in"
        ),
        Variable("thrust_model", "N", "thrust that the loop expects of a healthy engine"),
        Variable("fault_statistic", "1", "detector statistic; a fault is declared above 1"),
        Variable("fault_declared", "1", "1 while the detector declares a fault"),
    ]


VARIABLES: tuple[Variable, ...] = (
    Variable("time", "s", "time since the start"),
    *_reference(),
    *_truth(),
    *_measured(),
    *_outer_loop(),
)

ROW = np.dtype([(variable.name, float) for variable in VARIABLES])
