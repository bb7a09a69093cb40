"""Models and conditions that the point-mass tests share."""

import math
from typing import Any

from ftc_jsb.aircraft.point_mass_file import load_point_mass
from ftc_jsb.compiled import compiled
from ftc_jsb.control.law import Inputs, Rates, airspeed_row, control_law
from ftc_jsb.point_mass.drag import angle_of_attack, drag_coefficient, drag_slope
from ftc_jsb.point_mass.dynamics import derivatives, level_trim_thrust, polar_drag
from ftc_jsb.point_mass.model import at_condition
from ftc_jsb.resources import aircraft_folder

AIRCRAFT = load_point_mass(aircraft_folder("paper"))
PAPER = AIRCRAFT.record(0.0)
F16 = load_point_mass(aircraft_folder("f16")).record(0.43)

MODELS = {"paper": PAPER, "f16": F16}

# A `Condition` stays inside compiled code; these take it there.


@compiled
def rates(model: Any, v: float, h: float, path: float, t: float, n: float, bank: float) -> Any:
    at = at_condition(model[0], v, h)
    turns = (math.cos(path), math.sin(path), t, n, math.cos(bank), math.sin(bank))
    return derivatives(at, v, *turns)


@compiled
def drag(model: Any, v: float, h: float, thrust: float, n: float) -> float:
    return polar_drag(at_condition(model[0], v, h), v, thrust, n)[0]


@compiled
def polar(model: Any, v: float, h: float, lift: float) -> Any:
    at = at_condition(model[0], v, h)
    return drag_coefficient(at, lift), drag_slope(at, lift)


@compiled
def polar_and_alpha(model: Any, v: float, h: float, lift: float) -> Any:
    at = at_condition(model[0], v, h)
    return drag_coefficient(at, lift), angle_of_attack(at, lift)


@compiled
def trim(model: Any, v: float, h: float, path: float) -> float:
    return level_trim_thrust(at_condition(model[0], v, h), v, path)


@compiled
def force_row(model: Any, v: float, h: float, thrust: float, n: float) -> Any:
    return airspeed_row(at_condition(model[0], v, h), v, thrust, n)


@compiled
def law(
    model: Any, v: float, h: float, path: float, trim_input: Any, k: Any, wanted: Any
) -> tuple[float, float, float]:
    at = at_condition(model[0], v, h)
    trim = Inputs(trim_input[0], trim_input[1], trim_input[2])
    effectiveness = Inputs(k[0], k[1], k[2])
    rates = Rates(wanted[0], wanted[1], wanted[2])
    return control_law(at, v, path, trim, effectiveness, rates)
