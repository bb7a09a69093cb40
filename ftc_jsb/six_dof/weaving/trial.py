"""Files of a user's aircraft, run by JSBSim in a process of their own first: JSBSim may abort on them."""

import hashlib
import subprocess
import sys
from pathlib import Path

from ftc_jsb.errors import AircraftError
from ftc_jsb.resources import shipped
from ftc_jsb.verified_cache import read_cached, write_cached

PROGRAM = Path(__file__).with_name("trial_run.py")
PATIENCE = 60.0  # [s]; a trial takes half a second
SURVIVED = b"survived"
_SIGNALS = {
    4: "an illegal instruction",
    6: "an abort",
    8: "a division by zero",
    11: "a bad address",
}


_ours: set[Path] = (
    set()
)  # folders of aircraft that this process has tried, and goes on writing itself


def vouch_for(folder: Path) -> None:
    """Take what comes into an aircraft's folder from now on for this program's own."""
    _ours.add(folder.resolve())


def is_vouched_for(folder: Path) -> bool:
    """Whether an aircraft's folder is shipped, or written by this process."""
    place = folder.resolve()
    return place in _ours or place.is_relative_to(shipped("aircraft").resolve())


def try_out(name: str, model: str, root: Path) -> None:
    """See that JSBSim survives an aircraft; what it refuses in words is left for it to say again.

    Args:
        name: of the aircraft, for messages.
        model: of JSBSim.
        root: of the woven aircraft, named after all that is in it: it is tried once.

    Raises:
        AircraftError: JSBSim is aborted by it, or does not come to an end.
    """
    program = hashlib.sha256(PROGRAM.read_bytes()).hexdigest()
    mark = f"aircraft/{root.name}-{program[:8]}.tried"
    if read_cached(mark) == SURVIVED:
        return
    # -P: the program's own folder is not searched for modules.
    command = [sys.executable, "-P", str(PROGRAM), model, str(root)]
    try:
        made = subprocess.run(
            command, capture_output=True, timeout=PATIENCE, check=False, stdin=subprocess.DEVNULL
        )
    except subprocess.TimeoutExpired:
        raise AircraftError(
            f"aircraft {name!r}: JSBSim does not come to an end with it in {PATIENCE:g} s"
        ) from None
    if SURVIVED in made.stdout.splitlines():
        write_cached(mark, SURVIVED)
        return
    code = made.returncode
    how = _SIGNALS.get(-code, f"signal {-code}") if code < 0 else f"exit code {code}"
    said = " ".join((made.stderr + b" " + made.stdout).decode("utf-8", "replace").split())[-300:]
    raise AircraftError(f"aircraft {name!r}: JSBSim ends with {how} on its files: {said}")
