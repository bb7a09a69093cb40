"""Where shipped aircraft and scenarios are: inside the installed package, or beside it in a checkout."""

from pathlib import Path

from ftc_jsb.bounded_file import is_file
from ftc_jsb.errors import AircraftError
from ftc_jsb.suggestion import did_you_mean

PAPER_AIRCRAFT = "paper"  # the aircraft of the model `paper`
_PACKAGE = Path(__file__).parent


def shipped(folder: str) -> Path:
    """Path of the shipped `aircraft` or `scenarios` folder."""
    installed = _PACKAGE / "shipped" / folder
    return installed if installed.is_dir() else _PACKAGE.parent / folder


def aircraft_folder(name: str) -> Path:
    """Folder of an aircraft: a bare name is a shipped one, `./name` or any other path a folder.

    Raises:
        AircraftError: there is no such folder.
    """
    folder = _folder(name)
    if folder is not None:
        return folder
    known = ", ".join(aircraft_names())
    raise AircraftError(
        f"aircraft.name: no aircraft {name!r}{did_you_mean(name, aircraft_names())}; expected one of {known}, "
        "or the path of a folder (./mine) that holds point_mass.toml; `ftc-jsb inner-loop` makes one of an "
        "aircraft of the jsbsim package"
    )


def is_folder(name: str) -> bool:
    """Whether `aircraft_folder` would find one."""
    return _folder(name) is not None


def _folder(name: str) -> Path | None:
    plain = Path(name).name == name  # a bare name is a shipped aircraft, whatever lies around
    candidate = shipped("aircraft") / name if plain else Path(name)
    files = ("point_mass.toml", "aircraft.toml")
    return candidate.resolve() if any(is_file(candidate / file) for file in files) else None


def aircraft_names() -> list[str]:
    """Names of the shipped aircraft."""
    return sorted(path.parent.name for path in shipped("aircraft").glob("*/point_mass.toml"))
