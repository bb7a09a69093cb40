"""The fields of both lines of the exchange, in their order: docs/flightgear.md has them as a page.

A line from the simulator says what is flown; a line to it says what is commanded. Each field is a JSBSim
property of the woven aircraft, so that the simulator's part of the exchange is JSBSim's alone.
"""

from typing import NamedTuple

from ftc_jsb.aircraft.description import Aircraft
from ftc_jsb.six_dof.observation import POSITION_NAMES, PROPERTIES
from ftc_jsb.six_dof.weaving.engine_deck import EFFECTIVENESS
from ftc_jsb.six_dof.weaving.faults import (
    THROTTLE_STATE,
    observed,
    surface_effectiveness,
    surface_state,
)
from ftc_jsb.vocabulary.channels import ENGINES, SURFACES

LINK, RECEIVED = "ftc/link", "ftc/received"  # a line as it comes; the last one that was accepted
ABSENT = "ftc/exchange/absent"  # 0: of an engine that is not there


class Field(NamedTuple):
    """A number of a line."""

    name: str
    property: str  # of JSBSim
    meaning: str  # with its unit


PARTS = (*(f"engine_{number}" for number in range(ENGINES)), *SURFACES)
FAULTS = (*(f"{part}_effectiveness" for part in PARTS), *(f"{part}_state" for part in PARTS))


def _fault_meaning(name: str) -> str:
    part, _, what = name.rpartition("_")
    part = part.replace("_", " ")
    if what == "effectiveness":
        return f"what is left of {part}, 1 = healthy"
    return f"{part}: 0 healthy, 1 out, 2 stuck, 3 and 4 hard over"


COMMANDED = (  # from the outer loop to the simulator; `check` follows
    Field("sequence", f"{LINK}/sequence", "number of the line, from 1, one more each line"),
    Field("frame", f"{LINK}/frame", "frame of the simulator's line that this one answers"),
    Field("flies", f"{LINK}/flies", "1: the outer loop flies; 0: it leaves"),
    *(
        Field(name, f"{LINK}/{name.replace('_', '-')}", meaning)
        for name, meaning in (
            ("thrust_cmd", "thrust that a healthy engine would deliver [N]"),
            ("load_factor_cmd", "load factor"),
            ("bank_angle_cmd", "bank angle about the velocity [rad]"),
            ("airspeed_ref", "airspeed reference [m/s]"),
            ("flight_path_angle_ref", "flight path reference [rad]"),
            ("heading_ref", "heading reference [rad]"),
            ("effectiveness_thrust_est", "estimated effectiveness of thrust"),
            ("effectiveness_thrust_std", "its standard deviation"),
            ("fault_declared", "1 while a fault is declared"),
            (
                "suspect",
                "whose fault it is believed to be, by number: 0 nobody's, 1 thrust, 2 ... instruments",
            ),
            ("suspect_probability", "probability of that"),
            ("delay", "of the last command, from the frame it answers to its own [s]"),
        )
    ),
    *(Field(name, f"{LINK}/{name.replace('_', '-')}", _fault_meaning(name)) for name in FAULTS),
)
CHECK = Field("check", f"{LINK}/check", "sum of every field times its place, from 1")

# A system of the aircraft, which writes the line, sees forces before the frame has made them
LOAD_FACTORS = {  # property that is observed: property of the line, times weight
    "forces/fbx-total-lbs": ("accelerations/Nx", 1.0),
    "forces/fby-total-lbs": ("accelerations/Ny", 1.0),
    "forces/fbz-total-lbs": ("accelerations/Nz", -1.0),
}
EXCHANGED = tuple(LOAD_FACTORS[name][0] if name in LOAD_FACTORS else name for name in PROPERTIES)

_MEANINGS = {
    "velocities/vt-fps": "true airspeed [ft/s]",
    "velocities/mach": "Mach number",
    "aero/alpha-rad": "angle of attack [rad]",
    "aero/beta-rad": "angle of sideslip [rad]",
    "attitude/phi-rad": "Euler roll angle [rad]",
    "attitude/theta-rad": "Euler pitch angle [rad]",
    "attitude/psi-rad": "Euler yaw angle, true north [rad]",
    "velocities/p-rad_sec": "body roll rate [rad/s]",
    "velocities/q-rad_sec": "body pitch rate [rad/s]",
    "velocities/r-rad_sec": "body yaw rate [rad/s]",
    "accelerations/Nx": "non-gravity force over weight, forward",
    "accelerations/Nz": "the same, up",
    "position/h-sl-ft": "altitude above sea level [ft]",
    "position/ecef-x-ft": "position, Earth-centred, Earth-fixed [ft]",
    "position/ecef-y-ft": "the same, y [ft]",
    "position/ecef-z-ft": "the same, z [ft]",
    "inertia/weight-lbs": "weight [lbs]",
    "forces/fwx-aero-lbs": "drag [lbs]",
    "accelerations/Ny": "non-gravity force over weight, to the right",
    "atmosphere/total-wind-north-fps": "wind towards the north [ft/s]",
    "atmosphere/total-wind-east-fps": "wind towards the east [ft/s]",
    "atmosphere/total-wind-down-fps": "wind downwards [ft/s]",
    "propulsion/total-fuel-lbs": "fuel on board [lbs]",
}


def fault_property(name: str, engines: int) -> str:
    """Woven property of a fault column, such as `engine_0_effectiveness`; ABSENT: no such engine."""
    part, _, what = name.rpartition("_")
    if part.startswith("engine_"):
        number = int(part.removeprefix("engine_"))
        own = EFFECTIVENESS if what == "effectiveness" else THROTTLE_STATE
        return f"{own}[{number}]" if number < engines else ABSENT
    return surface_effectiveness(part) if what == "effectiveness" else surface_state(part)


def measured_fields(aircraft: Aircraft, engines: int) -> tuple[Field, ...]:
    """Fields of the simulator's line, `check` apart, in their order; names are the same for every aircraft.

    Args:
        aircraft: whose control positions are read.
        engines: that it has.
    """
    thrusts = [
        f"propulsion/engine[{number}]/thrust-lbs" if number < engines else ABSENT
        for number in range(ENGINES)
    ]
    return (
        Field("frame", "simulation/frame", "frames that JSBSim has flown: the line's number"),
        Field("time", "simulation/sim-time-sec", "simulation time [s]"),
        Field("frame_time", "simulation/dt", "time of a frame [s]"),
        *(Field(name.rpartition("/")[2], name, _MEANINGS[name]) for name in EXCHANGED),
        *(
            Field(
                name, observed(aircraft, getattr(aircraft.positions, name)), f"position of {name}"
            )
            for name in POSITION_NAMES
        ),
        *(
            Field(f"thrust_{number}", name, f"delivered thrust of engine {number} [lbs]")
            for number, name in enumerate(thrusts)
        ),
        *(Field(name, fault_property(name, engines), _fault_meaning(name)) for name in FAULTS),
        Field("thrust_in_force", "ftc/command/thrust-n", "thrust command that is in force [N]"),
        Field("load_factor_in_force", "ftc/command/load-factor", "load factor in force"),
        Field("bank_angle_in_force", "ftc/command/bank-rad", "bank angle in force [rad]"),
        Field("impulse", "ftc/exchange/impulse-n-s", "thrust command in force, over time [N s]"),
        Field("sequence", f"{RECEIVED}/sequence", "of the last line that was accepted; 0 = none"),
        Field("answered", f"{RECEIVED}/frame", "frame that it answers"),
        Field("accepted_frame", f"{RECEIVED}/at-frame", "frame at which it was accepted"),
        Field("refused", f"{RECEIVED}/refused", "lines that were late, disordered or malformed"),
        Field("flying", "ftc/flying", "0 nobody, 1 the outer loop, 2 the inner loop alone"),
        Field("pilot", "ftc/pilot/has", "1 while the pilot moves the references"),
        Field("pilot_airspeed", "ftc/pilot/airspeed-mps", "the pilot's airspeed reference [m/s]"),
        Field("pilot_path", "ftc/pilot/path-rad", "the pilot's flight path reference [rad]"),
        Field("pilot_bank", "ftc/pilot/bank-rad", "the pilot's bank reference [rad]"),
    )


MEASURED_CHECK = Field("check", "ftc/exchange/check", CHECK.meaning)
