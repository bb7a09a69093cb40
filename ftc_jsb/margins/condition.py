"""Straight and level flight of an aircraft or a scenario, with the loop as it is flown."""

from pathlib import Path

from pydantic import ValidationError

from ftc_jsb.errors import ScenarioError, UserError
from ftc_jsb.resources import aircraft_folder
from ftc_jsb.scenario.load import load_scenario, scenario_names
from ftc_jsb.scenario.reference import Reference
from ftc_jsb.scenario.schema import AircraftChoice, Initial, Model, Scenario
from ftc_jsb.typed_file import first_problem


def level_scenario(
    name: str, model: Model, airspeed: float | None = None, altitude: float | None = None
) -> Scenario:
    """Clean air, perfect sensors, no fault, constant references.

    Args:
        name: a scenario (path or shipped), whose aircraft, loop, speed and altitude are taken; or an
            aircraft (name or folder), with the default loop at the middle of its test range.
        model: what is flown.
        airspeed: [m/s], in place of that.
        altitude: [m].

    Raises:
        UserError: neither a scenario nor an aircraft; or one that the model does not fly.
    """
    if name in scenario_names() or Path(name).suffix == ".toml":
        base = load_scenario(name)
        meant = {base.model, *base.compare.models}
    else:
        base = _of_aircraft(name)
        meant = {"identified", "jsbsim"}
    if model not in meant:
        raise ScenarioError(
            f"--model {model}: does not fly {base.aircraft.name!r}, the aircraft of {name}; "
            f"expected one of {', '.join(sorted(meant))}"
        )
    changes = {"airspeed": airspeed, "altitude": altitude, "flight_path_deg": 0.0}
    given = {key: value for key, value in changes.items() if value is not None}
    try:
        initial = Initial(**{**base.initial.model_dump(), **given})
    except ValidationError as error:
        raise ScenarioError(f"initial.{first_problem(error, Initial)}") from None
    return Scenario(
        name="margins",
        title=f"straight and level for margins of {name}",
        model=model,
        aircraft=base.aircraft,
        initial=initial,
        reference=Reference(
            airspeed=((0.0, initial.airspeed),),
            flight_path_deg=((0.0, 0.0),),
            heading_deg=((0.0, initial.heading_deg),),
        ),
        loop=base.loop,
        simulation=base.simulation,
    )


def _of_aircraft(name: str) -> Scenario:
    from ftc_jsb.aircraft.description import load_aircraft
    from ftc_jsb.aircraft.level_flight import level_flight

    try:
        aircraft_folder(name)
    except UserError as error:
        known = ", ".join(scenario_names())
        raise ScenarioError(f"{error}; or a scenario: one of {known}, or a .toml file") from None
    initial = level_flight(load_aircraft(name))
    still = ((0.0, 0.0),)
    return Scenario(
        name="level",
        aircraft=AircraftChoice(name=name),
        initial=initial,
        reference=Reference(
            airspeed=((0.0, initial.airspeed),), flight_path_deg=still, heading_deg=still
        ),
    )
