"""What is shipped or installed: scenarios, aircraft, loops, each with its meaning."""

from ftc_jsb.aircraft.point_mass_file import load_point_mass
from ftc_jsb.errors import UserError
from ftc_jsb.loops.registry import loop_names
from ftc_jsb.resources import aircraft_folder, aircraft_names
from ftc_jsb.scenario.load import load_scenario, scenario_names


def inventory() -> dict[str, dict[str, str]]:
    """Names and meanings of what is shipped or installed."""
    return {
        "scenarios": {name: load_scenario(name).title for name in scenario_names()},
        "aircraft": {name: point_mass_title(name) for name in aircraft_names()},
        "loops": loop_names(),
    }


def point_mass_title(name: str) -> str:
    """Title of a shipped aircraft's point mass; what is wrong with it, where it cannot be read."""
    try:
        return load_point_mass(aircraft_folder(name)).title
    except UserError as error:
        return str(error)
