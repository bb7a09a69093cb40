"""A check case flown by JSBSim with the time steps, the wind and the recording of every flight here."""

import tempfile
from pathlib import Path
from typing import Any

import numpy as np
import numpy.typing as npt

from ftc_jsb.disturbance.weather import wind_record
from ftc_jsb.disturbance.wind import wind_step
from ftc_jsb.recording.columns import ROW
from ftc_jsb.scenario.schema import Initial
from ftc_jsb.six_dof.commanded_flight import DT, STEPS
from ftc_jsb.six_dof.loading import initialise, load_from
from ftc_jsb.six_dof.observation import (
    JSBSIM_STATE,
    POSITION_NAMES,
    PROPERTIES,
    observe,
    place_origin,
)
from ftc_jsb.six_dof.plant import WIND_AXES
from ftc_jsb.six_dof.properties import readers, writer
from ftc_jsb.units import FOOT
from validation.check_cases.cases import Body, Case, Planet

DURATION = 30.0  # [s]

MODEL = """<?xml version="1.0"?>
<fdm_config name="check-case" version="2.0" release="BETA">
  <fileheader/>
  {planet}
  <metrics>
    <wingarea unit="FT2">{body.area!r}</wingarea>
    <wingspan unit="FT">{body.span!r}</wingspan>
    <chord unit="FT">{body.chord!r}</chord>
    <location name="AERORP" unit="IN"><x>0</x><y>0</y><z>0</z></location>
  </metrics>
  <mass_balance>
    <ixx unit="SLUG*FT2">{body.inertia[0]!r}</ixx>
    <iyy unit="SLUG*FT2">{body.inertia[1]!r}</iyy>
    <izz unit="SLUG*FT2">{body.inertia[2]!r}</izz>
    <emptywt unit="SLUG">{body.mass!r}</emptywt>
    <location name="CG" unit="IN"><x>0</x><y>0</y><z>0</z></location>
  </mass_balance>
  <ground_reactions/>
  <aerodynamics>{axes}</aerodynamics>
</fdm_config>
"""
AXIS = """<axis name="{name}"><function name="aero/{name}"><product>
<property>aero/qbar-psf</property><property>metrics/Sw-sqft</property>{factors}
<value>{coefficient!r}</value></product></function></axis>"""
DAMPING = {  # axis: reference length, its half over airspeed, rate
    "ROLL": ("metrics/bw-ft", "aero/bi2vel", "velocities/p-aero-rad_sec"),
    "PITCH": ("metrics/cbarw-ft", "aero/ci2vel", "velocities/q-aero-rad_sec"),
    "YAW": ("metrics/bw-ft", "aero/bi2vel", "velocities/r-aero-rad_sec"),
}
ROUND = """<planet name="round">
    <equatorial_radius unit="FT">{0.radius!r}</equatorial_radius>
    <semiminor_axis unit="FT">{0.radius!r}</semiminor_axis>
    <rotation_rate unit="RAD/SEC">{0.rotation!r}</rotation_rate><J2>0</J2>
  </planet>"""


def fly_case(case: Case, frames: int = STEPS) -> npt.NDArray[Any]:
    """(rows,) of `columns.ROW`, a row each hundredth of a second.

    Args:
        case: to be flown.
        frames: of JSBSim in a row; the flights of this program have two.

    Raises:
        AircraftError: JSBSim refuses the body.
    """
    with tempfile.TemporaryDirectory() as folder:
        fdm = _loaded(case, Path(folder), DT / frames)
    record = np.zeros(round(DURATION / DT) + 1, ROW)
    record["time"] = np.arange(record.size) * DT
    names = list(PROPERTIES[:-1])  # a stone has no fuel
    read = readers(fdm, names)
    raw = np.zeros(len(PROPERTIES) + len(POSITION_NAMES))
    state = np.zeros(1, JSBSIM_STATE)
    where = Initial(latitude_deg=0.0, longitude_deg=0.0, heading_deg=case.heading)
    place_origin(state[0], where, [fdm[f"position/ecef-{axis}-ft"] * FOOT for axis in "xyz"])
    wind = wind_record(case.wind, case.altitude * FOOT, seed=0, dryden=False)
    writers = [writer(fdm, f"atmosphere/wind-{axis}-fps") for axis in WIND_AXES]
    for i in range(record.size):
        raw[: len(names)] = [value() for value in read]
        observe(raw, state, record, i)
        wind_step(wind, record, i, DT)
        north, east, up = wind[0]["now"].tolist()
        for write, speed in zip(writers, (north, east, -up), strict=True):
            write(speed / FOOT)
        for _ in range(frames):
            fdm.run()
    return record


def _loaded(case: Case, root: Path, dt: float) -> Any:
    """JSBSim with the body, at its initial condition."""
    model = root / "aircraft" / "check-case" / "check-case.xml"
    model.parent.mkdir(parents=True)
    planet = "" if case.planet is None else ROUND.format(case.planet)
    model.write_text(MODEL.format(planet=planet, body=case.body, axes=_axes(case.body)))
    fdm = load_from(f"check case {case.number}", "check-case", root, dt)
    start = {"ic/lat-geod-deg": 0.0, "ic/long-gc-deg": 0.0, "ic/h-sl-ft": case.altitude}
    start |= {"ic/psi-true-deg": case.heading, "ic/theta-deg": 0.0, "ic/phi-deg": 0.0}
    for axis, speed in zip(("north", "east", "down"), case.velocity, strict=True):
        start[f"ic/v{axis[0]}-fps"] = speed
    for axis, rate in zip("pqr", case.rates, strict=True):
        start[f"ic/{axis}-rad_sec"] = float(np.radians(rate))
    for name, value in start.items():
        fdm[name] = value
    initialise(fdm, f"check case {case.number}")
    return fdm


def _axes(body: Body) -> str:
    axes = ""
    if body.drag != 0.0:
        axes += AXIS.format(name="DRAG", factors="", coefficient=body.drag)
    if body.damping != 0.0:
        for name, properties in DAMPING.items():
            factors = "".join(f"<property>{each}</property>" for each in properties)
            axes += AXIS.format(name=name, factors=factors, coefficient=body.damping)
    return axes


def inertial_rates(record: npt.NDArray[Any], planet: Planet | None) -> npt.NDArray[np.float64]:
    """(rows, 3): body rates of inertial space [rad/s]: recorded ones and the Earth's, at the equator."""
    rate = 7.292115e-5 if planet is None else planet.rotation  # [rad/s]
    north = rate * np.cos(record["north"] / 6.378e6)
    down = -rate * np.sin(record["north"] / 6.378e6)
    sf, cf = np.sin(record["roll"]), np.cos(record["roll"])
    st, ct = np.sin(record["pitch"]), np.cos(record["pitch"])
    sy, cy = np.sin(record["yaw"]), np.cos(record["yaw"])
    turning = np.stack([record[f"{axis}_rate"] for axis in ("roll", "pitch", "yaw")], axis=1)
    turning[:, 0] += north * ct * cy - down * st
    turning[:, 1] += north * (sf * st * cy - cf * sy) + down * sf * ct
    turning[:, 2] += north * (cf * st * cy + sf * sy) + down * cf * ct
    return np.asarray(turning)
