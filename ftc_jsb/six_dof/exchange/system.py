"""The JSBSim system that the exchange needs, generated from its fields, and the check at the end of a frame."""

import xml.etree.ElementTree as ET
from collections.abc import Sequence
from pathlib import Path

from ftc_jsb.aircraft.description import Aircraft
from ftc_jsb.six_dof.exchange.fields import (
    ABSENT,
    CHECK,
    COMMANDED,
    FAULTS,
    LINK,
    MEASURED_CHECK,
    RECEIVED,
    Field,
    fault_property,
    measured_fields,
)

STRUCTURE = Path(__file__).with_name("exchange_structure.xml")
EXCHANGE_SYSTEM = "ftc_exchange"
DIALOG = "ftc/dialog"  # faults that the dialog injects, on top of those that come over the link
TOLERANCE = 1e-6  # of the check: rounding of the sum, and of numbers printed with 17 digits
LONG_AGO = 1e9  # [s], age of a command that never came


def exchange_system(aircraft: Aircraft, engines: int) -> ET.ElementTree:
    """The system: what comes is checked and latched; who flies; hold; pilot; faults; the set-up.

    Args:
        aircraft: its set-up is held, and its tested airspeeds bound the pilot's.
        engines: that it has.
    """
    root = ET.parse(STRUCTURE).getroot()
    for name, value in _declared(aircraft):
        declared = ET.Element("property", value=repr(value))
        declared.text = name
        root.insert(0, declared)
    first = next(place for place, element in enumerate(root) if element.tag == "channel")
    root.insert(first, _acceptance())
    total = root.find(".//fcs_function[@name='ftc/hold/thrust-at-start-n']//sum")
    assert total is not None
    terms = "".join(f"<p>propulsion/engine[{k}]/thrust-lbs</p>" for k in range(engines))
    total.extend(ET.fromstring(f"<sum>{terms}<v>0</v></sum>"))
    root.append(_faults(engines))
    root.append(_setup(aircraft))
    return ET.ElementTree(root)


def check_function(aircraft: Aircraft, engines: int) -> ET.Element:
    """A function at the end of the aerodynamics, where all fields of the frame are known."""
    text = _weighted(measured_fields(aircraft, engines))
    return ET.fromstring(
        f'<function name="{MEASURED_CHECK.property}" type="post">{text}</function>'
    )


def add_exchange(fdm: ET.Element, aircraft: Aircraft, engines: int) -> None:
    """Put the check into the aerodynamics of an aircraft's XML, in place."""
    aerodynamics = fdm.find("aerodynamics")
    assert aerodynamics is not None  # the weaving has seen it
    aerodynamics.append(check_function(aircraft, engines))


def _declared(aircraft: Aircraft) -> list[tuple[str, float]]:
    slowest, fastest = aircraft.flight_test.airspeed
    properties = [
        (ABSENT, 0.0),
        ("ftc/pilot/airspeed-min-mps", slowest),
        ("ftc/pilot/airspeed-max-mps", fastest),
        (f"{RECEIVED}/age-s", LONG_AGO),
        (f"{RECEIVED}/at-frame", 0.0),
        (f"{RECEIVED}/refused", 0.0),
        (f"{LINK}/seen-sequence", 0.0),
        (f"{LINK}/seen-check", 0.0),
        (CHECK.property, 0.0),
    ]
    properties += [(field.property, 0.0) for field in COMMANDED]
    properties += [(_received(field), _healthy(field.name)) for field in COMMANDED]
    properties += [(f"{DIALOG}/{name.replace('_', '-')}", _healthy(name)) for name in FAULTS]
    return properties


def _healthy(name: str) -> float:
    return 1.0 if name.endswith("_effectiveness") else 0.0


def _received(field: Field) -> str:
    return field.property.replace(LINK, RECEIVED, 1)


def _weighted(fields: Sequence[Field]) -> str:
    terms = "".join(
        f"<product><v>{place}</v><p>{field.property}</p></product>"
        for place, field in enumerate(fields, 1)
    )
    return f"<sum>{terms}</sum>"


def _function(name: str, text: str, output: str = "") -> str:
    to = f"<output>{output}</output>" if output else ""
    return f'<fcs_function name="{name}"><function>{text}</function>{to}</fcs_function>'


def _copy(name: str, to: str) -> str:
    """The value of a property put into another."""
    return _function(f"{to}-next", f"<sum><p>{name}</p><v>0</v></sum>", to)


def _acceptance() -> ET.Element:
    """A line is taken if its check is right and it answers a later frame than the last one did."""
    new, answered = f"<gt><p>{LINK}/new</p><v>0.5</v></gt>", f"<p>{RECEIVED}/frame</p>"
    error = f"<abs><difference><p>{LINK}/sum</p><p>{CHECK.property}</p></difference></abs>"
    changed = (
        f"<or><nq><p>{LINK}/sequence</p><p>{LINK}/seen-sequence</p></nq>"
        f"<nq><p>{CHECK.property}</p><p>{LINK}/seen-check</p></nq></or>"
    )
    frame = "<p>simulation/frame</p>"
    functions = [
        _function(f"{LINK}/sum", _weighted(COMMANDED)),
        _function(
            f"{LINK}/new",
            f"<and><lt>{error}<v>{TOLERANCE!r}</v></lt><ge><p>{LINK}/sequence</p><v>1</v></ge>"
            f"<gt><p>{LINK}/frame</p>{answered}</gt><le><p>{LINK}/frame</p>{frame}</le></and>",
        ),
        _function(
            f"{LINK}/refused-next",
            f"<sum><p>{RECEIVED}/refused</p><and>{changed}<lt><p>{LINK}/new</p><v>0.5</v></lt></and></sum>",
            f"{RECEIVED}/refused",
        ),
        _copy(f"{LINK}/sequence", f"{LINK}/seen-sequence"),
        _copy(CHECK.property, f"{LINK}/seen-check"),
        _function(
            f"{LINK}/age-next",
            f"<ifthen>{new}<v>0</v><sum><p>{RECEIVED}/age-s</p><p>simulation/dt</p></sum></ifthen>",
            f"{RECEIVED}/age-s",
        ),
        _function(
            f"{LINK}/at-frame-next",
            f"<ifthen>{new}{frame}<p>{RECEIVED}/at-frame</p></ifthen>",
            f"{RECEIVED}/at-frame",
        ),
    ]  # fmt: skip
    for field in COMMANDED:
        kept = f"<p>{_received(field)}</p>"
        if field.name == "frame":  # a simulator that was reset starts anew
            kept = f"<min>{kept}{frame}</min>"
        functions.append(
            _function(
                f"{field.property}-next",
                f"<ifthen>{new}<p>{field.property}</p>{kept}</ifthen>",
                _received(field),
            )
        )
    return ET.fromstring(f'<channel name="line">{"".join(functions)}</channel>')


def _faults(engines: int) -> ET.Element:
    """Faults that come over the link, and those of the dialog on top of them."""
    functions = []
    for name in FAULTS:
        target = fault_property(name, engines)
        if target == ABSENT:
            continue
        dashed = name.replace("_", "-")
        given, own = f"<p>{RECEIVED}/{dashed}</p>", f"<p>{DIALOG}/{dashed}</p>"
        if name.endswith("_effectiveness"):
            text = f"<product>{given}{own}</product>"
        else:
            text = f"<ifthen><gt>{own}<v>0.5</v></gt>{own}{given}</ifthen>"
        functions.append(_function(f"ftc/exchange/{dashed}", text, target))
    return ET.fromstring(f'<channel name="faults">{"".join(functions)}</channel>')


def _setup(aircraft: Aircraft) -> ET.Element:
    """What aircraft.toml sets before the trim, held: a simulator has levers of its own."""
    functions = [
        _function(f"ftc/setup/v{number}", f"<sum><v>{value!r}</v><v>0</v></sum>", name)
        for number, (name, value) in enumerate(aircraft.setup.items())
    ]
    return ET.fromstring(f'<channel name="set-up">{"".join(functions)}</channel>')
