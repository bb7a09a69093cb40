"""Weaving: the installed JSBSim aircraft plus effectiveness, engine deck, corrections, inner loop.

The shipped files are GPL and are read from the installed jsbsim package at run time; the woven
copy lives in the user's cache folder and is never part of this project.
"""

import hashlib
import os
import shutil
import tempfile
import xml.etree.ElementTree as ET
from pathlib import Path

import platformdirs

from ftc_jsb.errors import AircraftError
from ftc_jsb.six_dof.aircraft import Aircraft, Edit
from ftc_jsb.six_dof.engine_deck import apply_effectiveness, deck_system, required, thrust_tables

DECK_SYSTEM = "ftc_engine_deck"
INNER_LOOP_SYSTEM = "ftc_inner_loop"


def woven_aircraft(aircraft: Aircraft, corrected: bool) -> Path:
    """Root folder (`aircraft/`, `engine/`, `systems/`) of the woven aircraft, made if need be.

    The folder is named after all that goes into it, so a changed inner loop or another jsbsim
    version weaves anew, and several processes may do so at once.

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
    inner_loop = aircraft.folder / "inner_loop.xml"
    for path in (model_file, inner_loop):
        if not path.is_file():
            raise AircraftError(f"aircraft {aircraft.name!r}: {path} not found")
    digest = hashlib.sha256(jsbsim.__version__.encode())
    own = (Path(__file__), Path(__file__).with_name("engine_deck.py"))
    for path in (*own, model_file, inner_loop):
        digest.update(path.read_bytes())
    digest.update(f"{aircraft.model_dump_json()}{corrected}".encode())
    cache = Path(platformdirs.user_cache_dir("ftc-jsb")) / "aircraft"
    target = cache / f"{aircraft.name}-{digest.hexdigest()[:16]}"
    if target.is_dir():
        return target
    try:
        cache.mkdir(parents=True, exist_ok=True)
        with tempfile.TemporaryDirectory(dir=cache) as scratch:
            woven = Path(scratch) / "woven"
            _weave(aircraft, corrected, package, source, inner_loop, woven)
            try:
                os.replace(woven, target)
            except OSError:
                if not target.is_dir():  # another process was first: its copy is the same
                    raise
    except OSError as error:
        raise AircraftError(f"{cache}: cannot write the woven aircraft there: {error}") from None
    return target


def _weave(
    aircraft: Aircraft, corrected: bool, package: Path, source: Path, inner_loop: Path, root: Path
) -> None:
    model = aircraft.jsbsim_model
    shutil.copytree(source, root / "aircraft" / model)
    engines_folder = root / "engine"
    engines_folder.mkdir()
    (root / "systems").mkdir()
    for path in (package / "systems").glob("*.xml"):
        shutil.copy(path, root / "systems")
    tree = ET.parse(source / f"{model}.xml")
    fdm = tree.getroot()
    decks = []
    for engine in fdm.findall("propulsion/engine"):
        name = engine.attrib["file"]
        original = _find_engine(package, source, name)
        engine_tree = ET.parse(original)
        decks.append(thrust_tables(engine_tree.getroot(), original))
        apply_effectiveness(engine_tree.getroot())
        engine_tree.write(engines_folder / f"{name}.xml")
        for thruster in engine.findall("thruster"):
            shutil.copy(_find_engine(package, source, thruster.attrib["file"]), engines_folder)
    shutil.rmtree(root / "aircraft" / model / "Engines", ignore_errors=True)
    deck_system(decks).write(root / "systems" / f"{DECK_SYSTEM}.xml")
    shutil.copy(inner_loop, root / "systems" / f"{INNER_LOOP_SYSTEM}.xml")
    if corrected:
        for correction in aircraft.correction:
            for edit in correction.edit:
                _edit(fdm, aircraft.name, correction.name, edit)
    place = list(fdm).index(required(fdm, "flight_control"))
    for system in (INNER_LOOP_SYSTEM, DECK_SYSTEM):
        fdm.insert(place, ET.Element("system", file=system))
    tree.write(root / "aircraft" / model / f"{model}.xml")


def _find_engine(package: Path, source: Path, name: str) -> Path:
    for folder in (source / "Engines", source / "engines", package / "engine"):
        if (folder / f"{name}.xml").is_file():
            return folder / f"{name}.xml"
    raise AircraftError(f"engine file {name}.xml not found in {source} or {package / 'engine'}")


def _edit(fdm: ET.Element, aircraft: str, correction: str, edit: Edit) -> None:
    element = fdm.find(edit.element)
    text = (element.text or "").strip() if element is not None else None
    if element is None or text != edit.expect:
        raise AircraftError(
            f"aircraft {aircraft!r}, correction {correction!r}: {edit.element} holds {text!r}, "
            f"expected {edit.expect!r}; the installed jsbsim differs from the one it was written for"
        )
    if edit.remove:
        parent = required(fdm, edit.element.rsplit("/", 1)[0])
        parent.remove(element)
    else:
        element.text = edit.replace
