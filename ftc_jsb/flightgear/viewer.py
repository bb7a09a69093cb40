"""FlightGear as a viewer: JSBSim's own FGNetFDM output of a flight, over UDP."""

import tempfile
import xml.etree.ElementTree as ET
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import NamedTuple

from ftc_jsb.errors import ScenarioError
from ftc_jsb.scenario.schema import Scenario

RATE = 60.0  # [Hz], about: JSBSim sends every so many of its steps


class Viewer(NamedTuple):
    """Where FlightGear listens: `fgfs --fdm=null --native-fdm=socket,in,60,HOST,PORT,udp`."""

    host: str
    port: int


def viewer(endpoint: str, scenario: Scenario) -> Viewer:
    """HOST:PORT of the command line.

    Raises:
        ScenarioError: it is none, or the model is a point mass, for which JSBSim has no output.
    """
    host, colon, port = endpoint.rpartition(":")
    if not (colon and host and port.isascii() and port.isdigit() and 0 < int(port) < 65536):
        raise ScenarioError(
            f"--flightgear {endpoint!r}: expected HOST:PORT, such as 127.0.0.1:5550"
        )
    if scenario.model != "jsbsim":
        raise ScenarioError(
            f"--flightgear: the model {scenario.model!r} is a point mass and has no attitude of its own "
            "to show; FlightGear is sent JSBSim's output: --model jsbsim"
        )
    return Viewer(host, int(port))


@contextmanager
def output_directive(where: Viewer) -> Iterator[Path]:
    """A file that tells JSBSim to send FGNetFDM packets; absolute, as JSBSim wants it.

    JSBSim takes it between the loading of the aircraft and `run_ic`; later it sends nothing.
    """
    with tempfile.TemporaryDirectory(prefix="ftc-jsb-flightgear-") as folder:
        path = Path(folder).resolve() / "output.xml"
        output = ET.Element(
            "output",
            name=where.host,
            type="FLIGHTGEAR",
            port=str(where.port),
            protocol="UDP",
            rate=f"{RATE:g}",
        )
        ET.ElementTree(output).write(path, encoding="utf-8", xml_declaration=True)
        yield path
