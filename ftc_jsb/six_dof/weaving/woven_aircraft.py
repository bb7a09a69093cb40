"""The woven aircraft: the installed one plus effectiveness, engine deck, corrections, inner loop.

The shipped files are GPL and are read from the installed jsbsim package at run time; the woven
copy lives in the user's cache folder and is never part of this project.
"""

import hashlib
import shutil
import xml.etree.ElementTree as ET
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
from ftc_jsb.six_dof.weaving.installed import installed, model_file
from ftc_jsb.six_dof.weaving.measured_signals import measured_structure
from ftc_jsb.six_dof.weaving.numbers import check_whose
from ftc_jsb.six_dof.weaving.trial import is_vouched_for, try_out
from ftc_jsb.sources import source_digest
from ftc_jsb.verified_cache import sealed_folder

# Woven in this order before the aircraft's own systems, so that each reads the frame's own values.
NUMBERS_SYSTEM = "ftc_numbers"  # of the aircraft: aircraft/NAME/inner_loop.xml
DECK_SYSTEM = "ftc_engine_deck"
INNER_LOOP_SYSTEM = "ftc_inner_loop"
THROTTLE_SYSTEM = "ftc_throttles"
# The structure of the inner loop, for every aircraft.
INNER_LOOP = Path(__file__).with_name("inner_loop_structure.xml")


# What comes of elements that are read after a correction has removed or changed them.
_NOT_AS_EXPECTED = (ValueError, LookupError, TypeError, AttributeError, ET.ParseError)


def woven_aircraft(aircraft: Aircraft, corrected: bool, measured: bool = False) -> Path:
    """Root folder (`aircraft/`, `engine/`, `systems/`) of the woven aircraft, made if need be.

    The folder is named after all that goes into it, so a changed inner loop or another jsbsim
    version weaves anew, and several processes may do so at once. What has been changed since is woven
    anew, too.

    Args:
        aircraft: as loaded.
        corrected: apply the corrections of `aircraft.toml`; otherwise the stock flight control.
        measured: the inner loop reads its sensors; otherwise the truth.

    Raises:
        AircraftError: the installed model or one of its files is missing, an edit does not
            find what it expects, or JSBSim aborts on the files of a user's aircraft.
    """
    import jsbsim

    model, numbers = model_file(aircraft.jsbsim_model), aircraft.folder / "inner_loop.xml"
    for path in (model, numbers):
        if not path.is_file():
            raise AircraftError(f"aircraft {aircraft.name!r}: {path} not found")
    check_whose(numbers, aircraft)
    digest = hashlib.sha256(jsbsim.__version__.encode())
    digest.update(source_digest(__name__).encode())
    for path in (INNER_LOOP, model, numbers):
        digest.update(path.read_bytes())
    digest.update(f"{aircraft.model_dump_json()}{corrected}{measured}".encode())

    def weave(woven: Path) -> None:
        _weave(aircraft, corrected, numbers, woven)
        if measured:
            inner_loop = woven / "systems" / f"{INNER_LOOP_SYSTEM}.xml"
            inner_loop.write_text(measured_structure(INNER_LOOP.read_text(encoding="utf-8")))

    try:
        woven = sealed_folder(f"aircraft/{digest.hexdigest()[:24]}", weave)
    except WriteError as error:
        raise AircraftError(f"aircraft {aircraft.name!r}: {error}") from None
    except _NOT_AS_EXPECTED as error:
        raise AircraftError(
            f"aircraft {aircraft.name!r}: its corrections leave XML that cannot be woven: {error!r}"
        ) from None
    if not is_vouched_for(aircraft.folder):
        try_out(aircraft.name, aircraft.jsbsim_model, woven)
    return woven


def _weave(aircraft: Aircraft, corrected: bool, numbers: Path, root: Path) -> None:
    model = aircraft.jsbsim_model
    source = installed(model)
    systems = root / "systems"
    shutil.copytree(source.folder, root / "aircraft" / model)
    (root / "engine").mkdir()
    systems.mkdir()
    for path in (source.package / "systems").glob("*.xml"):
        shutil.copy(path, systems)
    fdm, engines = source.root, source.engine_roots
    for thruster in source.thrusters:
        shutil.copy(thruster, root / "engine")
    shutil.rmtree(root / "aircraft" / model / "Engines", ignore_errors=True)
    if corrected:
        parsed = {"": fdm} | engines
        apply_corrections(aircraft, parsed, systems)
    decks = [thrust_tables(engines[name], name) for name in source.engines]
    for name, engine in engines.items():
        apply_effectiveness(engine)
        ET.ElementTree(engine).write(root / "engine" / f"{name}.xml")
    deck_system(decks).write(systems / f"{DECK_SYSTEM}.xml")
    throttle_system(
        [engines[name] for name in source.engines],
        aircraft.throttle.property,
        aircraft.throttle.military,
    ).write(systems / f"{THROTTLE_SYSTEM}.xml")
    shutil.copy(numbers, systems / f"{NUMBERS_SYSTEM}.xml")
    shutil.copy(INNER_LOOP, systems / f"{INNER_LOOP_SYSTEM}.xml")
    woven = (NUMBERS_SYSTEM, DECK_SYSTEM, INNER_LOOP_SYSTEM, THROTTLE_SYSTEM)
    weave_faults(fdm, aircraft, len(source.engines))
    place = _first_control(fdm)
    for number, system in enumerate(woven):
        fdm.insert(place + number, ET.Element("system", file=system))
    ET.ElementTree(fdm).write(root / "aircraft" / model / f"{model}.xml")


def _first_control(fdm: ET.Element) -> int:
    """Place of the first system or flight control: some aircraft have only the former."""
    for place, element in enumerate(fdm):
        if element.tag in ("system", "flight_control"):
            return place
    raise AircraftError(f"{fdm.get('name')}: expected an element 'flight_control' or 'system'")
