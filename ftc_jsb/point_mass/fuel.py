"""Fuel that an engine burns, and the mass that is left: for the plant, and for the loop that follows it."""

import math
from typing import Any

from ftc_jsb.compiled import compiled, inlined
from ftc_jsb.point_mass.model import Condition

SEA_LEVEL_SOUND_SPEED = 340.294  # [m/s]


@inlined
def fuel_on_board(model: Any) -> float:
    """Fuel [kg] that is left; nan of an aircraft that burns none."""
    return model.mass - model.mass_empty if model.fuel_flow[3] > 0.0 else math.nan


@compiled
def settled_fuel_flow(
    model: Any, at: Condition, rotor_speed: float, thrust: float, thrust_cmd: float
) -> float:
    """Fuel [kg/s] that all engines burn where thrust has long been the same.

    Dry c0 sqrt(T/T0) (1 + c1 (1 - N)^2) a newton, with the temperature over that of sea level: the form of
    JSBSim's FGSimplifiedTSFC, with c0 and c1 identified. In reheat c2 a newton. Never less than c3, idling.

    Args:
        model: one MODEL record.
        at: the same at the Mach number and altitude.
        rotor_speed: normalised, 0 idle to 1 military.
        thrust: that the engines give [N].
        thrust_cmd: commanded [N]; beyond military reheat is lit.
    """
    c = model.fuel_flow
    flow = c[2] * thrust
    if thrust_cmd <= at.thrust_military:
        slow = 1.0 - rotor_speed
        warm = at.sound_speed / SEA_LEVEL_SOUND_SPEED
        flow = c[0] * warm * (1.0 + c[1] * slow * slow) * thrust
    return float(max(flow, c[3]))


@compiled
def burn_fuel(
    model: Any,
    at: Condition,
    flow: float,
    rotor_speed: float,
    thrust: float,
    thrust_cmd: float,
    dt: float,
) -> float:
    """Take from the mass of `model` what `dt` seconds burn, down to dry tanks; the flow [kg/s] at their end.

    The flow goes to the settled one no faster than the identified rates allow, as that of JSBSim's FGTurbine:
    short bursts of reheat burn far less than long ones.

    Args:
        model: one MODEL record, changed.
        at, rotor_speed, thrust, thrust_cmd: as `settled_fuel_flow`.
        flow: at the start [kg/s].
        dt: [s].
    """
    if model.fuel_flow[3] <= 0.0:
        return 0.0
    settled = settled_fuel_flow(model, at, rotor_speed, thrust, thrust_cmd)
    rate = model.fuel_flow_rate
    up = rate[0] if thrust_cmd <= at.thrust_military else rate[1]
    after = flow + min(max(settled - flow, -rate[2] * dt), up * dt)
    after = float(max(after, model.fuel_flow[3]))
    model.mass = max(model.mass - 0.5 * dt * (flow + after), model.mass_empty)
    return after
