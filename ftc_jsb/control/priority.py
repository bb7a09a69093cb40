"""What is given up where the thrust that is left cannot pay for the manoeuvre: climb, turn, height.

Not in the paper, whose law asks for what the references ask for. Here airspeed comes first. The
along-path force that full thrust can still deliver, less drag, pays for acceleration and climb; what
it cannot pay for is taken from the path, down to a descent of 3 deg, then from the turn, and then,
wings level, from the path again. Where a descent of 5 deg is not enough the aircraft glides: slower
(`glide.py`), not climbing, turning gently. What is given up comes and goes with a lag, so that nothing
chatters and the law, which is linear about u_n, gets no steps; where thrust suffices it is zero.
"""

import math
from typing import NamedTuple

from ftc_jsb.compiled import compiled
from ftc_jsb.control.energy import Budget, payable_climb
from ftc_jsb.control.glide import STEEPEST, slowest_airspeed, sustainable_airspeed
from ftc_jsb.control.law import Rates
from ftc_jsb.control.limits import PathState, limits_now
from ftc_jsb.point_mass.model import Condition
from ftc_jsb.vocabulary.kernel_types import LoopSettings, LoopState, ModelRecord, Row, Vector

GIVING_UP = 0.5  # [s], lag
REGAINING = 2.0  # [s], lag: slower, since heading errors ask for more than they did before
RESERVED = 0.04  # of the airspeed reference: the most of it that is a reserve
SPENT_AT = 0.3  # [1/s]: so fast airspeed goes to the end of the reserve, and what it cannot pay for is given up
RECOVERY = 0.5  # [m/s^2]: the most that regaining lost airspeed may take from climb and turn
SHALLOW = math.radians(3.0)  # [rad]: descent that pays for a turn before the turn is given up
DESCENT = math.radians(15.0)  # [rad]: the steepest descent that is chosen to keep airspeed
PUSH = 0.5  # load factor that lowering or raising the path may take
HALVINGS = 24  # of the turn's share: to 1e-7 of it
GENTLE_TURN = math.tan(
    math.radians(25.0)
)  # level part of the load factor that a glide still turns with
LASTING = 2.0  # [s], lag of the effectiveness that a glide is decided by
SLOWER = 0.1  # [m/s] of airspeed given up, from which on it is a glide


class Request(NamedTuple):
    """What is wanted of the thrust."""

    path_ref: float  # reference [rad]
    acceleration_ref: float  # of the reference [m/s^2]
    acceleration: float  # that is wanted [m/s^2]
    heading_rate: float  # wanted [rad/s]
    turn_kept: float  # part of the turn that a descent pays for, 0 or 1


@compiled
def affordable(
    at: Condition, budget: Budget, airspeed: float, path: float, request: Request
) -> tuple[float, float]:
    """Path angle and part of the turn that a thrust can pay for in the long run.

    Args:
        at: the model at this flight condition.
        budget: with the most thrust that can be delivered.
        airspeed, path: [m/s], [rad].
        request: what is wanted.

    Returns:
        Path angle [rad] and part of the heading rate: the reference and 1 where nothing is given up.
    """
    acceleration = request.acceleration_ref
    acceleration += min(request.acceleration - request.acceleration_ref, RECOVERY)
    level = math.cos(path)
    turn = airspeed / at.gravity * level * request.heading_rate  # level part of the load factor
    climb = payable_climb(at, budget, airspeed, math.hypot(level, turn), acceleration)
    floor = min(request.path_ref, -SHALLOW)
    if climb >= math.sin(floor):
        return min(request.path_ref, math.asin(climb)), 1.0
    share = request.turn_kept
    if share == 0.0:
        share = _turn_share(at, budget, airspeed, level, turn, acceleration, math.sin(floor))
        if share > 0.0:
            return floor, share
    straight = payable_climb(at, budget, airspeed, math.hypot(level, share * turn), acceleration)
    return min(max(math.asin(straight), -DESCENT), floor), share


@compiled
def spending(s: LoopSettings, row: Row, acceleration: float) -> float:
    """Wanted acceleration [m/s^2] with the reserve of airspeed to be spent before climb and turn are given up.

    Args:
        s, row: settings of the loop, row of the recording.
        acceleration: wanted by reference and airspeed error [m/s^2].
    """
    if s.airspeed_reserve == 0.0:
        return acceleration
    recovery = acceleration - row.airspeed_ref_rate
    if recovery > 0.0:
        recovery *= SPENT_AT / s.gains[0]
    reserve = min(s.airspeed_reserve, RESERVED * row.airspeed_ref)
    return float(row.airspeed_ref_rate + recovery - SPENT_AT * reserve)


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
def put_speed_first(
    s: LoopSettings,
    m: ModelRecord,
    x: LoopState,
    at: Condition,
    row: Row,
    flight: PathState,
    effectiveness: float,
    wanted: Rates,
) -> Rates:
    """Wanted rates less what is given up for want of thrust; as they are where the settings say so.

    Args:
        s, m, x, at, row: settings, model and state of the loop, model at this condition, row of the recording.
        flight: airspeed and path angle that the law is evaluated at.
        effectiveness: of thrust.
        wanted: by the references and errors.
    """
    if s.speed_first == 0:
        row.climb_given_up, row.turn_given_up, row.airspeed_given_up = 0.0, 0.0, 0.0
        return wanted
    budget = Budget(effectiveness * at.thrust_maximum, x.sustained)
    gentlest = GENTLE_TURN * at.gravity / flight.airspeed  # [rad/s]
    gentle = min(max(wanted.heading, -gentlest), gentlest)
    give_up_airspeed(s, m, x, at, row, flight, effectiveness, gentle)
    path_ref, heading_rate, turn_kept = row.flight_path_angle_ref, wanted.heading, 0.0
    if x.given_up[2] > SLOWER:
        path_ref, heading_rate, turn_kept = min(path_ref, 0.0), gentle, 1.0
    acceleration = wanted.airspeed - s.gains[0] * x.given_up[2]
    acceleration = spending(s, row, acceleration)
    request = Request(path_ref, row.airspeed_ref_rate, acceleration, heading_rate, turn_kept)
    path, share = affordable(at, budget, flight.airspeed, flight.flight_path_angle, request)
    if wanted.heading != 0.0:
        share *= heading_rate / wanted.heading
    per_g = at.gravity / flight.airspeed
    target = (path, share)
    lowering = give_up(x.given_up, target, row.flight_path_angle_ref, per_g, s.dt)
    row.climb_given_up, row.airspeed_given_up = x.given_up[0], x.given_up[2]
    row.turn_given_up = abs(x.given_up[1] * row.heading_ref_rate)
    return Rates(
        wanted.airspeed,
        wanted.flight_path_angle - (lowering + s.gains[1] * x.given_up[0]),
        wanted.heading - x.given_up[1] * wanted.heading,
    )


@compiled
def give_up_airspeed(
    s: LoopSettings,
    m: ModelRecord,
    x: LoopState,
    at: Condition,
    row: Row,
    flight: PathState,
    effectiveness: float,
    heading_rate: float,
) -> None:
    """Move the airspeed that is given up towards what the thrust left asks for.

    By an effectiveness that lasts: an estimate in turbulence may be low for a moment.
    """
    airspeed, wanted = flight.airspeed, 0.0
    x.lasting += (1.0 - math.exp(-s.dt / LASTING)) * (min(effectiveness, 1.0) - x.lasting)
    budget = Budget(x.lasting * at.thrust_maximum, x.sustained)
    load_factor = math.hypot(1.0, airspeed / at.gravity * heading_rate)
    steepest = min(STEEPEST, math.sin(row.flight_path_angle_ref))
    sinking = payable_climb(at, budget, airspeed, load_factor, 0.0) < steepest
    if sinking or x.given_up[2] > SLOWER:
        limits = limits_now(s, m, at, airspeed)
        slowest = slowest_airspeed(m, limits, airspeed, at.sound_speed)
        beyond = budget.unpaid / (airspeed * airspeed)
        fastest = max(row.airspeed_ref, slowest)
        kept = sustainable_airspeed(
            m, x.known.altitude, x.lasting, beyond, load_factor, steepest, slowest, fastest
        )
        wanted = max(row.airspeed_ref - kept, 0.0)
    lag = GIVING_UP if wanted > x.given_up[2] else REGAINING
    x.given_up[2] += (1.0 - math.exp(-s.dt / lag)) * (wanted - x.given_up[2])


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
