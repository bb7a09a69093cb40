"""Whether a flight that failed could have been flown: k T_max against the thrust that its references need.

What the references need is measured on the healthy twin, the same case without its fault, which stays on
them: its drag, and the force that accelerates and lifts the aircraft along the references.
"""

from typing import NamedTuple

import numpy as np
import numpy.typing as npt
from scipy.interpolate import RegularGridInterpolator

from ftc_jsb.aircraft.point_mass_file import load_point_mass
from ftc_jsb.analysis.default_limits import flight_limits
from ftc_jsb.recording.flight import Flight
from ftc_jsb.resources import aircraft_folder
from ftc_jsb.units import STANDARD_GRAVITY

Array = npt.NDArray[np.float64]
SMOOTHED = 1.0  # [s]: drag in turbulence and with noisy commands is a mean over it
NOTICED = 1.0  # [s] for which thrust must be short


class ThrustNeed(NamedTuple):
    """Along the references of a flight, up to where it failed."""

    short_s: float  # time for which k T_max is less than what the references need
    worst: float  # least k T_max - need, over the weight
    speed_lost: float  # [m/s] if the path is given up as far as its limit allows, and then airspeed
    speed_allowed: float  # [m/s], the limit of the airspeed error

    @property
    def cause(self) -> str:
        """`no loop` where everything that limits allow to be given up is not enough, `short`, or `enough`."""
        if self.speed_lost > self.speed_allowed:
            return "no loop"
        return "short" if self.short_s >= NOTICED else "enough"


def thrust_need(flown: Flight, twin: Flight, until: float) -> ThrustNeed:
    """Judge a flight by its healthy twin.

    Args:
        flown: with the fault.
        twin: without.
        until: [s], when `flown` broke its first limit.
    """
    rows = min(flown.record.size, twin.record.size, round(until / flown.row_period) + 1)
    row, dt = twin.record[:rows], twin.row_period
    weight = row["mass"] * STANDARD_GRAVITY
    climb = np.sin(row["flight_path_angle_ref"]) * weight
    faster = np.gradient(row["airspeed_ref"], dt) * row["mass"]
    need = (_smooth(row["drag"], round(SMOOTHED / dt)) + climb + faster) / np.cos(row["alpha"])
    aircraft = twin.scenario.aircraft
    deck = load_point_mass(aircraft_folder(aircraft.name)).thrust
    knots = np.array(deck.mach), np.array(deck.altitude)
    inside = [
        np.clip(row[n], k[0], k[-1]) for n, k in zip(("mach", "altitude"), knots, strict=True)
    ]
    most = RegularGridInterpolator(knots, np.array(deck.maximum))(np.stack(inside, axis=-1))
    left = flown.record["effectiveness_thrust"][:rows] * most - need
    limits = flight_limits(flown.scenario)
    assert limits.error_flight_path_deg is not None  # default limits have both
    assert limits.error_airspeed is not None
    given_up = np.sin(np.radians(-limits.error_flight_path_deg[0])) * weight
    return ThrustNeed(
        short_s=float(np.sum(left < 0.0) * dt),
        worst=float(np.min(left / weight)),
        speed_lost=float(np.sum(np.maximum(-left - given_up, 0.0) / row["mass"]) * dt),
        speed_allowed=-limits.error_airspeed[0],
    )


def _smooth(values: Array, rows: int) -> Array:
    """Centred mean over `rows`, of what there is of them at the ends."""
    window = np.ones(min(max(rows, 1), values.size))
    total = np.convolve(values, window, "same")
    return np.asarray(total / np.convolve(np.ones_like(values), window, "same"))
