"""Moving air around a JSBSim aircraft: its own turbulence, and a flight that starts in wind."""

import math
from typing import Any

import numpy.typing as npt

from ftc_jsb.disturbance.weather import SEVERITY
from ftc_jsb.scenario.wind import Wind
from ftc_jsb.six_dof.properties import node, write_checked
from ftc_jsb.units import FOOT

MILSPEC = 3  # JSBSim's number of the MIL-F-8785C model
# MIL-F-8785C, 3.7.3: 15, 30, 45 knots near the ground [ft/s]; turbulence below 2000 ft goes by it
WIND_AT_20_FT = {"light": 25.3, "moderate": 50.6, "severe": 75.9}
# JSBSim's generator is a linear congruence: neighbouring seeds give like numbers, 0 those of 1
SPREAD, MODULUS = 2654435761, 2**31 - 2


def set_turbulence(fdm: Any, wind: Wind, seed: int) -> None:
    """Switch JSBSim's turbulence on, seeded.

    Raises:
        AircraftError: this JSBSim has no such property.
    """
    if wind.turbulence == "none":
        return
    write_checked(fdm, "atmosphere/randomseed", float(1 + seed * SPREAD % MODULUS))
    write_checked(fdm, "atmosphere/turb-type", float(MILSPEC))
    name = "atmosphere/turbulence/milspec"
    write_checked(fdm, f"{name}/windspeed_at_20ft_AGL-fps", WIND_AT_20_FT[wind.turbulence])
    write_checked(fdm, f"{name}/severity", float(SEVERITY[wind.turbulence]))


def start_in_wind(fdm: Any, wind: npt.NDArray[Any]) -> None:
    """Let a trimmed aircraft start in steady wind: the same flight through the air, carried along.

    JSBSim trims in still air only; a crosswind breaks its trim. The initial velocity is that of the
    trim plus the wind, at the trim's attitude, with surfaces and engines as they are.

    Args:
        fdm: trimmed, at time zero.
        wind: (3,) north, east, up [m/s].
    """
    velocity = [fdm[f"velocities/v-{axis}-fps"] for axis in ("north", "east", "down")]
    down = (wind[0] / FOOT, wind[1] / FOOT, -wind[2] / FOOT)
    attitude = {
        "ic/theta-rad": fdm["attitude/theta-rad"],
        "ic/phi-rad": fdm["attitude/phi-rad"],
        "ic/psi-true-rad": math.remainder(fdm["attitude/psi-rad"], 2.0 * math.pi),
    }
    for name, value in attitude.items():
        node(fdm, name)
        fdm[name] = value
    for axis, was, wind_speed in zip("ned", velocity, down, strict=True):
        fdm[f"ic/v{axis}-fps"] = was + wind_speed
    fdm.run_ic()
    for axis, wind_speed in zip(("north", "east", "down"), down, strict=True):
        write_checked(fdm, f"atmosphere/wind-{axis}-fps", float(wind_speed))
    fdm.suspend_integration()  # let the air-relative quantities see the wind
    fdm.run()
    fdm.resume_integration()
