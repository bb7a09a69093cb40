"""A finished flight that cannot be saved where it should be is saved elsewhere."""

import tempfile
from pathlib import Path

import platformdirs

from ftc_jsb.errors import WriteError
from ftc_jsb.recording.flight import Flight
from ftc_jsb.recording.netcdf import save

MEMORY = Path("/dev/shm")  # a disk in memory, where every other one is full


def save_or_rescue(flight: Flight, path: Path) -> None:
    """Save a flight to `path`; where that fails, to another disk.

    Raises:
        WriteError: it is not at `path`; says where it is instead.
    """
    try:
        save(flight, path)
    except WriteError as error:
        raise WriteError(path, f"{error.reason}; {_rescued(flight, path.name)}") from error


def _rescued(flight: Flight, name: str) -> str:
    """Where the flight is now."""
    folders = (
        Path(tempfile.gettempdir()),
        Path(platformdirs.user_state_dir("ftc-jsb")),
        MEMORY,
    )
    for folder in folders:
        try:
            folder.mkdir(parents=True, exist_ok=True)
            place = Path(tempfile.mkdtemp(prefix="ftc-jsb-rescued-", dir=folder)) / name
            save(flight, place)
        except OSError:
            continue
        except WriteError:
            place.parent.rmdir()
            continue
        return f"the flight is saved as {place}"
    return "nor can the flight be saved in " + ", ".join(map(str, folders))
