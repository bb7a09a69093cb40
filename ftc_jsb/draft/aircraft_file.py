"""The draft as an `aircraft.toml`."""

import tempfile
import xml.etree.ElementTree as ET
from collections.abc import Callable
from pathlib import Path
from typing import Any

from ftc_jsb.aircraft.airplane_class import airplane_class
from ftc_jsb.aircraft.description import Aircraft, FlightTest, Surface
from ftc_jsb.draft.controls import Controls, controls
from ftc_jsb.draft.envelope import Masses, flight_test
from ftc_jsb.draft.probe import loaded
from ftc_jsb.errors import AircraftError
from ftc_jsb.inner_loop_design.design import write_provisional
from ftc_jsb.six_dof.data_sheet import data_sheet
from ftc_jsb.six_dof.fuel_tanks import contents_property
from ftc_jsb.six_dof.properties import write_checked
from ftc_jsb.six_dof.weaving.installed import installed
from ftc_jsb.six_dof.weaving.woven_aircraft import woven_aircraft
from ftc_jsb.vocabulary.channels import SURFACES

LISTS = ("airspeed", "altitude", "fuel_fraction", "load_factor", "mach_breaks")
GEAR_UP = ("gear/gear-cmd-norm", "gear/gear-pos-norm")
TEMPLATE = """\
# {model} of the installed jsbsim package: what its weaving, trim and sensors need.
# Drafted by `ftc-jsb inner-loop {model}` with jsbsim {jsbsim}; docs/aircraft.md says how.
name = "{model}"
title = "{title}"
jsbsim_model = "{model}"
airplane_class = "{airplane_class}"  # MIL-F-8785C: I light, II medium, III heavy, IV fighter
fuel_tanks = {fuel_tanks}

[setup]  # properties set before the trim
{setup}
[throttle]  # what the inner loop writes, and its value at military thrust
property = "{throttle.property}"
military = {throttle.military:g}

[positions]  # rad, but for the throttle (1 military, 2 full reheat)
throttle = "{positions.throttle}"
elevator = "{positions.elevator}"
aileron = "{positions.aileron}"
rudder = "{positions.rudder}"
flap = "{positions.flap}"

[surfaces]  # positions that the aerodynamics read, with their travel
elevator = {elevator}
aileron = {aileron}
rudder = {rudder}

[flight_test]  # where `ftc-jsb identify` flies
airspeed = {airspeed}  # m/s
altitude = {altitude}  # m
fuel_fraction = {fuel_fraction}
load_factor = {load_factor}  # of its class: JSBSim has none
lift_coefficient_max = {test.lift_coefficient_max}  # the tests stay below it
mach_breaks = {mach_breaks}  # where drag begins to rise, or flaps switch
"""


def draft(model: str, folder: Path, progress: Callable[[str], None]) -> Path:
    """Write `aircraft.toml` of an aircraft of the installed jsbsim package into a folder.

    Args:
        model: its name there.
        folder: to be made.
        progress: told what is being done, a line at a time.

    Raises:
        AircraftError: it cannot be woven, flown or controlled; says what is missing.
    """
    progress(f"{model}: drafting aircraft.toml from the installed aircraft")
    source = installed(model)
    with tempfile.TemporaryDirectory(prefix="ftc-jsb-") as scratch:
        plain = Path(scratch) / "plain"
        source.copy_to(plain)
        fdm = loaded(model, plain)
        found = controls(model, source, fdm)
        provisional = _described(model, source.root, found, fdm).model_copy(
            update={"folder": Path(scratch)}
        )
        write_provisional(Path(scratch) / "inner_loop.xml", provisional)
        sheet = data_sheet(provisional)
        woven = loaded(model, woven_aircraft(provisional, True))
        for name, value in provisional.setup.items():
            woven[name] = value
        masses = Masses(sheet.empty_mass, sheet.fuel_capacity)
        test = flight_test(woven, masses, sheet.area)
    mass = masses.empty + 0.5 * masses.fuel
    return _write(
        folder,
        provisional.model_copy(
            update={
                "flight_test": test,
                "airplane_class": airplane_class(mass, test.load_factor[1]),
            }
        ),
    )


def _described(model: str, root: ET.Element, found: Controls, fdm: Any) -> Aircraft:
    """The aircraft with a test range that is yet to be found."""
    return Aircraft(
        name=model,
        title=f"{model} (JSBSim)",
        jsbsim_model=model,
        fuel_tanks=_tanks(root, fdm),
        setup={name: 0.0 for name in GEAR_UP if _takes(fdm, name, 0.0)},
        throttle=found.throttle,
        positions=found.positions,
        surfaces=found.surfaces,
        flight_test=FlightTest(
            airspeed=(1.0, 2.0),
            altitude=(0.0,),
            fuel_fraction=(0.5,),
            load_factor=(0.0, 2.0),
            lift_coefficient_max=1.0,
        ),
    )


def _tanks(root: ET.Element, fdm: Any) -> tuple[int, ...]:
    """Tanks that hold fuel as shipped."""
    count = len(root.findall("propulsion/tank"))
    return tuple(k for k in range(count) if fdm[contents_property(k)] > 0.0)


def _takes(fdm: Any, name: str, value: float) -> bool:
    try:
        write_checked(fdm, name, value)
    except AircraftError:
        return False
    return True


def _write(folder: Path, aircraft: Aircraft) -> Path:
    import jsbsim

    test = aircraft.flight_test
    text = TEMPLATE.format(
        model=aircraft.jsbsim_model,
        jsbsim=jsbsim.__version__,
        title=aircraft.title,
        airplane_class=aircraft.airplane_class,
        fuel_tanks=list(aircraft.fuel_tanks),
        setup="".join(f'"{name}" = {value}\n' for name, value in aircraft.setup.items()),
        throttle=aircraft.throttle,
        positions=aircraft.positions,
        test=test,
        **{name: _surfaces(getattr(aircraft.surfaces, name)) for name in SURFACES},
        **{name: list(getattr(test, name)) for name in LISTS},
    )
    folder.mkdir(parents=True, exist_ok=True)
    path = folder / "aircraft.toml"
    path.write_text(text, encoding="utf-8")
    return path


def _surfaces(positions: tuple[Surface, ...]) -> str:
    tables = [
        f'{{ property = "{p.property}", unit = "{p.unit}", travel = {list(p.travel)} }}'
        for p in positions
    ]
    return f"[{', '.join(tables)}]"
