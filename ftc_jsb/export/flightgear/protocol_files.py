"""FlightGear's own form of the exchange: the files of its generic protocol."""

import xml.etree.ElementTree as ET
from collections.abc import Sequence

from ftc_jsb.six_dof.exchange.fields import Field

OUT, IN = "ftc-out", "ftc-in"  # names of the files, seen from FlightGear
PREFIX = "/fdm/jsbsim/"  # where FlightGear keeps JSBSim's properties
DIGITS = "%.17g"  # a double, without loss


def protocol_file(direction: str, fields: Sequence[Field]) -> ET.Element:
    """A line of fields in their order, separated by commas.

    Args:
        direction: "output" or "input", as FlightGear sees it.
        fields: `check` included.
    """
    root = ET.Element("PropertyList")
    generic = ET.SubElement(root, "generic")
    protocol = ET.SubElement(generic, direction)
    ET.SubElement(protocol, "line_separator").text = "newline"
    ET.SubElement(protocol, "var_separator").text = ","
    for field in fields:
        chunk = ET.SubElement(protocol, "chunk")
        ET.SubElement(chunk, "name").text = field.name
        ET.SubElement(chunk, "node").text = PREFIX + field.property
        ET.SubElement(chunk, "type").text = "double"
        if direction == "output":
            ET.SubElement(chunk, "format").text = DIGITS
    return root
