"""The faults' part of the weaving: what stands between a surface and the air, a throttle and its engine.

The aerodynamics of the woven aircraft read `ftc/surface/...` in place of the positions that flight
control puts out, and the throttles pass through a function that can hold them. Without a fault both
pass on what they are given.
"""

import xml.etree.ElementTree as ET
from collections.abc import Iterable

from ftc_jsb.aircraft.description import Aircraft, Surface
from ftc_jsb.disturbance.faults import ENGINE_OUT, HEALTHY, HELD, OVER_POSITIVE
from ftc_jsb.errors import AircraftError
from ftc_jsb.vocabulary.channels import SURFACES

HARD_OVER_TIME = 0.5  # [s] from one end of the travel to the other
THROTTLE_STATE = "ftc/fault/throttle-state"  # one an engine


def surface_state(name: str) -> str:
    """Property that takes the state of a surface, as in the recording."""
    return f"ftc/fault/{name}-state"


def surface_effectiveness(name: str) -> str:
    """Property that takes what is left of a surface."""
    return f"ftc/fault/{name}-effectiveness"


def at_the_surface(property_name: str) -> str:
    """What the woven aerodynamics read in place of a position of the flight control system."""
    return f"ftc/surface/{property_name.removeprefix('fcs/')}"


def weave_faults(fdm: ET.Element, aircraft: Aircraft, engines: int) -> None:
    """Put surface and throttle faults behind the flight control of an aircraft's XML, in place.

    Raises:
        AircraftError: the aerodynamics do not read a position that `aircraft.toml` names.
    """
    control, aerodynamics = fdm.find("flight_control"), fdm.find("aerodynamics")
    if aerodynamics is None:
        raise AircraftError(f"aircraft {aircraft.name!r}: no aerodynamics")
    if control is None:  # its flight control is made of systems, and those run before this one
        control = ET.Element("flight_control", name="ftc faults")
        fdm.insert(list(fdm).index(aerodynamics), control)
    channel = ET.SubElement(control, "channel", name="ftc faults")
    for name in SURFACES:
        _declare(control, surface_state(name), "0")
        _declare(control, surface_effectiveness(name), "1")
        for position in getattr(aircraft.surfaces, name):
            channel.append(_surface(name, position))
            _magnitudes(aerodynamics, position.property)
            if not _renamed(aerodynamics.iter(), position.property):
                raise AircraftError(
                    f"aircraft {aircraft.name!r}, surfaces.{name}: the aerodynamics do not read "
                    f"{position.property!r}"
                )
    for number in range(engines):
        _declare(control, f"{THROTTLE_STATE}[{number}]", "0")
        channel.append(_throttle(number))


def _renamed(elements: Iterable[ET.Element], property_name: str) -> int:
    """Let elements that hold a property's name hold that of the surface; how many did."""
    found = 0
    for element in elements:
        if (element.text or "").strip() == property_name:
            element.text = at_the_surface(property_name)
            found += 1
    return found


def _magnitudes(aerodynamics: ET.Element, property_name: str) -> None:
    """Let JSBSim's own magnitude of a position, `fcs/mag-...`, be that of the surface."""
    magnitude = property_name.replace("fcs/", "fcs/mag-", 1)
    for element in list(aerodynamics.iter("property")):
        if (element.text or "").strip() == magnitude:
            element.tag, element.text = "abs", None
            ET.SubElement(element, "property").text = property_name


def _declare(control: ET.Element, name: str, value: str) -> None:
    declared = ET.Element("property", value=value)
    declared.text = name
    control.insert(0, declared)


def _surface(name: str, position: Surface) -> ET.Element:
    """Position of a surface: a part of it, held, or on its way to one end of the travel."""
    own, low, high = at_the_surface(position.property), *position.travel
    rate = abs(high - low) / HARD_OVER_TIME
    state, part = surface_state(name), surface_effectiveness(name)
    step = f"<product><p>simulation/dt</p><v>{rate}</v></product>"
    back = f"<product><v>-1</v>{step}</product>"
    end = f"<ifthen><gt><p>{state}</p><v>{OVER_POSITIVE + 0.5}</v></gt><v>{low}</v><v>{high}</v></ifthen>"
    way = f"<max>{back}<min>{step}<difference>{end}<p>{own}</p></difference></min></max>"
    moving = f"<ifthen><gt><p>{state}</p><v>{HELD + 0.5}</v></gt>{way}<v>0</v></ifthen>"
    return ET.fromstring(
        f"""<fcs_function name="{own}"><function>
          <ifthen><gt><p>{state}</p><v>{HELD - 0.5}</v></gt>
            <sum><p>{own}</p>{moving}</sum>
            <product><p>{part}</p><p>{position.property}</p></product>
          </ifthen></function></fcs_function>"""
    )


def _throttle(number: int) -> ET.Element:
    """Throttle position of an engine, the one at which it is stuck, or idle while it is out.

    Thrust of an engine that is out goes by its effectiveness, which is 0; its rotor runs down with
    the throttle, and has to spool up again when it is lit.
    """
    own, given = f"ftc/throttle-position-{number}", f"fcs/throttle-pos-norm[{number}]"
    state = f"<p>{THROTTLE_STATE}[{number}]</p>"
    out = f"<ifthen><gt>{state}<v>{HEALTHY + 0.5}</v></gt><v>0</v><p>{given}</p></ifthen>"
    return ET.fromstring(
        f"""<fcs_function name="{own}"><function>
          <ifthen><gt>{state}<v>{ENGINE_OUT + 0.5}</v></gt><p>{own}</p>{out}</ifthen></function>
          <output>{given}</output></fcs_function>"""
    )


def observed(aircraft: Aircraft, position: str) -> str:
    """Where a position that `aircraft.toml` names is to be read: at the surface, where it can fail."""
    failing = [s.property for name in SURFACES for s in getattr(aircraft.surfaces, name)]
    return at_the_surface(position) if position in failing else position
