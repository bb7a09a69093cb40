"""Whose an `inner_loop.xml` is: the name of its system says it."""

import xml.etree.ElementTree as ET
from pathlib import Path

from ftc_jsb.aircraft.description import Aircraft
from ftc_jsb.errors import AircraftError

PREFIX = "ftc numbers"  # of the system's name; the JSBSim model follows


def system_name(model: str) -> str:
    """Name of the system that holds the numbers of a JSBSim model's inner loop."""
    return f"{PREFIX} of {model}"


def check_whose(path: Path, aircraft: Aircraft) -> None:
    """See that an `inner_loop.xml` was made for this aircraft.

    Raises:
        AircraftError: it is no XML, or the inner loop of another JSBSim model.
    """
    try:
        found = ET.parse(path).getroot().get("name", "")
    except (OSError, ET.ParseError) as error:
        raise AircraftError(f"{path}: cannot be read: {error}") from None
    if found not in (PREFIX, system_name(aircraft.jsbsim_model)):
        other = found.removeprefix(f"{PREFIX} of ")
        raise AircraftError(
            f"{path}: the inner loop of {other!r}, not of {aircraft.jsbsim_model!r}, which "
            "aircraft.toml names; make its own by `ftc-jsb inner-loop`"
        )
