"""What a thrust can pay for: the energy balance along the path."""

import math
from typing import NamedTuple

from ftc_jsb.compiled import compiled
from ftc_jsb.point_mass.dynamics import polar_drag
from ftc_jsb.point_mass.model import Condition


class Budget(NamedTuple):
    """What there is to pay with for acceleration, climb and turn."""

    thrust: float  # that can be delivered, effectiveness included [N]
    unpaid: float  # deceleration by drag that the polar does not know of [m/s^2]


@compiled
def payable_climb(
    at: Condition, budget: Budget, airspeed: float, load_factor: float, acceleration: float
) -> float:
    """Sine of the path angle at which a budget still gives an acceleration [m/s^2]."""
    thrust = budget.thrust
    drag, alpha = polar_drag(at, airspeed, thrust, load_factor)
    force = (thrust * math.cos(alpha) - drag) / at.mass - budget.unpaid
    climb = (force - acceleration) / at.gravity
    return float(min(max(climb, -1.0), 1.0))
