"""The woven aircraft: the installed one plus effectiveness, engine deck, corrections, inner loop.

The shipped files are GPL and are read from the installed jsbsim package at run time; the woven
copy lives in the user's cache folder and is never part of this project.
"""

import hashlib
import shutil
import xml.etree.ElementTree as ET
from functools import partial
from pathlib import Path

from ftc_jsb.aircraft.description import Aircraft
from ftc_jsb.errors import AircraftError, WriteError
from ftc_jsb.six_dof.weaving.corrections import apply_corrections
from ftc_jsb.six_dof.weaving.engine_deck import (
    apply_effectiveness,
    deck_system,
    throttle_system,
    thrust_tables,
)
from ftc_jsb.six_dof.weaving.faults import weave_faults
from ftc_jsb.sources import source_digest
from ftc_jsb.verified_cache import sealed_folder

# Woven in this order before the aircraft's own systems, so that each reads the frame's own values.
NUMBERS_SYSTEM = "ftc_numbers"  # of the aircraft: aircraft/NAME/inner_loop.xml
DECK_SYSTEM = "ftc_engine_deck"
INNER_LOOP_SYSTEM = "ftc_inner_loop"
THROTTLE_SYSTEM = "ftc_throttles"
# The structure of the inner loop, for every aircraft.
INNER_LOOP = Path(__file__).with_name("inner_loop_structure.xml")


def woven_aircraft(aircraft: Aircraft, corrected: bool) -> Path:
    """Root folder (`aircraft/`, `engine/`, `systems/`) of the woven aircraft, made if need be.

    The folder is named after all that goes into it, so a changed inner loop or another jsbsim
    version weaves anew, and several processes may do so at once. What has been changed since is woven
    anew, too.

    Args:
        aircraft: as loaded.
        corrected: apply the corrections of `aircraft.toml`; otherwise the stock flight control.

    Raises:
        AircraftError: the installed model or one of its files is missing, or an edit does not
            find what it expects.
    """
    import jsbsim

    package = Path(jsbsim.get_default_root_dir())
    source = package / "aircraft" / aircraft.jsbsim_model
    model_file = source / f"{aircraft.jsbsim_model}.xml"
    numbers = aircraft.folder / "inner_loop.xml"
    for path in (model_file, numbers):
        if not path.is_file():
            raise AircraftError(f"aircraft {aircraft.name!r}: {path} not found")
    digest = hashlib.sha256(jsbsim.__version__.encode())
    digest.update(source_digest(__name__).encode())
    for path in (INNER_LOOP, model_file, numbers):
        digest.update(path.read_bytes())
    digest.update(f"{aircraft.model_dump_json()}{corrected}".encode())
    weave = partial(_weave, aircraft, corrected, package, source, numbers)
    try:
        return sealed_folder(f"aircraft/{digest.hexdigest()[:24]}", weave)
    except WriteError as error:
        raise AircraftError(f"aircraft {aircraft.name!r}: {error}") from None


def _weave(
    aircraft: Aircraft, corrected: bool, package: Path, source: Path, numbers: Path, root: Path
) -> None:
    model = aircraft.jsbsim_model
    systems = root / "systems"
    shutil.copytree(source, root / "aircraft" / model)
    (root / "engine").mkdir()
    systems.mkdir()
    for path in (package / "systems").glob("*.xml"):
        shutil.copy(path, systems)
    tree = ET.parse(source / f"{model}.xml")
    fdm = tree.getroot()
    engines = {}  # file name: XML, each read once though two engines may share it
    installed = [engine.attrib["file"] for engine in fdm.findall("propulsion/engine")]
    for name in installed:
        engines[name] = ET.parse(_find_engine(package, source, name))
    for thruster in fdm.findall("propulsion/engine/thruster"):
        shutil.copy(_find_engine(package, source, thruster.attrib["file"]), root / "engine")
    shutil.rmtree(root / "aircraft" / model / "Engines", ignore_errors=True)
    if corrected:
        parsed = {"": fdm} | {name: tree.getroot() for name, tree in engines.items()}
        apply_corrections(aircraft, parsed, systems)
    decks = [thrust_tables(engines[name].getroot(), name) for name in installed]
    for name, engine_tree in engines.items():
        apply_effectiveness(engine_tree.getroot())
        engine_tree.write(root / "engine" / f"{name}.xml")
    deck_system(decks).write(systems / f"{DECK_SYSTEM}.xml")
    throttle_system(
        [engines[name].getroot() for name in installed],
        aircraft.throttle.property,
        aircraft.throttle.military,
    ).write(systems / f"{THROTTLE_SYSTEM}.xml")
    shutil.copy(numbers, systems / f"{NUMBERS_SYSTEM}.xml")
    shutil.copy(INNER_LOOP, systems / f"{INNER_LOOP_SYSTEM}.xml")
    woven = (NUMBERS_SYSTEM, DECK_SYSTEM, INNER_LOOP_SYSTEM, THROTTLE_SYSTEM)
    weave_faults(fdm, aircraft, len(installed))
    place = _first_control(fdm)
    for number, system in enumerate(woven):
        fdm.insert(place + number, ET.Element("system", file=system))
    tree.write(root / "aircraft" / model / f"{model}.xml")


def _first_control(fdm: ET.Element) -> int:
    """Place of the first system or flight control: some aircraft have only the former."""
    for place, element in enumerate(fdm):
        if element.tag in ("system", "flight_control"):
            return place
    raise AircraftError(f"{fdm.get('name')}: expected an element 'flight_control' or 'system'")


def _find_engine(package: Path, source: Path, name: str) -> Path:
    for folder in (source / "Engines", source / "engines", package / "engine"):
        if (folder / f"{name}.xml").is_file():
            return folder / f"{name}.xml"
    raise AircraftError(f"engine file {name}.xml not found in {source} or {package / 'engine'}")
