"""A JSBSim script that trims a woven aircraft, engages the inner loop and steps its commands."""

import math
import xml.etree.ElementTree as ET
from typing import NamedTuple

from ftc_jsb.scenario.schema import Initial
from ftc_jsb.six_dof.engines import thrust_property

INITIAL = "ftc_level"
RATE = 200.0  # [Hz]
END = 40.0  # [s]
ENGAGE = 1.0  # [s]
KNOT = 1852.0 / 3600.0  # [m/s]
COLUMNS = (
    "ftc/command/thrust-n",
    "ftc/command/load-factor",
    "ftc/command/bank-rad",
    "ftc/load-factor/actual",
    "ftc/bank/actual",
    "velocities/vt-fps",
    "position/h-sl-ft",
    "attitude/heading-true-rad",
)


class Step(NamedTuple):
    """Commands from a time on."""

    time: float  # [s]
    title: str
    thrust: float  # [N]
    load_factor: float
    bank_angle: float  # [rad]


def steps(thrust: float, most: float) -> list[Step]:
    """Load factor, bank and thrust, each stepped and taken back.

    Args:
        thrust: of the trim [N].
        most: military thrust at the trim [N].
    """
    bank = math.radians(45.0)
    return [
        Step(ENGAGE, "engage", thrust, 1.0, 0.0),
        Step(3.0, "load factor 1.5", thrust, 1.5, 0.0),
        Step(6.0, "load factor 1", thrust, 1.0, 0.0),
        Step(10.0, "bank 45 deg, level turn", thrust, 1.0 / math.cos(bank), bank),
        Step(22.0, "wings level", thrust, 1.0, 0.0),
        Step(26.0, "thrust half way to military", 0.5 * (thrust + most), 1.0, 0.0),
        Step(33.0, "thrust of the trim", thrust, 1.0, 0.0),
    ]


def initial_condition(initial: Initial) -> ET.Element:
    """The `<initialize>` file: straight flight, gear up and engines as the script sets them."""
    root = ET.Element("initialize", name=INITIAL, version="1.0")
    for tag, unit, value in (
        ("vt", "KTS", initial.airspeed / KNOT),
        ("gamma", "DEG", initial.flight_path_deg),
        ("psi", "DEG", initial.heading_deg % 360.0),
        ("altitude", "M", initial.altitude),
        ("latitude", "DEG", initial.latitude_deg),
        ("longitude", "DEG", initial.longitude_deg),
    ):
        element = ET.SubElement(root, tag, unit=unit)
        element.text = repr(float(value))
        if tag == "latitude":
            element.set("type", "geodetic")
    return root


def runscript(
    model: str, title: str, before_trim: dict[str, float], commands: list[Step], engines: int
) -> ET.Element:
    """The `<runscript>`.

    Args:
        model: JSBSim's name of the aircraft.
        title: of the aircraft.
        before_trim: properties to be set before the trim: gear, switches, fuel.
        commands: in time.
        engines: number of them, whose thrust goes into the output.
    """
    root = ET.Element("runscript", name=f"{title}: inner loop of ftc-jsb")
    ET.SubElement(root, "description").text = (
        "Trims, engages the inner loop (ftc/engaged), then steps the commands that an outer loop gives: "
        "ftc/command/thrust-n [N], load-factor, bank-rad [rad]. Set ftc/effectiveness/engine[0] "
        "below 1 for a loss of thrust."
    )
    ET.SubElement(root, "use", aircraft=model, initialize=INITIAL)
    run = ET.SubElement(root, "run", start="0.0", end=repr(END), dt=repr(1.0 / RATE))
    trim = {**before_trim, "propulsion/set-running": -1.0, "simulation/do_simple_trim": 1.0}
    _event(run, "trim", 0.0, trim)
    for step in commands:
        values = {
            "ftc/command/thrust-n": step.thrust,
            "ftc/command/load-factor": step.load_factor,
            "ftc/command/bank-rad": step.bank_angle,
        }
        _event(
            run,
            step.title,
            step.time,
            values | ({"ftc/engaged": 1.0} if step.time == ENGAGE else {}),
        )
    output = ET.SubElement(root, "output", name=f"{model}.csv", type="CSV", rate="20")
    for column in (*COLUMNS, *map(thrust_property, range(engines))):
        ET.SubElement(output, "property").text = column
    return root


def _event(run: ET.Element, name: str, time: float, values: dict[str, float]) -> None:
    event = ET.SubElement(run, "event", name=name)
    ET.SubElement(event, "condition").text = f"simulation/sim-time-sec ge {time!r}"
    for key, value in values.items():
        ET.SubElement(event, "set", name=key, value=repr(float(value)))
    ET.SubElement(event, "notify")
