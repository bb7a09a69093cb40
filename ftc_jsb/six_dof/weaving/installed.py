"""An aircraft of the installed jsbsim package as it is read: its XML, its engines, its systems."""

import shutil
import xml.etree.ElementTree as ET
from pathlib import Path
from typing import NamedTuple

from ftc_jsb.confinement import OutsideError, confined
from ftc_jsb.errors import AircraftError
from ftc_jsb.six_dof.weaving.engine_deck import thrust_tables
from ftc_jsb.vocabulary.channels import ENGINES


class Installed(NamedTuple):
    """XML of an installed aircraft that can be woven."""

    package: Path  # root of the jsbsim package
    folder: Path  # of the aircraft there
    root: ET.Element  # of the aircraft, without its own logs and sockets
    engines: tuple[str, ...]  # file name of each engine; two may share one
    engine_roots: dict[str, ET.Element]  # by file name
    thrusters: tuple[Path, ...]

    def copy_to(self, root: Path) -> None:
        """Write the aircraft, its engines and all systems below `root`, for JSBSim to load."""
        model = self.folder.name
        shutil.copytree(self.folder, root / "aircraft" / model)
        for shared in ("engine", "systems"):
            shutil.copytree(self.package / shared, root / shared)
        ET.ElementTree(self.root).write(root / "aircraft" / model / f"{model}.xml")

    def with_systems(self) -> list[ET.Element]:
        """XML of the aircraft and of the systems, autopilots and channels in files of their own."""
        folders = (self.folder, self.folder / "Systems", self.package / "systems")
        found = [self.root]
        for element in self.root.iter():
            if element.tag in ("system", "autopilot", "flight_control") and element.get("file"):
                paths = [folder / f"{element.get('file')}.xml" for folder in folders]
                found += [_parsed(path) for path in paths if path.is_file()][:1]
        return found


def package_root() -> Path:
    """Root folder of the installed jsbsim package."""
    import jsbsim

    return Path(jsbsim.get_default_root_dir())


def model_file(model: str) -> Path:
    """Where the XML of an installed aircraft is; there may be none.

    Raises:
        AircraftError: the name leads out of the installed package.
    """
    try:
        folder = confined(package_root() / "aircraft", model)
        return confined(folder, f"{model}.xml")
    except OutsideError as error:
        raise AircraftError(f"jsbsim_model: {error}") from None


def installed_names() -> list[str]:
    """Names of the aircraft of the installed jsbsim package."""
    folders = sorted((package_root() / "aircraft").iterdir())
    return [folder.name for folder in folders if model_file(folder.name).is_file()]


def installed(model: str) -> Installed:
    """Read an installed aircraft, and see that it can be woven.

    Raises:
        AircraftError: it is not installed or cannot be read; or it has no aerodynamics, no engines,
            too many, or others than turbines with thrust tables.
    """
    path = model_file(model)
    if not path.is_file():
        raise AircraftError(f"aircraft {model!r}: {path} not found")
    root = _parsed(path)
    for element in [*root.findall("output"), *root.findall("input")]:
        root.remove(element)  # logs into whatever folder one works in, and sockets
    if root.find("aerodynamics") is None:
        raise AircraftError(f"aircraft {model!r}: {path.name} has no aerodynamics")
    engines = tuple(engine.get("file", "") for engine in root.findall("propulsion/engine"))
    if not 1 <= len(engines) <= ENGINES:
        raise AircraftError(
            f"aircraft {model!r}: {len(engines) or 'no'} engine{'s' if engines else ''} in "
            f"{path.name}; expected 1 to {ENGINES} turbine engines"
        )
    roots = {}
    for name in engines:
        roots[name] = _parsed(_engine_file(path.parent, name))
        thrust_tables(roots[name], f"aircraft {model!r}: {name}")
    thrusters = [t.get("file", "") for t in root.findall("propulsion/engine/thruster")]
    return Installed(
        package_root(),
        path.parent,
        root,
        engines,
        roots,
        tuple(_engine_file(path.parent, name) for name in thrusters),
    )


def _parsed(path: Path) -> ET.Element:
    try:
        return ET.parse(path).getroot()
    except (OSError, ET.ParseError) as error:
        raise AircraftError(f"{path}: cannot be read: {error}") from None


def _engine_file(folder: Path, name: str) -> Path:
    shared = package_root() / "engine"
    for place in (folder / "Engines", folder / "engines", folder, shared):
        if (place / f"{name}.xml").is_file():
            return place / f"{name}.xml"
    raise AircraftError(f"engine file {name}.xml not found in {folder} or {shared}")
