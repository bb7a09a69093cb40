"""The `-set.xml` of the exported aircraft: what FlightGear reads of it first."""

import xml.etree.ElementTree as ET

from ftc_jsb.aircraft.description import Aircraft

# Models that FlightGear's own data have of other people's traffic; without one the aircraft cannot be seen
# from outside, and flies all the same.
MODELS = {
    "f16": "AI/Aircraft/f16/Models/f-16.xml",
    "f15": "AI/Aircraft/F-15/Models/F-15.xml",
    "F4N": "AI/Aircraft/F-4/F-4.xml",
    "T38": "AI/Aircraft/T-38/Models/T38-model.xml",
}
DIALOG = "ftc-outer-loop"


def set_file(aircraft: Aircraft, name: str) -> ET.Element:
    """The `<PropertyList>`.

    Args:
        aircraft: as loaded.
        name: of its JSBSim file.
    """
    root = ET.Element("PropertyList")
    sim = ET.SubElement(root, "sim")
    for tag, text in (
        ("description", f"{aircraft.title}, with the inner loop of ftc-jsb"),
        ("flight-model", "jsb"),
        ("aero", name),
        ("aircraft-version", "1"),
    ):
        _value(sim, tag, text, "string")
    if aircraft.jsbsim_model in MODELS:
        _value(ET.SubElement(sim, "model"), "path", MODELS[aircraft.jsbsim_model], "string")
    _value(ET.SubElement(sim, "startup"), "trim", "true", "bool")
    _value(ET.SubElement(sim, "sound"), "enabled", "false", "bool")
    _menu(sim)
    _keys(root)
    gear = ET.SubElement(ET.SubElement(root, "controls"), "gear")
    _value(gear, "gear-down", "false", "bool")
    _value(ET.SubElement(ET.SubElement(root, "nasal"), "ftc"), "file", "Nasal/ftc.nas", "string")
    return root


def _value(parent: ET.Element, tag: str, text: str, kind: str) -> None:
    ET.SubElement(parent, tag, type=kind).text = text


def _keys(root: ET.Element) -> None:
    keyboard = ET.SubElement(ET.SubElement(root, "input"), "keyboard")
    for letter, meaning, script in (
        ("o", "Outer loop on or off", "ftc.switch_outer_loop()"),
        ("u", "Pilot takes the references or gives them back", "ftc.hand_over()"),
        ("O", "Dialog of the outer loop", f"gui.showDialog('{DIALOG}')"),
    ):
        key = ET.SubElement(keyboard, "key", n=str(ord(letter)))
        _value(key, "name", letter, "string")
        _value(key, "desc", meaning, "string")
        binding = ET.SubElement(key, "binding")
        _value(binding, "command", "nasal", "string")
        _value(binding, "script", script, "string")


def _menu(sim: ET.Element) -> None:
    menu = ET.SubElement(ET.SubElement(ET.SubElement(sim, "menubar"), "default"), "menu", n="100")
    _value(menu, "label", "Outer loop", "string")
    _value(menu, "enabled", "true", "bool")
    item = ET.SubElement(menu, "item")
    _value(item, "label", "Outer loop, faults, references", "string")
    binding = ET.SubElement(item, "binding")
    _value(binding, "command", "dialog-show", "string")
    _value(binding, "dialog-name", DIALOG, "string")
