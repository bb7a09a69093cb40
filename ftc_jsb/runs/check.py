"""What can be seen before flying: whether the aircraft, faults and loops of a scenario are there."""

from ftc_jsb.aircraft.description import load_aircraft
from ftc_jsb.control.protocol import LoopSetup
from ftc_jsb.loops.built_in import BUILT_IN
from ftc_jsb.loops.code import imported_from, is_code
from ftc_jsb.loops.fence import fenced
from ftc_jsb.loops.registry import make_loop
from ftc_jsb.resources import PAPER_AIRCRAFT, aircraft_folder
from ftc_jsb.scenario.schema import Scenario
from ftc_jsb.simulation.admissible_faults import refuse_unflyable
from ftc_jsb.simulation.assembly import point_mass_of


def check_scenario(scenario: Scenario, allow_code: bool = True) -> list[str]:
    """See that the aircraft and loops of a scenario exist; a line for each thing found good.

    Args:
        scenario: as loaded.
        allow_code: import loops that are not built in; otherwise a line says what would be imported.

    Raises:
        UserError: one of them does not.
    """
    lines = [f"scenario {scenario.name!r}: {scenario.duration:g} s, {scenario.samples} samples"]
    models = dict.fromkeys((scenario.model, *scenario.compare.models))
    for model in models:
        point_mass_of(scenario.model_copy(update={"model": model}))
        refuse_unflyable(scenario.model_copy(update={"model": model}))
        if model == "jsbsim":
            lines.append(f"model {model}: {_trimmed(scenario)}, woven, loaded and trimmed")
        else:
            name = PAPER_AIRCRAFT if model == "paper" else scenario.aircraft.name
            lines.append(f"model {model}: point mass of {aircraft_folder(name).name}")
    for loop in dict.fromkeys((scenario.loop.name, *scenario.compare.loops)):
        named = scenario.loop.model_copy(update={"name": loop})
        fly_ready = scenario.model_copy(update={"loop": named})
        aircraft = point_mass_of(fly_ready)
        mass = aircraft.initial_mass(scenario.aircraft.fuel_fraction)
        if is_code(loop) and not allow_code:
            lines.append(f"loop {loop}: not looked into; would import {imported_from(loop)}")
            continue
        if loop not in BUILT_IN:
            with fenced():
                make_loop(LoopSetup(aircraft, mass, named, 1.0 / named.rate, scenario.sensors))
        lines.append(f"loop {loop}: found and built")
    return lines


def _trimmed(scenario: Scenario) -> str:
    """Weave, load and trim the aircraft of a scenario; its title."""
    from ftc_jsb.six_dof.trim import trimmed
    from ftc_jsb.six_dof.weaving.woven_aircraft import woven_aircraft

    aircraft = load_aircraft(scenario.aircraft.name)
    root = woven_aircraft(aircraft, scenario.aircraft.flight_control == "corrected")
    dt = 1.0 / (scenario.loop.rate * scenario.simulation.jsbsim_steps)
    trimmed(aircraft, root, dt, scenario.initial, scenario.aircraft.fuel_fraction)
    return aircraft.title
