"""FlightGear on a screen of its own, and its properties over its telnet port."""

import os
import shutil
import socket
import subprocess
import time
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

from ftc_jsb.aircraft.description import load_aircraft
from ftc_jsb.export.flightgear.aircraft_folder import aircraft_name, export_flightgear
from ftc_jsb.flightgear.program import data_folder, find_program, start_options
from ftc_jsb.scenario.schema import AircraftChoice, Initial

TELNET = 5501
# Over the sea: FlightGear's base package has no scenery here, and software rendering has little to draw.
PLACE = Initial(latitude_deg=37.6, longitude_deg=-122.4)
F16 = AircraftChoice()
PLAIN = (
    "--disable-clouds3d",
    "--disable-clouds",
    "--disable-random-objects",
    "--prop:bool:/sim/rendering/random-vegetation=false",
    "--prop:bool:/sim/rendering/shaders/use-shaders=false",
)


class Properties:
    """FlightGear's property tree, over telnet."""

    def __init__(self, port: int = TELNET) -> None:
        """Connects to this machine's port; raises OSError where nobody listens."""
        self._port = port
        self._connect()

    def connect(self) -> None:
        """Once more, as soon as somebody listens: a reset of FlightGear closes the connection."""
        until = time.monotonic() + 60.0  # [s]
        while True:
            try:
                return self._connect()
            except OSError:
                if time.monotonic() > until:
                    raise
                time.sleep(1.0)

    def _connect(self) -> None:
        self._socket = socket.create_connection(("127.0.0.1", self._port), 10.0)
        self._file = self._socket.makefile("rw", newline="\r\n")
        self._say("data")

    def _say(self, text: str) -> None:
        self._file.write(f"{text}\r\n")
        self._file.flush()

    def get(self, name: str) -> float:
        """A number."""
        self._say(f"get {name}")
        said = self._file.readline().strip()
        return (
            {"true": 1.0, "false": 0.0}.get(said) if said in ("true", "false") else float(said or 0)
        )

    def set(self, name: str, value: object) -> None:
        """A number, or a text."""
        self._say(f"set {name} {value}")

    def run(self, command: str) -> None:
        """A command of FlightGear's own."""
        self._say(f"run {command}")


@contextmanager
def screen(size: str) -> Iterator[str]:
    """A screen without a monitor; gives what DISPLAY has to be."""
    for number in range(80, 99):
        if not Path(f"/tmp/.X{number}-lock").exists():
            break
    name = f":{number}"
    server = subprocess.Popen(
        ["Xvfb", name, "-screen", "0", f"{size}x24"],
        stdout=subprocess.DEVNULL,
        stderr=subprocess.DEVNULL,
    )
    try:
        time.sleep(2.0)
        yield name
    finally:
        server.terminate()
        server.wait()


@contextmanager
def flightgear(
    folder: Path,
    display: str,
    size: str,
    ports: tuple[int, int],
    *options: str,
    choice: AircraftChoice = F16,
    initial: Initial = PLACE,
) -> Iterator[Properties]:
    """FlightGear with an exported aircraft in the air, until the end of the block.

    Args:
        folder: for the export and the log.
        display: of `screen`.
        size: of its window.
        ports: to which its lines go, and at which it listens.
        options: besides.
        choice: of the aircraft; the F-16 by default.
        initial: where it is, and how fast.
    """
    export = folder / "aircraft"
    export.mkdir(parents=True)
    aircraft = load_aircraft(choice.name)
    export_flightgear(aircraft, choice, export)
    program = find_program(None)
    arguments = start_options(export, aircraft_name(aircraft), initial, data_folder(program), ports)
    command = [program, *arguments, *PLAIN, f"--geometry={size}", f"--telnet={TELNET}", *options]
    if shutil.which("dbus-run-session"):
        command = ["dbus-run-session", "--", *command]
    environment = {**os.environ, "DISPLAY": display, "LIBGL_ALWAYS_SOFTWARE": "1"}
    with (folder / "fgfs.log").open("wb") as log:
        process = subprocess.Popen(
            command, stdout=log, stderr=subprocess.STDOUT, env=environment, start_new_session=True
        )
        try:
            yield _in_the_air(process)
        finally:
            os.killpg(process.pid, 15)
            try:
                process.wait(20.0)
            except subprocess.TimeoutExpired:
                os.killpg(process.pid, 9)
                process.wait()


def _in_the_air(process: subprocess.Popen[bytes]) -> Properties:
    until = time.monotonic() + 300.0  # [s]: the first start builds a cache
    while time.monotonic() < until and process.poll() is None:
        try:
            properties = Properties()
            while properties.get("/fdm/jsbsim/simulation/sim-time-sec") < 3.0:
                time.sleep(1.0)
            return properties
        except OSError:
            time.sleep(2.0)
    raise RuntimeError("FlightGear did not get into the air; see fgfs.log")


def picture(display: str, path: Path) -> None:
    """What is on the screen, as PNG."""
    window = subprocess.run(
        ["xwd", "-root", "-silent", "-display", display], capture_output=True, check=True
    )
    subprocess.run(["convert", "xwd:-", str(path)], input=window.stdout, check=True)
