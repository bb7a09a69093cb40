"""What a policy sees and says, as vectors: the same in the environment and in a loop that flies a policy."""

import math
from typing import NamedTuple

import numpy as np
import numpy.typing as npt

from ftc_jsb.control.protocol import Command, LoopSetup, Measurement, Reference

Vector = npt.NDArray[np.float32]
STEEPEST_BANK = math.radians(80.0)
WHOLE_FUEL = 1.0  # ranges do not depend on the fuel


class Component(NamedTuple):
    """A number of the observation, divided by its scale and bounded to +-LARGEST."""

    name: str
    unit: str
    scale: float


LARGEST = 20.0  # scales: beyond, a policy learns no more
COMPONENTS = (
    Component("airspeed error", "m/s", 5.0),
    Component("flight path error", "rad", 0.05),
    Component("heading error", "rad", 0.1),
    Component("airspeed reference rate", "m/s2", 5.0),
    Component("flight path reference rate", "rad/s", 0.05),
    Component("heading reference rate", "rad/s", 0.1),
    Component("airspeed above 250", "m/s", 100.0),
    Component("flight path angle", "rad", 0.5),
    Component("altitude above 5000", "m", 5000.0),
    Component("load factor above 1", "1", 2.0),
    Component("bank angle", "rad", 1.0),
)
_SCALES = np.array([component.scale for component in COMPONENTS])


def observation(measurement: Measurement, reference: Reference) -> Vector:
    """What a policy sees; an error is measured minus reference.

    Returns:
        (len(COMPONENTS),), finite and within +-LARGEST whatever was measured: not a number is 0.
    """
    m, r = measurement, reference
    values = (
        m.airspeed - r.airspeed,
        m.flight_path_angle - r.flight_path_angle,
        m.heading - r.heading,
        r.airspeed_rate,
        r.flight_path_angle_rate,
        r.heading_rate,
        m.airspeed - 250.0,
        m.flight_path_angle,
        m.altitude - 5000.0,
        m.load_factor - 1.0,
        m.bank_angle,
    )
    scaled = np.array(values) / _SCALES
    bounded = np.clip(np.nan_to_num(scaled, nan=0.0), -LARGEST, LARGEST)
    seen: Vector = bounded.astype(np.float32)
    return seen


class ActionRanges(NamedTuple):
    """What actions of -1 and 1 mean."""

    thrust: float  # at 1, healthy [N]; 0 at -1
    load_factor_min: float  # at -1; 1 g at 0
    load_factor_max: float  # at 1
    bank_angle: float = STEEPEST_BANK  # at 1 [rad]


def action_ranges(setup: LoopSetup) -> ActionRanges:
    """Ranges of an aircraft."""
    model = setup.aircraft.record(WHOLE_FUEL)[0]
    return ActionRanges(
        float(np.max(model["thrust_maximum"])),
        float(model["load_factor_min"]),
        float(model["load_factor_max"]),
    )


def action_command(action: npt.ArrayLike, ranges: ActionRanges) -> Command:
    """The command of an action, (3,) of thrust, load factor and bank, each -1 to 1."""
    thrust, load, bank = (float(part) for part in np.clip(np.asarray(action, float), -1.0, 1.0))
    reach = ranges.load_factor_max - 1.0 if load > 0.0 else 1.0 - ranges.load_factor_min
    return Command(
        0.5 * (1.0 + thrust) * ranges.thrust, 1.0 + load * reach, bank * ranges.bank_angle
    )
