"""The JSBSim aircraft as a plant: commands into the woven inner loop, state and measurements out."""

import math
from collections.abc import Callable
from typing import Any

import numpy as np
import numpy.typing as npt

from ftc_jsb.compiled import compiled, direct
from ftc_jsb.errors import AircraftError
from ftc_jsb.scenario.schema import AircraftChoice, Initial
from ftc_jsb.six_dof.aircraft import load_aircraft
from ftc_jsb.six_dof.properties import engine_count, readers, writer
from ftc_jsb.six_dof.trim import trimmed
from ftc_jsb.six_dof.weaving import EFFECTIVENESS, woven_aircraft
from ftc_jsb.units import FOOT, POUND_FORCE, POUND_MASS

# The properties read at every sample, in the order of the kernel below; then control positions and
# one thrust for each engine.
PROPERTIES = (
    "velocities/vt-fps",
    "velocities/mach",
    "aero/alpha-rad",
    "aero/beta-rad",
    "attitude/phi-rad",
    "attitude/theta-rad",
    "attitude/psi-rad",
    "velocities/p-rad_sec",
    "velocities/q-rad_sec",
    "velocities/r-rad_sec",
    "accelerations/Nx",
    "accelerations/Nz",
    "position/h-sl-ft",
    "position/ecef-x-ft",
    "position/ecef-y-ft",
    "position/ecef-z-ft",
    "inertia/weight-lbs",
    "forces/fwx-aero-lbs",
)
_THRUST = len(PROPERTIES) + 5

JSBSIM_STATE = np.dtype(
    [
        ("origin", float, (3,)),  # ECEF [m]
        ("north", float, (3,)),  # unit vectors of the tangent plane in ECEF
        ("east", float, (3,)),
        ("heading", float),  # [rad], continuous
        ("yaw", float),
        ("bank", float),
    ]
)


@compiled
def _continuous(angle: float, previous: float) -> float:
    """`angle` plus the whole turns that bring it nearest to `previous` [rad]."""
    return angle + 2.0 * math.pi * round((previous - angle) / (2.0 * math.pi))


@compiled
def observe(raw: Any, state: Any, record: Any, i: int) -> None:
    """JSBSim's properties as SI truth and measurements in row `i`.

    Flight path, heading and bank are those of the air-relative velocity, from attitude, alpha and
    beta: the wind axes in the local level frame. Steady wind leaves them untouched.

    Args:
        raw: values of PROPERTIES, control positions (throttle, elevator, aileron, rudder, flap)
            and engine thrusts.
        state: (1,) JSBSIM_STATE.
        record: (rows,) of the recording.
        i: row.
    """
    s, row = state[0], record[i]
    alpha, beta, phi, theta, psi = raw[2], raw[3], raw[4], raw[5], raw[6]
    sa, ca, sb, cb = math.sin(alpha), math.cos(alpha), math.sin(beta), math.cos(beta)
    sp, cp, st, ct = math.sin(phi), math.cos(phi), math.sin(theta), math.cos(theta)
    # The velocity's direction in body axes is (ca cb, sb, sa cb); in the level frame, yaw removed:
    forward = ct * ca * cb + st * (sp * sb + cp * sa * cb)
    right = cp * sb - sp * sa * cb
    climb = st * ca * cb - ct * (sp * sb + cp * sa * cb)  # sin(gamma)
    sin_bank = ca * sb * st + cb * sp * ct - sa * sb * cp * ct  # times cos(gamma)
    cos_bank = sa * st + ca * cp * ct
    heading = psi + math.atan2(right, forward)
    s.heading = _continuous(heading, s.heading)
    s.yaw = _continuous(psi, s.yaw)
    row.airspeed = raw[0] * FOOT
    row.flight_path_angle = math.asin(min(max(climb, -1.0), 1.0))
    row.heading = s.heading
    row.mach = raw[1]
    row.alpha, row.sideslip = alpha, beta
    s.bank = _continuous(math.atan2(sin_bank, cos_bank), s.bank)
    row.bank_angle = s.bank
    row.roll, row.pitch, row.yaw = phi, theta, s.yaw
    row.roll_rate, row.pitch_rate, row.yaw_rate = raw[7], raw[8], raw[9]
    row.load_factor = raw[11] * ca + raw[10] * sa
    row.altitude = raw[12] * FOOT
    row.north, row.east = 0.0, 0.0
    for k in range(3):
        offset = raw[13 + k] * FOOT - s.origin[k]
        row.north += s.north[k] * offset
        row.east += s.east[k] * offset
    row.mass = raw[16] * POUND_MASS
    row.drag = raw[17] * POUND_FORCE  # positive against the velocity
    row.throttle, row.elevator, row.aileron = raw[18], raw[19], raw[20]
    row.rudder, row.flap = raw[21], raw[22]
    row.thrust = 0.0
    for k in range(_THRUST, raw.size):
        row.thrust += raw[k] * POUND_FORCE
    row.airspeed_meas = row.airspeed
    row.flight_path_angle_meas = row.flight_path_angle
    row.heading_meas = row.heading
    row.north_meas, row.east_meas, row.altitude_meas = row.north, row.east, row.altitude
    row.load_factor_meas = row.load_factor
    row.bank_angle_meas = row.bank_angle
    row.alpha_meas, row.sideslip_meas = alpha, beta
    row.pitch_rate_meas = row.pitch_rate
    row.elevator_meas, row.flap_meas = row.elevator, row.flap


class JsbsimPlant:
    """A `Plant` on a woven JSBSim aircraft, one fresh FGFDMExec a flight."""

    def __init__(self, choice: AircraftChoice, initial: Initial, dt: float, steps: int) -> None:
        """Args: the scenario's [aircraft] and [initial]; sample time [s]; JSBSim steps a sample."""
        self._choice = choice
        self._initial = initial
        self._steps = steps
        self._dt = dt / steps
        self._state = np.zeros(1, JSBSIM_STATE)

    def reset(self, record: npt.NDArray[Any]) -> None:
        """Weave, load, trim, check and engage; binds the recording to write to.

        Raises:
            AircraftError, TrimError: with the property or the residuals.
        """
        aircraft = load_aircraft(self._choice.name)
        root = woven_aircraft(aircraft, self._choice.flight_control == "corrected")
        fdm = trimmed(aircraft, root, self._dt, self._initial, self._choice.fuel_fraction)
        self.fdm = fdm
        positions = aircraft.positions
        names = list(PROPERTIES)
        names += [
            positions.throttle,
            positions.elevator,
            positions.aileron,
            positions.rudder,
            positions.flap,
        ]
        engines = engine_count(fdm)
        names += [f"propulsion/engine[{number}]/thrust-lbs" for number in range(engines)]
        self._readers = readers(fdm, names)
        self._raw = np.zeros(len(names))
        self._command_thrust = writer(fdm, "ftc/command/thrust-n")
        self._command_load_factor = writer(fdm, "ftc/command/load-factor")
        self._command_bank = writer(fdm, "ftc/command/bank-rad")
        self._effectiveness: list[Callable[[float], Any]] = [
            writer(fdm, f"{EFFECTIVENESS}[{number}]") for number in range(engines)
        ]
        self._record = record
        self._observe = direct(observe, self._raw, self._state, record, 0)
        self._place_origin(fdm)
        self._command_thrust(sum(fdm[name] for name in names[_THRUST:]) * POUND_FORCE)
        self._command_load_factor(math.cos(math.radians(self._initial.flight_path_deg)))
        self._command_bank(0.0)
        writer(fdm, "ftc/engaged")(1.0)

    def _place_origin(self, fdm: Any) -> None:
        state = self._state[0]
        state["origin"] = [fdm[f"position/ecef-{axis}-ft"] * FOOT for axis in "xyz"]
        latitude = math.radians(self._initial.latitude_deg)
        longitude = math.radians(self._initial.longitude_deg)
        state["north"] = (
            -math.sin(latitude) * math.cos(longitude),
            -math.sin(latitude) * math.sin(longitude),
            math.cos(latitude),
        )
        state["east"] = (-math.sin(longitude), math.cos(longitude), 0.0)
        state["heading"] = state["yaw"] = math.radians(self._initial.heading_deg)

    def truth(self, i: int) -> None:
        """Write state and measurements to row `i`."""
        self._raw[:] = [read() for read in self._readers]
        self._observe(self._raw, self._state, self._record, i)

    def step(self, i: int) -> None:
        """Fly the commands of row `i` for one sample.

        Raises:
            AircraftError: JSBSim raised, or says that it is over.
        """
        row = self._record[i]
        self._command_thrust(float(row["thrust_cmd"]))
        self._command_load_factor(float(row["load_factor_cmd"]))
        self._command_bank(float(row["bank_angle_cmd"]))
        effectiveness = float(row["effectiveness_thrust"])
        for engine in self._effectiveness:
            engine(effectiveness)
        run = self.fdm.run
        try:
            for _ in range(self._steps):
                if not run():
                    raise AircraftError("JSBSim ended the flight")
        except AircraftError:
            raise
        except Exception as error:  # JSBSim's own, of many kinds
            raise AircraftError(f"JSBSim: {' '.join(str(error).split())[:400]}") from None

    def close(self) -> None:
        """Let JSBSim's instance go."""
        del self.fdm
