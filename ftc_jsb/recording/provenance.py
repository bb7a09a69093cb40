"""With what a flight is flown: versions, machine, the aircraft's own files."""

import hashlib
import os
import platform
from importlib.metadata import PackageNotFoundError, version
from pathlib import Path
from typing import NamedTuple

import ftc_jsb
from ftc_jsb.resources import PAPER_AIRCRAFT, aircraft_folder
from ftc_jsb.scenario.schema import Scenario

PACKAGES = ("numpy", "scipy", "numba", "jsbsim")  # whose versions may change a flight


class Provenance(NamedTuple):
    """With what and where a flight was flown."""

    versions: dict[str, str]  # by package
    machine: str
    aircraft_digest: str = ""  # as the function of that name; "" where it was not recorded


def aircraft_digest(scenario: Scenario) -> str:
    """SHA-256 of the aircraft's own files: the same scenario with another fit is another flight."""
    name = PAPER_AIRCRAFT if scenario.model == "paper" else scenario.aircraft.name
    folder = aircraft_folder(name)
    digest = hashlib.sha256()
    for file in ("aircraft.toml", "inner_loop.xml", "point_mass.toml"):
        if (folder / file).is_file():
            digest.update((folder / file).read_bytes())
    return digest.hexdigest()


def versions() -> dict[str, str]:
    """Versions of this program, Python and the packages that take part in a flight."""
    found = {"ftc-jsb": ftc_jsb.__version__, "python": platform.python_version()}
    for package in PACKAGES:
        try:
            found[package] = version(package)
        except PackageNotFoundError:
            continue
    return found


def machine() -> str:
    """Kind of machine, its processor as far as it says, and its cores."""
    name = platform.processor() or platform.machine()
    info = Path("/proc/cpuinfo")  # where Linux tells what `platform` does not
    if info.is_file():
        lines = info.read_text(encoding="utf-8", errors="replace").splitlines()
        models = [line.partition(":")[2].strip() for line in lines if line.startswith("model name")]
        name = models[0] if models else name
    return f"{platform.system()} {platform.machine()}, {name}, {os.cpu_count()} cores"
