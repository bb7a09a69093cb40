"""`ftc-jsb export`: the woven aircraft as a folder that plain JSBSim loads and flies from a script."""

import datetime
import re
import shutil
import xml.etree.ElementTree as ET
from pathlib import Path
from typing import Any

import ftc_jsb
from ftc_jsb.aircraft.description import Aircraft
from ftc_jsb.aircraft.level_flight import level_flight
from ftc_jsb.atomic_file import atomic_contents
from ftc_jsb.export.notice import notice
from ftc_jsb.export.script import INITIAL, RATE, initial_condition, runscript, steps
from ftc_jsb.scenario.schema import AircraftChoice, Initial
from ftc_jsb.six_dof.engines import delivered_thrust, engine_count
from ftc_jsb.six_dof.fuel_tanks import contents_property
from ftc_jsb.six_dof.trim import trimmed
from ftc_jsb.six_dof.weaving.woven_aircraft import woven_aircraft
from ftc_jsb.units import POUND_FORCE

OWN = "ftc_"  # names of files that are not JSBSim's begin so

README = """\
{title}, with the inner loop of ftc-jsb, for plain JSBSim. Read NOTICE before you pass it on.

    jsbsim --root=. --script=scripts/{model}.xml --simulation-rate=200

in this folder trims at {airspeed:g} m/s and {altitude:g} m, engages the inner loop, steps load factor, bank
and thrust, and writes {model}.csv here. From Python:

    fdm = jsbsim.FGFDMExec(".")
    fdm.load_script("scripts/{model}.xml")
    fdm.run_ic()
    while fdm.run():
        pass

Commands: ftc/command/thrust-n [N, of a healthy engine], ftc/command/load-factor, ftc/command/bank-rad
[rad, about the velocity]; ftc/engaged 0 leaves the trimmed controls alone. Faults:
ftc/effectiveness/engine[i], 1 = healthy. The inner loop needs at least 80 Hz. Without
--simulation-rate the `jsbsim` command flies at 120 Hz, whatever the script says.
"""


def export(aircraft: Aircraft, corrected: bool, folder: Path) -> list[Path]:
    """Write `aircraft/`, `engine/`, `systems/`, `scripts/`, README and NOTICE to a folder.

    The aircraft is trimmed first, at the condition that the script flies.

    Args:
        aircraft: as loaded.
        corrected: with the corrections of `aircraft.toml`.
        folder: exists; files of the same names are replaced.

    Returns:
        The files that were written.

    Raises:
        AircraftError, TrimError: it cannot be woven, loaded or trimmed.
        WriteError: the folder cannot be written.
    """
    import jsbsim

    initial = level_flight(aircraft)
    fuel = AircraftChoice().fuel_fraction
    root = woven_aircraft(aircraft, corrected)
    fdm = trimmed(aircraft, root, 1.0 / RATE, initial, fuel)
    model = aircraft.jsbsim_model
    with atomic_contents(folder) as new:
        _copy(root, new, model)
        place = new / "aircraft" / model / f"{INITIAL}.xml"
        _write(initial_condition(initial), place)
        (new / "scripts").mkdir()
        _write(_script(aircraft, fdm), new / "scripts" / f"{model}.xml")
        installed = Path(jsbsim.get_default_root_dir())
        shutil.copy(Path(jsbsim.__file__).parent / "LICENSE.txt", new / "JSBSIM-LICENSE.txt")
        (new / "NOTICE").write_text(_notice(new, model, installed), encoding="utf-8")
        (new / "README.txt").write_text(_readme(aircraft, initial), encoding="utf-8")
        written = [path.relative_to(new) for path in new.rglob("*") if path.is_file()]
    return sorted(folder / name for name in written)


def _copy(root: Path, folder: Path, model: str) -> None:
    """The woven aircraft, and of JSBSim's shared systems those that it asks for."""
    for part in ("aircraft", "engine"):
        shutil.copytree(root / part, folder / part)
    (folder / "systems").mkdir()
    asking = list((root / "aircraft" / model).rglob("*.xml"))
    copied: set[str] = set()
    while asking:
        for name in re.findall(r'file="([^"]+)"', asking.pop().read_text(errors="replace")):
            source = root / "systems" / f"{name.removesuffix('.xml')}.xml"
            own = folder / "aircraft" / model / "Systems" / source.name
            if source.is_file() and not own.is_file() and source.name not in copied:
                shutil.copy(source, folder / "systems")
                copied.add(source.name)
                asking.append(source)


def _script(aircraft: Aircraft, fdm: Any) -> ET.Element:
    engines = engine_count(fdm)
    thrust = delivered_thrust(fdm, engines)
    before = dict(aircraft.setup)
    for tank in aircraft.fuel_tanks:
        name = contents_property(tank)
        before[name] = fdm[name]
    fdm.run()  # publishes the deck
    commands = steps(thrust, fdm["ftc/deck/military-lbs"] * POUND_FORCE)
    return runscript(aircraft.jsbsim_model, aircraft.title, before, commands, engines)


def _write(element: ET.Element, path: Path) -> None:
    ET.indent(element)
    ET.ElementTree(element).write(path, encoding="utf-8", xml_declaration=True)


def _notice(folder: Path, model: str, installed: Path) -> str:
    changed: list[tuple[str, Path]] = []
    copied: list[tuple[str, Path]] = []
    for part in ("aircraft", "engine", "systems"):
        for path in sorted((folder / part).rglob("*.xml")):
            if path.name.startswith(OWN):
                continue
            name = path.relative_to(folder)
            source = _source(installed, model, name)
            same = source.read_bytes() == path.read_bytes()
            (copied if same else changed).append((str(name), source))
    import jsbsim

    versions = f"ftc-jsb {ftc_jsb.__version__} with jsbsim {jsbsim.__version__}"
    return notice(changed, copied, versions, str(datetime.datetime.now(datetime.UTC).date()))


def _source(installed: Path, model: str, name: Path) -> Path:
    """The installed file that a file of the export derives from."""
    if name.parts[0] == "engine":
        for place in ("Engines", "engines"):
            own = installed / "aircraft" / model / place / name.name
            if own.is_file():
                return own
    return installed / name


def _readme(aircraft: Aircraft, initial: Initial) -> str:
    return README.format(
        title=aircraft.title,
        model=aircraft.jsbsim_model,
        airspeed=initial.airspeed,
        altitude=initial.altitude,
    )
