"""The check cases that need no aircraft but a sphere or a brick, as NASA/TM-2015-218675 defines them."""

from typing import NamedTuple

from ftc_jsb.scenario.wind import Wind
from ftc_jsb.units import FOOT

HIGH = 30_000.0  # [ft], from where things are dropped
EARTH_RATE = 0.004178073  # [deg/s], as the memorandum rounds it
FAST = 1000.0  # [ft/s], up and along, of the ballistic ones


class Body(NamedTuple):
    """A rigid body. US units, as the memorandum has them."""

    mass: float  # [slug]
    inertia: tuple[float, float, float]  # about x, y, z [slug ft^2]
    area: float  # [ft^2]
    span: float = 1.0  # [ft]
    chord: float = 1.0  # [ft]
    drag: float = 0.0  # C_D
    damping: float = 0.0  # C_lp, C_mq, C_nr [1/rad]


SPHERE = Body(1.0, (3.6, 3.6, 3.6), 0.1963495, drag=0.1)
DRAGLESS_SPHERE = SPHERE._replace(drag=0.0)
BRICK = Body(0.155404754, (0.001894220, 0.006211019, 0.007194665), 0.22222, 1 / 3, 2 / 3)
DAMPED_BRICK = BRICK._replace(damping=-1.0)


class Planet(NamedTuple):
    """A round Earth in place of WGS-84. US units."""

    radius: float = 20_902_255.199  # [ft]: 6371007.1809 m, of a sphere with the surface of WGS-84
    rotation: float = 7.292115e-5  # [rad/s]


class Case(NamedTuple):
    """One check case: at latitude and longitude 0, for 30 s."""

    number: int
    title: str
    body: Body
    altitude: float = HIGH  # [ft]
    velocity: tuple[float, float, float] = (
        0.0,
        0.0,
        0.0,
    )  # north, east, down, of the ground [ft/s]
    heading: float = 0.0  # [deg]
    rates: tuple[float, float, float] = (-EARTH_RATE, 0.0, 0.0)  # body's, of the ground [deg/s]
    wind: Wind = Wind()
    planet: Planet | None = None  # None: WGS-84


TUMBLE = (10.0 - EARTH_RATE, 20.0, 30.0)  # 10, 20, 30 deg/s of inertial space
AT_REST = (0.0, 0.0, 0.0)
SHEAR = 90.0 / HIGH  # [1/s]: -20 ft/s at the ground, 70 ft/s at 30,000 ft

CASES = (
    Case(1, "dropped sphere without drag", DRAGLESS_SPHERE),
    Case(2, "tumbling brick without damping", BRICK, rates=TUMBLE),
    Case(3, "tumbling brick with damping", DAMPED_BRICK, rates=TUMBLE),
    Case(
        4, "dropped sphere, round Earth at rest", SPHERE, rates=AT_REST, planet=Planet(rotation=0.0)
    ),
    Case(5, "dropped sphere, round Earth that turns", SPHERE, planet=Planet()),
    Case(6, "dropped sphere, WGS-84", SPHERE),
    Case(7, "sphere in steady wind", SPHERE, wind=Wind(speed=20.0 * FOOT)),
    Case(8, "sphere in sheared wind", SPHERE, wind=Wind(speed=70.0 * FOOT, shear=SHEAR)),
    Case(
        9, "sphere shot to the east", SPHERE, 0.0, (0.0, FAST, -FAST), heading=90.0, rates=AT_REST
    ),
    Case(10, "sphere shot to the north", SPHERE, 0.0, (FAST, 0.0, -FAST), rates=AT_REST),
)
