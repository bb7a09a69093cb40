"""The folder that FlightGear takes as `--fg-aircraft`: aircraft, protocol, menu, dialog, Nasal."""

import shutil
import xml.etree.ElementTree as ET
from pathlib import Path

from ftc_jsb.aircraft.description import Aircraft
from ftc_jsb.atomic_file import atomic_contents
from ftc_jsb.errors import AircraftError
from ftc_jsb.export.aircraft_folder import licences, shared_systems
from ftc_jsb.export.flightgear.protocol_files import IN, OUT, protocol_file
from ftc_jsb.export.flightgear.set_file import set_file
from ftc_jsb.scenario.schema import AircraftChoice
from ftc_jsb.six_dof.exchange.fields import CHECK, COMMANDED, MEASURED_CHECK, measured_fields
from ftc_jsb.six_dof.exchange.system import EXCHANGE_SYSTEM, add_exchange, exchange_system
from ftc_jsb.six_dof.weaving.woven_aircraft import (
    DECK_SYSTEM,
    INNER_LOOP_SYSTEM,
    woven_aircraft,
)
from ftc_jsb.vocabulary.hypotheses import HYPOTHESES

TEXTS = Path(__file__).parent  # dialog and Nasal, as they are
README = """\
{title}, with the inner loop of ftc-jsb, for FlightGear. Read NOTICE before you pass it on.

    ftc-jsb plugin paper --flightgear

starts FlightGear with it and flies it. By hand, in this folder:

    fgfs --fg-aircraft="$PWD" --aircraft={name} --in-air --trim --altitude={feet:.0f} --mach={mach:.3f} \\
        --generic=socket,out,60,127.0.0.1,5601,udp,PATH/{name}/Protocol/{out} \\
        --generic=socket,in,60,127.0.0.1,5602,udp,PATH/{name}/Protocol/{into}

where PATH is this folder as seen from FlightGear's own folder Protocol; then

    ftc-jsb plugin paper --flightgear --attach 127.0.0.1:5602

Until an outer loop is there, and when it has gone, the inner loop holds wings level, level flight and
airspeed. Menu "Outer loop" in FlightGear.
"""
_SURFACES = ("elevator", "aileron", "rudder")


def aircraft_name(aircraft: Aircraft) -> str:
    """What FlightGear calls it."""
    return f"{aircraft.jsbsim_model}-ftc"


def export_flightgear(aircraft: Aircraft, choice: AircraftChoice, folder: Path) -> list[Path]:
    """Write the aircraft to `folder / NAME-ftc`, with README and NOTICE beside it.

    Args:
        aircraft: as loaded.
        choice: [aircraft] of a scenario: corrections and fuel.
        folder: exists; files of the same names are replaced.

    Returns:
        The files that were written.

    Raises:
        AircraftError: it cannot be woven.
        WriteError: the folder cannot be written.
    """
    root = woven_aircraft(aircraft, choice.flight_control == "corrected")
    name, model = aircraft_name(aircraft), aircraft.jsbsim_model
    with atomic_contents(folder) as new:
        own = new / name
        for part in ("Engines", "Systems", "Protocol", "Nasal", "gui/dialogs"):
            (own / part).mkdir(parents=True)
        for path in (root / "engine").glob("*.xml"):
            shutil.copy(path, own / "Engines")
        _systems(root, own, model)
        fdm = ET.parse(root / "aircraft" / model / f"{model}.xml").getroot()
        engines = len(fdm.findall("propulsion/engine"))
        _exchange(fdm, aircraft, engines, own)
        _fill(fdm, aircraft, choice.fuel_fraction)
        _write(fdm, own / f"{name}.xml")
        _protocol(aircraft, engines, own / "Protocol")
        _write(set_file(aircraft, name), own / f"{name}-set.xml")
        shutil.copy(TEXTS / "ftc_dialog.xml", own / "gui" / "dialogs" / "ftc-outer-loop.xml")
        (own / "Nasal" / "ftc.nas").write_text(nasal(), encoding="utf-8")
        licences(new, model)
        (new / "README.txt").write_text(_readme(aircraft, name), encoding="utf-8")
        written = [path.relative_to(new) for path in new.rglob("*") if path.is_file()]
    return sorted(folder / path for path in written)


def nasal() -> str:
    """What the dialog does, with the names of what the isolation may suspect."""
    names = ", ".join(f'"{name.replace("_", " ")}"' for name in HYPOTHESES)
    text = (TEXTS / "ftc.nas").read_text(encoding="utf-8")
    return text.replace("var hypotheses = [];", f"var hypotheses = [{names}];")


def _systems(root: Path, own: Path, model: str) -> None:
    """The woven systems, the aircraft's own, and of JSBSim's shared ones those that are asked for."""
    for path in shared_systems(root, model):
        shutil.copy(path, own / "Systems")
    for path in (root / "aircraft" / model).glob("Systems/*.xml"):
        shutil.copy(path, own / "Systems")
    inner_loop = own / "Systems" / f"{INNER_LOOP_SYSTEM}.xml"
    inner_loop.write_text(own_positions(inner_loop.read_text(encoding="utf-8")), encoding="utf-8")


def own_positions(structure: str) -> str:
    """The inner loop going on from its own last position: FlightGear writes its stick over the command.

    Args:
        structure: XML text of the woven inner loop.
    """
    for surface in _SURFACES:
        command = f"<p>fcs/{surface}-cmd-norm</p>"
        last = (
            f"<ifthen><gt><p>ftc/engaged</p><v>0.5</v></gt><p>ftc/{surface}</p>{command}</ifthen>"
        )
        if structure.count(f"<sum>{command}") != 1:
            raise AircraftError(f"inner loop: expected one increment of {command}")
        structure = structure.replace(f"<sum>{command}", f"<sum>{last}")
    return structure


def _exchange(fdm: ET.Element, aircraft: Aircraft, engines: int, own: Path) -> None:
    """The system of the exchange, between the engines' deck and the inner loop."""
    exchange_system(aircraft, engines).write(own / "Systems" / f"{EXCHANGE_SYSTEM}.xml")
    files = [element.get("file") for element in fdm]
    fdm.insert(files.index(DECK_SYSTEM) + 1, ET.Element("system", file=EXCHANGE_SYSTEM))
    add_exchange(fdm, aircraft, engines)


def _fill(fdm: ET.Element, aircraft: Aircraft, fraction: float) -> None:
    """Internal tanks filled to a fraction; FlightGear takes their contents as they stand here."""
    tanks = fdm.findall("propulsion/tank")
    for number in aircraft.fuel_tanks:
        capacity, contents = tanks[number].find("capacity"), tanks[number].find("contents")
        if capacity is None or contents is None:
            raise AircraftError(f"aircraft {aircraft.name!r}: fuel tank {number} has no capacity")
        contents.text = repr(fraction * float(capacity.text or "0"))
        contents.set("unit", capacity.get("unit", "LBS"))


def _protocol(aircraft: Aircraft, engines: int, folder: Path) -> None:
    measured = [*measured_fields(aircraft, engines), MEASURED_CHECK]
    for name, direction, fields in ((OUT, "output", measured), (IN, "input", [*COMMANDED, CHECK])):
        _write(protocol_file(direction, fields), folder / f"{name}.xml")


def _write(element: ET.Element, path: Path) -> None:
    ET.indent(element)
    ET.ElementTree(element).write(path, encoding="utf-8", xml_declaration=True)


def _readme(aircraft: Aircraft, name: str) -> str:
    airspeed = sum(aircraft.flight_test.airspeed) / 2.0
    return README.format(
        title=aircraft.title, name=name, feet=10000.0, mach=airspeed / 328.4, out=OUT, into=IN
    )  # fmt: skip
