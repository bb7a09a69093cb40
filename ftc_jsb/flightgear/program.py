"""FlightGear as a program: where it is, how it is started with the exported aircraft, how it ends."""

import os
import re
import shutil
import subprocess
from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from pathlib import Path

from ftc_jsb.errors import LinkError
from ftc_jsb.point_mass.atmosphere import standard_atmosphere
from ftc_jsb.scenario.schema import Initial
from ftc_jsb.units import FOOT

PROGRAM = "fgfs"
PLACES = ("/usr/games",)  # where a PATH may not lead
EXCHANGE_RATE = 120  # [Hz], at most; FlightGear exchanges once a frame of its picture
STOP = 10.0  # [s] until it is killed
STILL_AIR = "XXXX 012345Z 00000KT 9999 CLR 15/05 Q1013 NOSIG"  # METAR of no station: standard air
# What a flight does not need, and may be in its way.
QUIET = (
    "--disable-sound",
    "--disable-real-weather-fetch",
    "--disable-terrasync",
    "--disable-splash-screen",
    "--disable-ai-traffic",
    "--disable-ai-models",
    "--wind=0@0",
    "--turbulence=0.0",
)


def find_program(given: str | None) -> str:
    """The program `fgfs`, as given or where it is found.

    Raises:
        LinkError: it is not there.
    """
    path = os.pathsep.join([os.environ.get("PATH", ""), *PLACES])
    found = shutil.which(given or PROGRAM, path=path)
    if found is None:
        where = f"--fgfs {given}: no such program" if given else f"{PROGRAM}: not found"
        raise LinkError(
            f"{where}; install FlightGear (Debian: apt install flightgear) or give --fgfs PROGRAM"
        )
    return found


def data_folder(program: str) -> Path:
    """FlightGear's own data, as the program says.

    Raises:
        LinkError: it does not say.
    """
    given = os.environ.get("FG_ROOT")
    if given:
        return Path(given)
    said = subprocess.run(
        [program, "--version"], capture_output=True, text=True, check=False, timeout=60.0,
        env={**os.environ, "QT_QPA_PLATFORM": "offscreen"},  # it would open a window to say so
    )  # fmt: skip
    found = re.search(r"^FG_ROOT=(.+)$", said.stdout, re.MULTILINE)
    if found is None:
        raise LinkError(f"{program} --version: expected a line FG_ROOT=...; set FG_ROOT")
    return Path(found[1].strip())


def start_options(
    folder: Path,
    name: str,
    initial: Initial,
    root: Path,
    ports: tuple[int, int],
    host: str = "127.0.0.1",
) -> list[str]:
    """Options of `fgfs` that put the aircraft into the air at [initial], with the exchange.

    Args:
        folder: of the export.
        name: of the aircraft there.
        initial: where and how fast.
        root: FlightGear's own data.
        ports: of the loop, and of the simulator.
        host: of the loop.
    """
    protocol = Path(os.path.relpath(folder / name / "Protocol", root / "Protocol"))
    mach = initial.airspeed / standard_atmosphere(initial.altitude)[1]
    sockets = [
        f"--generic=socket,{way},{EXCHANGE_RATE},{host},{port},udp,{protocol / file}"
        for way, port, file in (("out", ports[0], "ftc-out"), ("in", ports[1], "ftc-in"))
    ]
    return [
        f"--fg-aircraft={folder}",
        f"--aircraft={name}",
        "--in-air",
        "--trim",
        "--prop:bool:/sim/presets/running=true",
        f"--lat={initial.latitude_deg!r}",
        f"--lon={initial.longitude_deg!r}",
        f"--altitude={initial.altitude / FOOT:.1f}",
        f"--mach={mach:.5f}",
        f"--heading={initial.heading_deg % 360.0:.3f}",
        "--timeofday=noon",
        f"--metar={STILL_AIR}",
        *QUIET,
        *sockets,
    ]


@contextmanager
def running(program: str, options: Sequence[str], log: Path) -> Iterator[subprocess.Popen[bytes]]:
    """The program, from now to the end of the block; what it says goes to a log.

    Raises:
        LinkError: it cannot be started.
    """
    with log.open("wb") as output:
        try:
            process = subprocess.Popen(
                [program, *options], stdout=output, stderr=subprocess.STDOUT, start_new_session=True
            )
        except OSError as error:
            raise LinkError(f"{program}: cannot be started: {error.strerror}") from None
        try:
            yield process
        finally:
            process.terminate()
            try:
                process.wait(STOP)
            except subprocess.TimeoutExpired:
                process.kill()
                process.wait()
