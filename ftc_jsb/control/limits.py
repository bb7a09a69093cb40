"""What the aircraft may be asked for at a flight condition, and the state that the law is evaluated at."""

import math
from typing import NamedTuple

from ftc_jsb.compiled import compiled
from ftc_jsb.control.upright import BANK_MAX
from ftc_jsb.point_mass.dynamics import load_factor_limit
from ftc_jsb.point_mass.model import Condition
from ftc_jsb.vocabulary.kernel_types import LoopSettings, ModelRecord

NEGATIVE_LIFT = 0.5  # of the largest lift coefficient: what wings give when pushed


class PathState(NamedTuple):
    """State of (41) that the law is evaluated at."""

    airspeed: float  # [m/s]
    flight_path_angle: float  # [rad]


class Limits(NamedTuple):
    """What the aircraft may be asked for."""

    load_factor_min: float
    load_factor_max: float
    lift_factor: float  # load factor at the largest lift coefficient, whatever the structure bears
    bank_max: float  # [rad]


@compiled
def limits_now(s: LoopSettings, m: ModelRecord, at: Condition, airspeed: float) -> Limits:
    """Load factors between the structure's limits and what lift can give; bank as the loop flies it."""
    most = load_factor_limit(at, airspeed, m.load_factor_max, m.lift_coefficient_max)
    lift = load_factor_limit(at, airspeed, math.inf, m.lift_coefficient_max)
    if s.upright == 0:
        return Limits(m.load_factor_min, most, lift, math.pi)
    return Limits(max(m.load_factor_min, -NEGATIVE_LIFT * lift), most, lift, BANK_MAX)
