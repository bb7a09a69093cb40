"""What the loop decides: rates that are wanted, what the law divides by, the demand within its limits."""

import math
from typing import NamedTuple

from ftc_jsb.compiled import compiled
from ftc_jsb.control.law import Inputs, Rates, control_law
from ftc_jsb.control.limits import Limits, PathState
from ftc_jsb.control.path import acceleration, rates_of
from ftc_jsb.control.records import ESTIMATED, NO_ESTIMATOR, TRUE
from ftc_jsb.control.upright import (
    FLOOR,
    GLIDE_FLOOR,
    load_factor_at_bank,
    thrust_for_acceleration,
    upright_bank,
    wanted_lift,
)
from ftc_jsb.estimation.process import OUTPUTS
from ftc_jsb.point_mass.dynamics import polar_drag, velocity
from ftc_jsb.point_mass.model import Condition, pressure_area
from ftc_jsb.vocabulary.channels import LOAD_FACTOR, THRUST
from ftc_jsb.vocabulary.kernel_types import LoopSettings, LoopState, Row

SUSTAINED_LAG = 2.0  # [s]: sideslip of a roll is over by then; that of a lost engine is not
DRAG_LAG = 0.1  # [s]: of the measured drag in the law; vanes are noisy


class Errors(NamedTuple):
    """Tracking errors e of (16): true, measured or estimated less reference."""

    airspeed: float  # [m/s]
    flight_path_angle: float  # [rad]
    heading: float  # [rad]


@compiled
def tracking_errors(s: LoopSettings, x: LoopState, row: Row) -> Errors:
    """Errors of the known state, or of the estimate where the settings say so."""
    known = x.known.state
    airspeed, path, heading = known[0], known[1], known[2]
    if s.feedback == 1:
        estimate = x.observer.filter.estimate
        airspeed, path, heading = estimate[0], estimate[1], estimate[2]
    return Errors(
        airspeed - row.airspeed_ref,
        path - row.flight_path_angle_ref,
        heading - row.heading_ref,
    )


@compiled
def state_for_law(s: LoopSettings, x: LoopState) -> PathState:
    """The filter's estimate, or the known state of a loop without one."""
    if s.estimator != NO_ESTIMATOR:
        estimate = x.observer.filter.estimate
        return PathState(estimate[0], estimate[1])
    return PathState(x.known.state[0], x.known.state[1])


@compiled
def wanted_rates(
    s: LoopSettings, x: LoopState, row: Row, state: PathState, errors: Errors
) -> Rates:
    """y_m' - K e of (17), with integral action where the loop has it; of the path for y = position."""
    if s.track_path == 1:
        return _rates_for_path(s, x, row, state)
    return Rates(
        row.airspeed_ref_rate - s.gains[0] * errors.airspeed - s.integral_gains[0] * x.integral[0],
        row.flight_path_angle_ref_rate
        - s.gains[1] * errors.flight_path_angle
        - s.integral_gains[1] * x.integral[1],
        row.heading_ref_rate - s.gains[2] * errors.heading - s.integral_gains[2] * x.integral[2],
    )


@compiled
def _rates_for_path(s: LoopSettings, x: LoopState, row: Row, state: PathState) -> Rates:
    """Rates that the path asks for: y_m'' - K e of (17) for y = position, e of (16) with its rate."""
    reference = (row.airspeed_ref, row.flight_path_angle_ref, row.heading_ref)
    rate = (row.airspeed_ref_rate, row.flight_path_angle_ref_rate, row.heading_ref_rate)
    wanted = acceleration(*reference, *rate)
    known = x.known
    moving = velocity(known.state[0], known.state[1], known.state[2])
    meant = velocity(*reference)
    far, fast = s.path_gains[0], s.path_gains[1]
    total = (
        wanted[0] - far * (known.position[0] - row.north_ref) - fast * (moving[0] - meant[0]),
        wanted[1] - far * (known.position[1] - row.east_ref) - fast * (moving[1] - meant[1]),
        wanted[2] - far * (known.altitude - row.altitude_ref) - fast * (moving[2] - meant[2]),
    )
    rates = rates_of(state.airspeed, state.flight_path_angle, known.state[2], total)
    return Rates(rates[0], rates[1], rates[2])


@compiled
def effectiveness_for_law(s: LoopSettings, x: LoopState, row: Row) -> Inputs:
    """What the law divides by, never below sigma."""
    thrust, load_factor, bank_angle = 1.0, 1.0, 1.0
    if s.effectiveness == ESTIMATED:
        f = x.observer.filter
        for a in range(f.count - OUTPUTS):
            value = min(f.estimate[OUTPUTS + a], s.effectiveness_most)
            if f.channel[a] == THRUST:
                thrust = value
            elif f.channel[a] == LOAD_FACTOR:
                load_factor = value
            else:
                bank_angle = value
    elif s.effectiveness == TRUE:
        thrust = row.effectiveness_thrust
        load_factor = row.effectiveness_load_factor
        bank_angle = row.effectiveness_bank_angle
        if not math.isfinite(thrust):  # the truth of a stuck throttle cannot be told
            thrust = 1.0
    floor = s.effectiveness_floor
    return Inputs(max(thrust, floor), max(load_factor, floor), max(bank_angle, floor))


@compiled
def drag_beyond_polar(
    s: LoopSettings, x: LoopState, at: Condition, row: Row, airspeed: float, effectiveness: float
) -> float:
    """Deceleration [m/s^2] by drag that is measured beyond the polar's at the measured load factor, lagged.

    The law takes its drag from the polar, which knows load factor and Mach number; what sideslip,
    elevator and pitch rate add is measured for the estimator, and the thrust has to pay for it too.
    Zero where the settings leave it out.
    """
    if s.drag_correction != 1:
        return 0.0
    area = pressure_area(at, airspeed)
    thrust = effectiveness * x.observer.thrust
    polar = polar_drag(at, airspeed, thrust, row.load_factor_meas)[0]
    beyond = x.observer.drag_coefficient - polar / area
    if math.isfinite(beyond):
        x.drag_beyond += (1.0 - math.exp(-s.dt / DRAG_LAG)) * (beyond - x.drag_beyond)
    unpaid = float(area * x.drag_beyond) / at.mass
    x.sustained += (1.0 - math.exp(-s.dt / SUSTAINED_LAG)) * (unpaid - x.sustained)
    return unpaid


@compiled
def demand_of_law(
    s: LoopSettings,
    x: LoopState,
    at: Condition,
    row: Row,
    state: PathState,
    effectiveness: Inputs,
    wanted: Rates,
    limits: Limits,
) -> Inputs:
    """U of (20) about the trim input u_n, before any limit; where the settings say so, upright."""
    airspeed, path = state.airspeed, state.flight_path_angle
    if s.upright == 0:
        trim = Inputs(x.trim[0], x.trim[1], x.trim[2])
        return control_law(at, airspeed, path, trim, effectiveness, wanted)
    least, most = limits.load_factor_min, limits.load_factor_max
    up, across = wanted_lift(at, airspeed, path, wanted, least, most)
    bank_now = row.bank_angle_meas
    if not math.isfinite(bank_now):
        bank_now = x.inner_loop.response[1, 0]
    load_factor = min(max(load_factor_at_bank(up, across, bank_now, s.bank_share), least), most)
    floor = GLIDE_FLOOR if x.given_up[2] > 0.0 else FLOOR
    thrust = thrust_for_acceleration(
        at, airspeed, path, x.trim[0], effectiveness.thrust, load_factor, wanted.airspeed
    )
    return Inputs(
        thrust,
        load_factor / effectiveness.load_factor,
        upright_bank(up, across, floor) / effectiveness.bank_angle,
    )


@compiled
def limit_demand(x: LoopState, at: Condition, row: Row, demand: Inputs, limits: Limits) -> None:
    """Hold the demand within the aircraft's limits."""
    x.demand[0] = min(max(demand.thrust, at.thrust_idle), at.thrust_maximum)
    x.demand[1] = min(max(demand.load_factor, limits.load_factor_min), limits.load_factor_max)
    x.demand[2] = min(max(demand.bank_angle, -limits.bank_max), limits.bank_max)
    row.thrust_saturated = 1.0 if x.demand[0] != demand.thrust else 0.0
    row.load_factor_saturated = 1.0 if x.demand[1] != demand.load_factor else 0.0


@compiled
def integrate_errors(s: LoopSettings, x: LoopState, row: Row, errors: Errors) -> None:
    """Integral action; an integral that a limit stops does not wind up."""
    if row.thrust_saturated == 0.0:
        x.integral[0] += errors.airspeed * s.dt
    if row.load_factor_saturated == 0.0:
        x.integral[1] += errors.flight_path_angle * s.dt
        x.integral[2] += errors.heading * s.dt
