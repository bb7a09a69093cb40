"""The airspeed to fly where what is left of the thrust holds the reference's only in a dive.

Not in the paper. Airspeed is kept by a descent of up to 5 deg. Where that is not enough it is given up, down to
the highest at which 5 deg are enough; where none is, to the one that glides farthest.
"""

import math

from ftc_jsb.compiled import compiled
from ftc_jsb.control.energy import Budget, payable_climb
from ftc_jsb.control.limits import Limits
from ftc_jsb.point_mass.model import at_condition
from ftc_jsb.vocabulary.kernel_types import ModelRecord

STEEPEST = -math.sin(math.radians(5.0))  # path of the descent that keeps airspeed
STALL_MARGIN = 1.3  # times the stalling speed: the slowest that is chosen
KNOTS = 16  # airspeeds that are tried


@compiled
def sustainable_airspeed(
    m: ModelRecord,
    altitude: float,
    effectiveness: float,
    drag_beyond: float,
    load_factor: float,
    steepest: float,
    slowest: float,
    fastest: float,
) -> float:
    """The highest airspeed [m/s] that a descent holds, or the one of the shallowest descent.

    Args:
        m: the model that the loop counts on.
        altitude: [m].
        effectiveness: of thrust.
        drag_beyond: deceleration by drag that the polar does not know of, over airspeed squared [1/m].
        load_factor: that is flown.
        steepest: sine of the steepest descent that may keep airspeed, negative.
        slowest, fastest: range of airspeeds [m/s].
    """
    step = (fastest - slowest) / (KNOTS - 1)
    best, shallowest, before = fastest, -2.0, 0.0
    for k in range(KNOTS):
        airspeed = fastest - k * step
        at = at_condition(m, airspeed, altitude)
        budget = Budget(effectiveness * at.thrust_maximum, drag_beyond * airspeed * airspeed)
        climb = payable_climb(at, budget, airspeed, load_factor, 0.0)
        if climb >= steepest:
            if k == 0:
                return airspeed
            return airspeed + step * (climb - steepest) / (climb - before)
        if climb > shallowest:
            best, shallowest = airspeed, climb
        before = climb
    return best


@compiled
def slowest_airspeed(m: ModelRecord, limits: Limits, airspeed: float, sound_speed: float) -> float:
    """The least airspeed [m/s] to glide at: above the stall, inside the range of the fit."""
    stall = airspeed / math.sqrt(max(limits.lift_factor, 1e-3))
    return float(max(STALL_MARGIN * stall, m.valid_mach[0] * sound_speed))
