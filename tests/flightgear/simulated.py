"""The exported F-16 in plain JSBSim, as FlightGear flies it: a picture now and then, lines out and in."""

import xml.etree.ElementTree as ET
from collections.abc import Callable, Iterator
from pathlib import Path

import jsbsim

from ftc_jsb.flightgear.lines import line_of
from ftc_jsb.six_dof.exchange.fields import COMMANDED

FRAME = 1.0 / 120.0  # [s]


def loaded(folder: Path) -> jsbsim.FGFDMExec:
    """The aircraft of an export, trimmed at 300 m/s and 3048 m, its engines running."""
    fdm = jsbsim.FGFDMExec(None)
    fdm.set_debug_level(0)
    fdm.set_dt(FRAME)
    parts = (str(folder), str(folder / "Engines"), str(folder / "Systems"))
    assert fdm.load_model_with_paths(folder.name, *parts, False)
    fdm["ic/h-sl-ft"], fdm["ic/vt-fps"] = 10000.0, 984.25
    fdm["ic/lat-geod-deg"], fdm["ic/long-gc-deg"] = 47.0, 8.0
    fdm["gear/gear-cmd-norm"] = fdm["gear/gear-pos-norm"] = 0.0
    fdm.run_ic()
    fdm["propulsion/set-running"] = -1
    fdm["simulation/do_simple_trim"] = 1
    return fdm


def properties(folder: Path, name: str) -> list[str]:
    """JSBSim's properties of a protocol file, in their order."""
    chunks = ET.parse(folder / "Protocol" / name).iter("chunk")
    return [chunk.findtext("node", "").removeprefix("/fdm/jsbsim/") for chunk in chunks]


def put(fdm: jsbsim.FGFDMExec, line: bytes) -> None:
    """A line of commands as FlightGear reads it: numbers into properties, unseen."""
    names = [*(field.property for field in COMMANDED), "ftc/link/check"]
    for name, number in zip(names, line.split(b","), strict=False):
        fdm[name] = float(number)


def command(fdm: jsbsim.FGFDMExec, **values: float) -> bytes:
    """A line of commands: level flight by default, answering the frame of now."""
    given = {field.name: 0.0 for field in COMMANDED}
    given |= {name: 1.0 for name in given if name.endswith("_effectiveness")}
    given |= {"sequence": 1, "frame": fdm["simulation/frame"], "flies": 1, "thrust_cmd": 36000.0}
    given |= {"load_factor_cmd": 1.0, "airspeed_ref": 300.0}
    return line_of([(given | values)[field.name] for field in COMMANDED])


class SimulatedLink:
    """A `SimulatorLink` to JSBSim in this process: each `receive` is a picture, in no real time.

    A command is in force from the picture after the next on, as in FlightGear.
    """

    port = 0

    def __init__(self, folder: Path, frames: Callable[[int], int] = lambda _: 5) -> None:
        """Args: of the aircraft; frames of JSBSim in the picture of a number."""
        self.fdm = loaded(folder)
        self._outgoing = properties(folder, "ftc-out.xml")
        self._frames = frames
        self._waiting: list[bytes] = []
        self.pictures = 0
        self.lines: Callable[[bytes], list[bytes]] = lambda line: [
            line
        ]  # what the way makes of them
        self.answers: Callable[[bytes], list[bytes]] = lambda line: [line]
        self.before: Callable[[SimulatedLink], None] = lambda _: None

    def receive(self, timeout: float) -> list[bytes]:
        """A picture."""
        self.before(self)
        waiting, self._waiting = self._waiting, []
        for _ in range(self._frames(self.pictures)):
            self.fdm.run()
        for line in waiting:
            put(self.fdm, line)
        self.pictures += 1
        line = ",".join(repr(self.fdm[name]) for name in self._outgoing).encode() + b"\n"
        return self.lines(line)

    def send(self, line: bytes) -> None:
        """A command."""
        self._waiting += self.answers(line)

    def close(self) -> None:
        """Nothing is held."""


def drawn(shares: dict[str, float], seed: int) -> Callable[[bytes], list[bytes]]:
    """A way that drops, doubles, swaps and garbles shares of the lines."""
    import random

    chance = random.Random(seed)
    held: list[bytes] = []

    def way(line: bytes) -> list[bytes]:
        def parts() -> Iterator[bytes]:
            if chance.random() < shares.get("dropped", 0.0):
                return
            if chance.random() < shares.get("swapped", 0.0):
                held.append(line)
                return
            garbled = chance.random() < shares.get("garbled", 0.0)
            yield b"7" + line if garbled else line
            if chance.random() < shares.get("doubled", 0.0):
                yield line
            while held:
                yield held.pop()

        return list(parts())

    return way
