"""What the loop refuses to fly, whatever the references ask for: into the ground, too fast, too slow.

Not in the paper. Each protection is a least rate of the path or a bound on the acceleration that comes into
force smoothly as its bound comes near, and leaves the wanted rates alone elsewhere.
"""

import math

from ftc_jsb.compiled import compiled
from ftc_jsb.control.energy import Budget, payable_climb
from ftc_jsb.control.law import Rates
from ftc_jsb.control.limits import Limits, PathState
from ftc_jsb.point_mass.model import Condition
from ftc_jsb.vocabulary.kernel_types import LoopSettings, LoopState, ModelRecord

CLEARANCE = 150.0  # [m] above sea level, in which a dive has to be over
REACTION = 1.5  # [s] from the command to pull to the pull: path at bank, roll to level included
PULL = 0.5  # of the load factor that is there beyond 1: what the recovery is planned with
STEEPEST_RETURN = math.radians(5.0)  # [rad]: climb back to the clearance
CLIMB_TIME = 10.0  # [s] in which the clearance is regained
PATH_GAIN = 1.5  # [1/s], towards the least path angle
SPEED_GAIN = 0.5  # [1/s], towards the bounds of airspeed
STALL_MARGIN = 1.2  # load factor that must be left at the least airspeed
MACH_MARGIN = 0.02  # inside the range of the fit


@compiled
def keep_inside_envelope(
    s: LoopSettings,
    m: ModelRecord,
    x: LoopState,
    at: Condition,
    state: PathState,
    effectiveness: float,
    limits: Limits,
    wanted: Rates,
) -> Rates:
    """Wanted rates, changed where they lead out of the envelope; untouched where the settings say so.

    Args:
        s, m, x: settings, model and state of the loop.
        at: the model at this flight condition.
        state: airspeed and path angle.
        effectiveness: of thrust.
        limits: load factors at this condition.
        wanted: by references, errors and priority.
    """
    if s.upright == 0:
        return wanted
    airspeed, path = state.airspeed, state.flight_path_angle
    slowest = airspeed * math.sqrt(STALL_MARGIN / max(limits.lift_factor, 1e-3))
    acceleration = max(wanted.airspeed, SPEED_GAIN * (slowest - airspeed))
    path_rate = max(wanted.flight_path_angle, _rate_above_ground(x, at, state, limits))
    if m.valid_mach[1] > 0.0:
        fastest = (m.valid_mach[1] - MACH_MARGIN) * at.sound_speed
        braking = SPEED_GAIN * (fastest - airspeed)
        acceleration = min(acceleration, braking)
        idle = Budget(effectiveness * at.thrust_idle, 0.0)
        steepest = math.asin(payable_climb(at, idle, airspeed, math.cos(path), braking))
        path_rate = max(path_rate, PATH_GAIN * (steepest - path))
    return Rates(acceleration, path_rate, wanted.heading)


@compiled
def _rate_above_ground(x: LoopState, at: Condition, state: PathState, limits: Limits) -> float:
    """Least rate of the path [rad/s] from which the aircraft still levels out above the clearance.

    Levelling out from a path angle at a rate g (n - 1) / V takes R (1 - cos(path)) of height, with
    R = V^2 / (g (n - 1)). Below the clearance the path goes up to regain it.
    """
    airspeed, path = state.airspeed, state.flight_path_angle
    pull = max(PULL * (limits.load_factor_max - 1.0), 0.05)
    radius = airspeed * airspeed / (at.gravity * pull)
    sinking = max(-math.sin(path), 0.0) * airspeed
    height = x.known.altitude - CLEARANCE - REACTION * sinking
    if height <= 0.0:
        least = min(-height / (airspeed * CLIMB_TIME), STEEPEST_RETURN)
        return float(PATH_GAIN * (least - path))
    least = -math.acos(max(1.0 - height / radius, -1.0))
    turning = airspeed / radius if path < 0.0 else 0.0
    return float(PATH_GAIN * (least - path) + turning)
