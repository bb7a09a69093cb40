"""The installed command as a vehicle for real ground stations, run beside them."""

import re
import subprocess
import sys
from contextlib import contextmanager
from pathlib import Path

BIN = Path(sys.executable).parent


@contextmanager
def vehicle(port: int, folder: Path, *arguments: str, scenario: str = "nominal"):
    """`ftc-jsb fly` at 1 x, sending to a UDP port of this machine; ended after the block."""
    command = [BIN / "ftc-jsb", "fly", scenario, "--realtime", "--mavlink", f"udpout:127.0.0.1:{port}",
               "--out", folder / "flight", *arguments]  # fmt: skip
    with (folder / "fly.log").open("w") as log:
        process = subprocess.Popen(command, cwd=folder, stdout=log, stderr=log)
        try:
            yield process
        finally:
            process.terminate()
            process.wait(20.0)


def reported_port(process: subprocess.Popen) -> int:
    """The port at which a vehicle says on its standard error that it listens."""
    for line in process.stderr:
        if found := re.search(
            r"note: the vehicle listens at \w+:127\.0\.0\.1:(\d+)$", line.rstrip()
        ):
            return int(found[1])
    raise AssertionError("no port was reported")


def dumped(tlog: Path, *kinds: str) -> list[str]:
    """Lines that mavlogdump prints of a log."""
    types = ["--types", ",".join(kinds)] if kinds else []
    result = subprocess.run(
        [sys.executable, "-W", "ignore", BIN / "mavlogdump.py", *types, tlog],
        capture_output=True, text=True, timeout=60, check=True,
    )  # fmt: skip
    return result.stdout.splitlines()
