"""What is given up where the thrust that is left cannot pay for the manoeuvre: climb, turn, height.

Not in the paper, whose law asks for what the references ask for. Here airspeed comes first. The
along-path force that full thrust can still deliver, less drag, pays for acceleration and climb; what
it cannot pay for is taken from the climb down to level flight, then from the turn, and in the end,
wings level, by a descent. What is given up comes and goes with a lag, so that nothing chatters and the
law, which is linear about u_n, gets no steps; where thrust suffices it is zero.
"""

import math
from typing import NamedTuple

from ftc_jsb.compiled import compiled
from ftc_jsb.control.law import Rates
from ftc_jsb.control.limits import PathState
from ftc_jsb.point_mass.dynamics import polar_drag
from ftc_jsb.point_mass.model import Condition
from ftc_jsb.vocabulary.kernel_types import LoopSettings, LoopState, Row, Vector

GIVING_UP = 0.5  # [s], lag
REGAINING = 2.0  # [s], lag: slower, since heading errors ask for more than they did before
RECOVERY = 0.5  # [m/s^2]: the most that regaining lost airspeed may take from climb and turn
DESCENT = math.radians(15.0)  # [rad]: the steepest descent that is chosen to keep airspeed
PUSH = 0.5  # load factor that lowering or raising the path may take
HALVINGS = 24  # of the turn's share: to 1e-7 of it


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


@compiled
def affordable(
    at: Condition,
    budget: Budget,
    airspeed: float,
    path: float,
    path_ref: float,
    acceleration_ref: float,
    acceleration: float,
    heading_rate: float,
) -> tuple[float, float]:
    """Path angle and part of the turn that a thrust can pay for in the long run.

    Args:
        at: the model at this flight condition.
        budget: with the most thrust that can be delivered.
        airspeed, path: [m/s], [rad].
        path_ref: reference [rad].
        acceleration_ref, acceleration: that of the reference, and the one that is wanted [m/s^2].
        heading_rate: wanted [rad/s].

    Returns:
        Path angle [rad] and part of the heading rate: the reference and 1 where nothing is given up.
    """
    acceleration = acceleration_ref + min(acceleration - acceleration_ref, RECOVERY)
    level = math.cos(path)
    turn = airspeed / at.gravity * level * heading_rate  # level part of the load factor
    climb = payable_climb(at, budget, airspeed, math.hypot(level, turn), acceleration)
    floor = min(path_ref, 0.0)
    if climb >= math.sin(floor):
        return min(path_ref, math.asin(climb)), 1.0
    share = _turn_share(at, budget, airspeed, level, turn, acceleration, math.sin(floor))
    if share > 0.0:
        return floor, share
    straight = payable_climb(at, budget, airspeed, level, acceleration)
    return min(max(math.asin(straight), -DESCENT), floor), 0.0


@compiled
def give_up(
    given_up: Vector, target: tuple[float, float], path_ref: float, turn_per_g: float, dt: float
) -> float:
    """Move what is given up towards a target of `affordable`; the rate of the path's part [rad/s].

    Args:
        given_up: (2,), path angle below the reference [rad] and part of the turn; advanced.
        target: path angle and part of the turn that can be paid for.
        path_ref: reference [rad].
        turn_per_g: g / V [rad/s].
        dt: sample time [s].
    """
    before = given_up[0]
    most = PUSH * turn_per_g * dt  # [rad] a sample
    for k, wanted in enumerate((path_ref - target[0], 1.0 - target[1])):
        lag = GIVING_UP if wanted > given_up[k] else REGAINING
        given_up[k] += (1.0 - math.exp(-dt / lag)) * (wanted - given_up[k])
    given_up[0] = min(max(given_up[0], before - most), before + most)
    return float((given_up[0] - before) / dt)


@compiled
def _turn_share(
    at: Condition,
    budget: Budget,
    airspeed: float,
    level: float,
    turn: float,
    acceleration: float,
    lowest: float,
) -> float:
    """Largest part of the turn at which the climb `lowest` can be paid for, by bisection."""
    if payable_climb(at, budget, airspeed, level, acceleration) < lowest:
        return 0.0
    low, high = 0.0, 1.0
    for _ in range(HALVINGS):
        middle = 0.5 * (low + high)
        climb = payable_climb(at, budget, airspeed, math.hypot(level, middle * turn), acceleration)
        if climb >= lowest:
            low = middle
        else:
            high = middle
    return low


@compiled
def put_speed_first(
    s: LoopSettings,
    x: LoopState,
    at: Condition,
    row: Row,
    state: PathState,
    budget: Budget,
    wanted: Rates,
) -> Rates:
    """Wanted rates less what is given up for want of thrust; as they are where the settings say so.

    Args:
        s, x, at, row: settings and state of the loop, model at this condition, row of the recording.
        state: airspeed and path angle that the law is evaluated at.
        budget: with the most thrust that can be delivered.
        wanted: by the references and errors.
    """
    path_rate, heading_rate = wanted.flight_path_angle, wanted.heading
    if s.speed_first == 1:
        target = affordable(
            at,
            budget,
            state.airspeed,
            state.flight_path_angle,
            row.flight_path_angle_ref,
            row.airspeed_ref_rate,
            wanted.airspeed,
            heading_rate,
        )
        per_g = at.gravity / state.airspeed
        lowering = give_up(x.given_up, target, row.flight_path_angle_ref, per_g, s.dt)
        path_rate -= lowering + s.gains[1] * x.given_up[0]
        heading_rate -= x.given_up[1] * wanted.heading
    row.climb_given_up = x.given_up[0]
    row.turn_given_up = abs(x.given_up[1] * wanted.heading)
    return Rates(wanted.airspeed, path_rate, heading_rate)
