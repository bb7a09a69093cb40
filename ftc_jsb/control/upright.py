"""Load factor and bank of an aircraft that stays upright: the lift vector of (41), without its branches.

The second and third row of (41) ask for a lift vector: n cos(mu) = c against gravity and n sin(mu) = s across
the path. (n, mu) and (-n, mu + pi) are the same vector, the bank column of G in (14) vanishes at n = 0, and
nothing in the law chooses between the two. Here bank is less than 90 deg, whatever is wanted, as

    mu = atan2(s, max(|c|, floor)),

continuous in c and s everywhere, and the load factor is what serves the wanted vector best at the bank that is
there. Where c is above the floor and bank has come, this is the exact inverse. Where the path is to be pushed
down, bank goes to level and the load factor down to its limit.
"""

import math

from ftc_jsb.compiled import compiled
from ftc_jsb.control.law import Rates, airspeed_row
from ftc_jsb.point_mass.dynamics import path_rates
from ftc_jsb.point_mass.model import Condition

FLOOR = 0.6  # [-], of the lift against gravity that bank is chosen by: a gust or a push is no steep turn
GLIDE_FLOOR = 0.3  # [-], the same in a glide, which asks for gentle turns only
BANK_MAX = math.radians(85.0)  # [rad]: a level turn of 11 g


@compiled
def wanted_lift(
    at: Condition, airspeed: float, path: float, wanted: Rates, least: float, most: float
) -> tuple[float, float]:
    """Wanted lift over weight, against gravity and across the path, within the load factor's limits.

    What holds the path comes first: the turn has what is left of the largest load factor.

    Args:
        at: the model at this flight condition.
        airspeed, path: [m/s], [rad].
        wanted: rates.
        least, most: load factors.
    """
    up = math.cos(path) + airspeed / at.gravity * wanted.flight_path_angle
    across = airspeed / at.gravity * math.cos(path) * wanted.heading
    up = min(max(up, least), most)
    room = math.sqrt(max(most * most - up * up, 0.0))
    return up, min(max(across, -room), room)


@compiled
def upright_bank(up: float, across: float, floor: float) -> float:
    """Bank angle [rad] that a wanted lift vector asks for, never beyond BANK_MAX.

    Args:
        up, across: of `wanted_lift`.
        floor: least lift against gravity that counts, FLOOR or GLIDE_FLOOR.
    """
    bank = math.atan2(across, max(abs(up), floor))
    return min(max(bank, -BANK_MAX), BANK_MAX)


@compiled
def load_factor_at_bank(up: float, across: float, bank: float, path_share: float) -> float:
    """Load factor that serves a wanted lift vector best at a bank angle.

    Least squares of n (cos(bank), sin(bank)) against (up, across); the error across the path counts
    1 - path_share of the one against gravity.

    Args:
        up, across: of `wanted_lift`.
        bank: that is there now [rad].
        path_share: 0, both alike, to 1, the path alone.
    """
    cosine, sine = math.cos(bank), math.sin(bank)
    turn = 1.0 - path_share
    return (up * cosine + turn * across * sine) / (cosine * cosine + turn * sine * sine)


@compiled
def thrust_for_acceleration(
    at: Condition,
    airspeed: float,
    path: float,
    trim_thrust: float,
    effectiveness: float,
    load_factor: float,
    acceleration: float,
) -> float:
    """Thrust command [N] that gives an acceleration: the first row of (20), at the load factor that is flown.

    Args:
        at: the model at this flight condition.
        airspeed, path: [m/s], [rad].
        trim_thrust: u_n of (10) [N].
        effectiveness: of thrust.
        load_factor: that is demanded.
        acceleration: wanted [m/s^2].
    """
    thrust = effectiveness * trim_thrust
    force, force_to_thrust, _ = airspeed_row(at, airspeed, thrust, load_factor)
    rates = path_rates(at, airspeed, math.cos(path), math.sin(path), force, load_factor, 1.0, 0.0)
    step = at.mass * (acceleration - rates[0]) / force_to_thrust
    return trim_thrust + step / effectiveness
