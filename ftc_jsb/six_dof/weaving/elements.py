"""Elements of JSBSim's XML: operations of a function, and those that a file must have."""

import copy
import xml.etree.ElementTree as ET

from ftc_jsb.errors import AircraftError


def operation(tag: str, *arguments: ET.Element) -> ET.Element:
    """An operation of a JSBSim function, such as `product`, on copies of its arguments."""
    element = ET.Element(tag)
    element.extend(copy.deepcopy(argument) for argument in arguments)
    return element


def constant(text: str) -> ET.Element:
    """A `<value>`."""
    element = ET.Element("value")
    element.text = text.strip()
    return element


def property_value(name: str) -> ET.Element:
    """A `<property>` that is read."""
    element = ET.Element("property")
    element.text = name
    return element


def required(parent: ET.Element, path: str) -> ET.Element:
    """Element of `parent` at `path`.

    Raises:
        AircraftError: there is none.
    """
    found = parent.find(path)
    if found is None:
        raise AircraftError(f"{parent.get('name', parent.tag)}: expected an element {path!r}")
    return found
