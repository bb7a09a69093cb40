"""Whether a point mass is that of the JSBSim aircraft that is flown."""

from typing import Any, NamedTuple

from ftc_jsb.aircraft.description import Aircraft
from ftc_jsb.aircraft.point_mass_file import PointMass
from ftc_jsb.errors import AircraftError
from ftc_jsb.six_dof.engines import engine_count
from ftc_jsb.six_dof.fuel_tanks import contents_property
from ftc_jsb.units import FOOT, POUND_MASS

TOLERANCE = 0.02  # of mass and area


class _Airframe(NamedTuple):
    mass: float  # [kg], without internal fuel
    area: float  # [m^2]
    engines: int

    def __str__(self) -> str:
        plural = "s" if self.engines > 1 else ""
        return f"{self.mass:.0f} kg empty, {self.area:.2f} m2, {self.engines} engine{plural}"


def check_point_mass(fdm: Any, aircraft: Aircraft, point_mass: PointMass) -> None:
    """See that mass, area and engines agree to 2 %.

    Args:
        fdm: the woven aircraft, loaded and set up.
        aircraft: as loaded.
        point_mass: of its folder.

    Raises:
        AircraftError: they do not; names both.
    """
    fuel = sum(fdm[contents_property(tank)] for tank in aircraft.fuel_tanks)
    flown = _Airframe(
        (fdm["inertia/weight-lbs"] - fuel) * POUND_MASS,
        fdm["metrics/Sw-sqft"] * FOOT**2,
        engine_count(fdm),
    )
    counted = _Airframe(
        point_mass.mass.empty, point_mass.aerodynamics.area, point_mass.thrust.engines
    )
    apart = max(abs(counted.mass / flown.mass - 1.0), abs(counted.area / flown.area - 1.0))
    if apart > TOLERANCE or counted.engines != flown.engines:
        path = aircraft.folder / "point_mass.toml"
        raise AircraftError(
            f"{path}: the point mass of another aircraft: {point_mass.title!r} has {counted}; JSBSim's "
            f"{aircraft.jsbsim_model!r} has {flown}; make its own by `ftc-jsb identify`"
        )
