"""The signals that an aircraft measures: what a sensor can be given, and what can fail."""

from typing import NamedTuple


class Signal(NamedTuple):
    """One measured quantity: a column of the recording and a key of [sensors]."""

    name: str
    angle: bool = False  # rad in the recording, degrees in files
    column: str = ""  # of the recording, where its name is another


SIGNALS: tuple[Signal, ...] = (
    Signal("airspeed"),
    Signal("altitude"),
    Signal("alpha", True),
    Signal("sideslip", True),
    Signal("roll", True),
    Signal("pitch", True),
    Signal("yaw", True),
    Signal("roll_rate", True),
    Signal("pitch_rate", True),
    Signal("yaw_rate", True),
    Signal("load_factor_x"),
    Signal("load_factor_y"),
    Signal("load_factor_z"),
    Signal("north"),
    Signal("east"),
    Signal("elevator_position", True, "elevator"),
    Signal("flap_position", True, "flap"),
    Signal("aileron_position", True, "aileron"),
    Signal("rudder_position", True, "rudder"),
)
SENSED: tuple[str, ...] = tuple(signal.name for signal in SIGNALS)
ANGLES: frozenset[str] = frozenset(signal.name for signal in SIGNALS if signal.angle)
