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
        licences(new, model)
        (new / "README.txt").write_text(_readme(aircraft, initial), encoding="utf-8")
        written = [path.relative_to(new) for path in new.rglob("*") if path.is_file()]
    return sorted(folder / name for name in written)


def _copy(root: Path, folder: Path, model: str) -> None:
    """The woven aircraft, and of JSBSim's shared systems those that it asks for."""
    for part in ("aircraft", "engine"):
        shutil.copytree(root / part, folder / part)
    (folder / "systems").mkdir()
    for path in shared_systems(root, model):
        shutil.copy(path, folder / "systems")


def shared_systems(root: Path, model: str) -> list[Path]:
    """Systems of a woven aircraft's root that its files ask for, and that are not its own."""
    asking = list((root / "aircraft" / model).rglob("*.xml"))
    found: dict[str, Path] = {}
    while asking:
        for name in re.findall(r'file="([^"]+)"', asking.pop().read_text(errors="replace")):
            source = root / "systems" / f"{name.removesuffix('.xml')}.xml"
            own = root / "aircraft" / model / "Systems" / source.name
            if source.is_file() and not own.is_file() and source.name not in found:
                found[source.name] = source
                asking.append(source)
    return list(found.values())


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


def licences(folder: Path, model: str) -> None:
    """Write NOTICE and JSBSim's licence to a folder of files that derive from JSBSim's.

    Args:
        folder: whose XML files are looked through, those of ftc-jsb's own apart.
        model: of JSBSim.
    """
    import jsbsim

    shutil.copy(Path(jsbsim.__file__).parent / "LICENSE.txt", folder / "JSBSIM-LICENSE.txt")
    changed: list[tuple[str, Path]] = []
    copied: list[tuple[str, Path]] = []
    for path in sorted(folder.rglob("*.xml")):
        source = _source(model, path)
        if path.name.startswith(OWN) or source is None:
            continue
        same = source.read_bytes() == path.read_bytes()
        (copied if same else changed).append((str(path.relative_to(folder)), source))
    versions = f"ftc-jsb {ftc_jsb.__version__} with jsbsim {jsbsim.__version__}"
    text = notice(changed, copied, versions, str(datetime.datetime.now(datetime.UTC).date()))
    (folder / "NOTICE").write_text(text, encoding="utf-8")


def _source(model: str, path: Path) -> Path | None:
    """The installed file that a file of an export derives from; None if there is none."""
    import jsbsim

    installed = Path(jsbsim.get_default_root_dir())
    own = installed / "aircraft" / model
    kind, name = path.parent.name.lower().rstrip("s"), path.name
    places = {
        "engine": (own / "Engines", own / "engines", own, installed / "engine"),
        "system": (own / "Systems", installed / "systems"),
    }.get(kind, (own,))
    for place in places:
        if (place / name).is_file():
            return place / name
    return own / f"{model}.xml" if path.stem in (model, f"{model}-ftc") else None


def _readme(aircraft: Aircraft, initial: Initial) -> str:
    return README.format(
        title=aircraft.title,
        model=aircraft.jsbsim_model,
        airspeed=initial.airspeed,
        altitude=initial.altitude,
    )
