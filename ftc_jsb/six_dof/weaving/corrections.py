"""The corrections of `aircraft.toml`, made to the XML of aircraft, engines and systems."""

import xml.etree.ElementTree as ET
from collections.abc import Mapping
from pathlib import Path

from ftc_jsb.aircraft.description import Aircraft, Correction, Edit
from ftc_jsb.bounded_file import is_file
from ftc_jsb.confinement import OutsideError, confined
from ftc_jsb.errors import AircraftError
from ftc_jsb.six_dof.weaving.elements import required


def apply_corrections(aircraft: Aircraft, parsed: Mapping[str, ET.Element], systems: Path) -> None:
    """Make every edit of every correction, in the order of `aircraft.toml`.

    Args:
        aircraft: as loaded.
        parsed: XML by file name, edited in place: each engine, and the aircraft's own as "".
        systems: folder of the woven systems; an edit of a file that is not in `parsed` is made there.

    Raises:
        AircraftError: there is no such file, or an element does not hold what the edit expects.
    """
    for correction in aircraft.correction:
        for edit in correction.edit:
            if edit.file in parsed:
                _edit(parsed[edit.file], aircraft.name, correction, edit)
            else:
                _edit_system(systems, aircraft.name, correction, edit)


def _edit_system(systems: Path, aircraft: str, correction: Correction, edit: Edit) -> None:
    where = f"aircraft {aircraft!r}, correction {correction.name!r}"
    try:
        path = confined(systems, f"{edit.file}.xml")
    except OutsideError as error:
        raise AircraftError(f"{where}: file: {error}") from None
    if not is_file(path):
        raise AircraftError(f"{where}: no engine or system {edit.file!r} in the installed jsbsim")
    tree = ET.parse(path)
    _edit(tree.getroot(), aircraft, correction, edit)
    tree.write(path)


def _edit(root: ET.Element, aircraft: str, correction: Correction, edit: Edit) -> None:
    try:
        element = root.find(edit.element)
    except (SyntaxError, KeyError, TypeError):
        raise AircraftError(
            f"aircraft {aircraft!r}, correction {correction.name!r}: {edit.element!r}: expected the "
            "path of an element, such as flight_control/channel"
        ) from None
    text = (element.text or "").strip() if element is not None else None
    if element is None or text != edit.expect:
        raise AircraftError(
            f"aircraft {aircraft!r}, correction {correction.name!r}: {edit.element} holds {text!r}, "
            f"expected {edit.expect!r}; the installed jsbsim differs from the one it was written for"
        )
    if edit.remove:
        parent = required(root, edit.element.rsplit("/", 1)[0]) if "/" in edit.element else root
        parent.remove(element)
    else:
        element.text = edit.replace
