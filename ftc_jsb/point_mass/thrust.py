"""Thrust of a healthy engine: what a command asks for, and how fast it comes.

Two-stage turbofan as JSBSim's FGTurbine has it: dry thrust goes from idle to military with the
square of the normalised rotor speed, which is rate limited; reheat adds to it at once.
"""

import math
from typing import Any

from ftc_jsb.compiled import compiled
from ftc_jsb.point_mass.model import Condition

IDLE_DOUBT = 0.01  # of the span from idle to military: what the deck's idle thrust may be off by
RATE_DOUBT = 0.05  # of the spool's rate


@compiled
def rotor_speed_target(at: Condition, thrust_cmd: float) -> float:
    """Normalised rotor speed (0 idle, 1 military) at which dry thrust is `thrust_cmd` [N]."""
    span = at.thrust_military - at.thrust_idle
    if span <= 0.0:
        return 1.0
    return math.sqrt(min(max((thrust_cmd - at.thrust_idle) / span, 0.0), 1.0))


@compiled
def spool_rate(model: Any, rotor_speed: float, density: float, accelerating: bool) -> float:
    """Largest rate of normalised rotor speed [1/s]; 0 stands for no limit.

    rate = c0 / (1 + c1 (1 - min(1, N + 0.1))^3 + c2 (1 - rho / 1.225)): the form of JSBSim's
    FGSpoolUp, with c0..c2 identified from throttle steps.
    """
    c = model.spool_up if accelerating else model.spool_down
    lag = 1.0 - min(1.0, rotor_speed + 0.1)
    return float(c[0] / (1.0 + c[1] * lag * lag * lag + c[2] * (1.0 - density / 1.225)))


@compiled
def next_rotor_speed(
    model: Any, at: Condition, rotor_speed: float, thrust_cmd: float, dt: float
) -> float:
    """Normalised rotor speed after `dt` seconds at a held thrust command [N]."""
    target = rotor_speed_target(at, thrust_cmd)
    rate = spool_rate(model, rotor_speed, at.density, target > rotor_speed)
    if rate <= 0.0:
        return target
    return rotor_speed + min(max(target - rotor_speed, -rate * dt), rate * dt)


@compiled
def healthy_thrust(at: Condition, rotor_speed: float, thrust_cmd: float) -> float:
    """Thrust [N] of a healthy engine at a rotor speed, with the reheat that the command calls for.

    Where nothing is rate limited this is `thrust_cmd` within idle and maximum.
    """
    dry = at.thrust_idle + (at.thrust_military - at.thrust_idle) * rotor_speed * rotor_speed
    span = at.thrust_maximum - at.thrust_military
    if span <= 0.0:
        return dry
    reheat = min(max((thrust_cmd - at.thrust_military) / span, 0.0), 1.0)
    return dry + reheat * (at.thrust_maximum - dry)


@compiled
def other_rotor_speed(
    model: Any, at: Condition, rotor_speed: float, thrust_cmd: float, dt: float
) -> float:
    """`next_rotor_speed` of the same engine if the deck's idle thrust and the spool's rate are a little wrong.

    Two rotors that begin at the same thrust and spool differ the more the nearer to idle they began; once they
    have come to what is commanded they agree again.

    Args:
        model, at, rotor_speed, thrust_cmd, dt: as `next_rotor_speed` takes them.
    """
    idle = at.thrust_idle - IDLE_DOUBT * (at.thrust_military - at.thrust_idle)
    span = max(at.thrust_military - idle, 1.0)
    target = math.sqrt(min(max((thrust_cmd - idle) / span, 0.0), 1.0))
    rate = spool_rate(model, rotor_speed, at.density, target > rotor_speed) * (1.0 + RATE_DOUBT)
    return rotor_speed + min(max(target - rotor_speed, -rate * dt), rate * dt)


@compiled
def thrust_doubt(at: Condition, rotor_speed: float, other: float) -> float:
    """What dry thrust [N] may be off by: the difference of two rotors, the other one of `other_rotor_speed`."""
    span = at.thrust_military - at.thrust_idle
    lower = IDLE_DOUBT * span
    return abs(span * (other * other - rotor_speed * rotor_speed) - lower * (1.0 - other * other))
