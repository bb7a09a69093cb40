"""Which positions of an installed aircraft answer which command, and how far they go."""

import xml.etree.ElementTree as ET
from typing import Any, NamedTuple

import numpy as np

from ftc_jsb.aircraft.description import Positions, Surface, Surfaces, Throttle
from ftc_jsb.draft.probe import hold, settle
from ftc_jsb.errors import AircraftError
from ftc_jsb.six_dof.weaving.installed import Installed
from ftc_jsb.vocabulary.channels import SURFACES

READERS = ("property", "p", "independentVar")  # elements that hold the name of a property read
USUAL = {  # JSBSim's own position of each surface [rad]
    "elevator": "fcs/elevator-pos-rad",
    "aileron": "fcs/left-aileron-pos-rad",
    "rudder": "fcs/rudder-pos-rad",
}
LEAST_TRAVEL = 1e-3  # [rad] or of 1
THROTTLE = "fcs/throttle-pos-norm"
THROTTLE_COMMAND = "fcs/throttle-cmd-norm"
HALF = 0.5  # throttle command
AIRSPEEDS = (90.0, 180.0, 270.0)  # [m/s] where the aircraft is held: some travels go by pressure
ALTITUDE, ALPHA = 3048.0, 0.05  # [m], [rad]


class Controls(NamedTuple):
    """Sections of `aircraft.toml`."""

    surfaces: Surfaces
    positions: Positions
    throttle: Throttle


def controls(model: str, source: Installed, fdm: Any) -> Controls:
    """Surfaces, positions and throttle of an installed aircraft, from how they answer commands.

    A position that answers several commands, as an elevon does, counts to the one that moves it most.

    Args:
        model: of JSBSim.
        source: its XML.
        fdm: it, loaded as installed.

    Raises:
        AircraftError: no position that the aerodynamics read answers one of the commands.
    """
    read = _positions_read(source.root)
    travels = {command: _widest(fdm, command, read) for command in SURFACES}
    found: dict[str, list[Surface]] = {}
    for command in SURFACES:
        own = [p for p in read if _mover(travels, p) == command]
        if not own:
            raise AircraftError(
                f"aircraft {model!r}: no position that its aerodynamics read answers "
                f"fcs/{command}-cmd-norm; they read {', '.join(read) or 'none'}"
            )
        found[command] = [_surface(p, travels[command][p]) for p in own]
    usual = {
        command: USUAL[command]
        if any(s.property == USUAL[command] for s in own)
        else own[0].property
        for command, own in found.items()
    }
    return Controls(
        Surfaces(**{command: tuple(own) for command, own in found.items()}),
        Positions(throttle=THROTTLE, flap="fcs/flap-pos-norm", **usual),
        _throttle(fdm, source),
    )


def _positions_read(root: ET.Element) -> list[str]:
    """Properties of flight control that the aerodynamics read, in order, each once."""
    aerodynamics = root.find("aerodynamics")
    texts = [] if aerodynamics is None else [e for e in aerodynamics.iter() if e.tag in READERS]
    names = [(e.text or "").strip().removeprefix("-") for e in texts]
    names = [name.replace("fcs/mag-", "fcs/", 1) for name in names]
    return list(dict.fromkeys(name for name in names if name.startswith("fcs/")))


def _widest(fdm: Any, command: str, read: list[str]) -> dict[str, tuple[float, float]]:
    """Position at full command to each side, where it goes furthest."""
    widest: dict[str, tuple[float, float]] = {}
    for airspeed in AIRSPEEDS:
        hold(fdm, airspeed, ALTITUDE, ALPHA)
        for name, ends in _travels(fdm, command, read).items():
            if name not in widest or abs(np.subtract(*ends)) > abs(np.subtract(*widest[name])):
                widest[name] = ends
    return widest


def _travels(fdm: Any, command: str, read: list[str]) -> dict[str, tuple[float, float]]:
    """Position at full command to each side, for each property that was read."""
    ends = []
    for value in (-1.0, 1.0):
        for surface in SURFACES:
            fdm[f"fcs/{surface}-cmd-norm"] = value if surface == command else 0.0
        settle(fdm)
        ends.append({name: float(fdm[name]) for name in read if _exists(fdm, name)})
    fdm[f"fcs/{command}-cmd-norm"] = 0.0
    settle(fdm)
    low, high = ends
    return {name: (low[name], high[name]) for name in low}


def _exists(fdm: Any, name: str) -> bool:
    try:
        fdm[name]
    except KeyError:
        return False
    return True


def _mover(travels: dict[str, dict[str, tuple[float, float]]], name: str) -> str | None:
    """Command that moves a position most; None if none does."""
    spans = {
        command: abs(ends[name][1] - ends[name][0])
        for command, ends in travels.items()
        if name in ends
    }
    most = max(spans, key=lambda command: spans[command], default=None)
    return most if most is not None and spans[most] > LEAST_TRAVEL else None


def _surface(name: str, ends: tuple[float, float]) -> Surface:
    travel = round(ends[0], 4), round(ends[1], 4)
    return Surface(property=name, unit="rad" if name.endswith("-rad") else "norm", travel=travel)


def _throttle(fdm: Any, source: Installed) -> Throttle:
    """Where JSBSim reads the throttle in the same frame: before a channel of its own, if it has one."""
    if not any(_writes_throttle(root) for root in source.with_systems()):
        return Throttle(property=THROTTLE, military=1.0)
    fdm[THROTTLE_COMMAND] = HALF
    settle(fdm)
    answer = float(fdm[THROTTLE])
    if answer <= 0.0:
        raise AircraftError(
            f"{fdm.get_model_name()}: {THROTTLE} does not answer {THROTTLE_COMMAND} = {HALF:g}"
        )
    return Throttle(property=THROTTLE_COMMAND, military=round(HALF / answer, 6))


def _writes_throttle(root: ET.Element) -> bool:
    """Whether a component of flight control, a system or an autopilot sets the first throttle."""
    outputs = {(element.text or "").strip() for element in root.iter("output")}
    components = {element.get("name", "") for element in root.iter()}
    return bool({THROTTLE, f"{THROTTLE}[0]"} & (outputs | components))
