"""The paper's outer loop as one compiled step: measure, estimate, decide, limit, filter.

Every built-in loop is this kernel with other settings: which estimator runs, and where the law
takes the effectiveness from. It reads one row of the recording and writes its decisions there.
"""

import math
from typing import Any

from ftc_jsb.compiled import compiled
from ftc_jsb.control.law import control_law
from ftc_jsb.control.observer import estimate, law_effectiveness, report, sensed
from ftc_jsb.control.path import acceleration, rates_of
from ftc_jsb.control.priority import affordable, give_up
from ftc_jsb.control.records import NO_ESTIMATOR
from ftc_jsb.estimation.process import CHANNELS, OUTPUTS
from ftc_jsb.point_mass.dynamics import level_trim_thrust, load_factor_limit, polar_drag, velocity
from ftc_jsb.point_mass.model import at_condition
from ftc_jsb.point_mass.thrust import healthy_thrust, rotor_speed_target

SMALLEST_UPRIGHT = 0.3  # cosine of a bank of 73 deg: beyond, lift hardly holds the aircraft up
DRAG_LAG = 0.1  # [s]: of the measured drag in the law; vanes are noisy


@compiled
def outer_loop_step(settings: Any, model: Any, state: Any, record: Any, i: int) -> None:
    """One sample of the outer loop.

    Args:
        settings: (1,) LOOP_SETTINGS.
        model: (1,) MODEL.
        state: (1,) LOOP_STATE, advanced.
        record: (rows,) of the recording; references and measurements of row `i` are read,
            commands, estimates and the detector's verdict are written.
        i: row; 0 starts the loop.
    """
    s, m, x, row = settings[0], model[0], state[0], record[i]
    x.measurement[0] = row.airspeed_meas
    x.measurement[1] = row.flight_path_angle_meas
    x.measurement[2] = row.heading_meas
    _see(s, x, row, i)
    at = at_condition(m, x.seen[0], x.altitude)
    if i == 0:
        _start(s, m, x, at, row)
    else:
        _noise(s, m, x)
        estimate(s, m, x, at, row)
    report(s, m, x, at, row)
    _decide(s, m, x, at, row)


@compiled
def _see(s: Any, x: Any, row: Any, i: int) -> None:
    """What is known of the state: where a sensor is silent, the filter's estimate, or what was last seen.

    At the start that is the reference, which begins at the initial condition.
    """
    if i == 0:
        x.seen[0] = row.airspeed_ref
        x.seen[1] = row.flight_path_angle_ref
        x.seen[2] = row.heading_ref
        x.position[0], x.position[1], x.altitude = row.north_ref, row.east_ref, row.altitude_ref
    for k in range(OUTPUTS):
        if math.isfinite(x.measurement[k]):
            x.seen[k] = x.measurement[k]
        elif s.estimator != NO_ESTIMATOR and i > 0:
            x.seen[k] = x.filter.estimate[k]
    if math.isfinite(row.north_meas):
        x.position[0] = row.north_meas
    if math.isfinite(row.east_meas):
        x.position[1] = row.east_meas
    if math.isfinite(row.altitude_meas):
        x.altitude = row.altitude_meas


@compiled
def _start(s: Any, m: Any, x: Any, at: Any, row: Any) -> None:
    """Level trim as u_n(0), the first measurement as the first estimate."""
    thrust = level_trim_thrust(at, x.seen[0], x.seen[1])
    x.trim[0] = min(max(thrust, at.thrust_idle), at.thrust_maximum)
    x.trim[1] = math.cos(x.seen[1])
    x.trim[2] = 0.0
    for k in range(3):
        x.demand[k] = x.trim[k]
        x.integral[k] = 0.0
    x.given_up[0], x.given_up[1] = 0.0, 0.0
    x.drag_beyond = 0.0
    for axis in range(2):
        x.command[axis] = x.trim[1 + axis]
        x.slow[axis] = x.trim[1 + axis]
        x.response[axis, 0], x.response[axis, 1] = x.trim[1 + axis], 0.0
    x.rotor_speed = rotor_speed_target(at, x.trim[0])
    x.thrust = healthy_thrust(at, x.rotor_speed, x.trim[0])
    x.drag_coefficient, x.alpha, x.load_factor, x.bank_angle = sensed(m, x, at, row)
    f = x.filter
    f.rejected = 0
    f.nis = math.nan  # nothing is predicted before the first sample
    for k in range(OUTPUTS):
        f.innovation[k] = math.nan
        f.innovation_covariance[k, k] = math.nan
    for a in range(f.count):
        f.estimate[a] = x.seen[a] if a < OUTPUTS else 1.0
        for b in range(f.count):
            f.covariance[a, b] = 0.0
        f.covariance[a, a] = s.initial_covariance[a]
    x.trim_thrust = x.trim[0]
    x.acceleration_innovation, x.acceleration_innovation_std = math.nan, math.nan
    x.detector.declared = 0
    x.detector.elapsed = 0.0


@compiled
def _noise(s: Any, m: Any, x: Any) -> None:
    """Q of this sample: settings may be changed in flight."""
    for a in range(x.filter.count):
        x.process_noise[a] = s.process_noise[a]
        if a >= OUTPUTS and s.response_time > 0.0:
            x.process_noise[a] = _effectiveness_noise(s, m, x)


@compiled
def _effectiveness_noise(s: Any, m: Any, x: Any) -> float:
    """Q of an effectiveness that lets the filter follow a loss in `response_time`.

    A random walk of variance q a step, seen each step with variance r, is followed by the steady
    Kalman filter with the gain sqrt(q / r), that is in the time dt sqrt(r / q). r is that of the
    force along the velocity over the thrust of trim; without the accelerometer it is that of the
    airspeed's change over the response time.
    """
    noise = s.acceleration_noise
    if noise == 0.0:
        steps = s.response_time / s.dt
        noise = (s.process_noise[0] * steps + 2.0 * s.measurement_noise[0]) / s.response_time**2
        noise *= steps
    r = noise * (m.mass / max(x.trim_thrust, 0.1 * m.mass * m.gravity)) ** 2
    return float(r * (s.dt / s.response_time) ** 2)


@compiled
def _path_demand(s: Any, x: Any, row: Any, airspeed: float, path: float) -> Any:
    """Rates that the path asks for: y_m'' - K e of (17) for y = position, e of (16) with its rate."""
    reference = (row.airspeed_ref, row.flight_path_angle_ref, row.heading_ref)
    rate = (row.airspeed_ref_rate, row.flight_path_angle_ref_rate, row.heading_ref_rate)
    wanted = acceleration(*reference, *rate)
    moving = velocity(x.seen[0], x.seen[1], x.seen[2])
    meant = velocity(*reference)
    far, fast = s.path_gains[0], s.path_gains[1]
    total = (
        wanted[0] - far * (x.position[0] - row.north_ref) - fast * (moving[0] - meant[0]),
        wanted[1] - far * (x.position[1] - row.east_ref) - fast * (moving[1] - meant[1]),
        wanted[2] - far * (x.altitude - row.altitude_ref) - fast * (moving[2] - meant[2]),
    )
    return rates_of(airspeed, path, x.seen[2], total)


@compiled
def _drag_correction(
    s: Any, m: Any, x: Any, at: Any, row: Any, airspeed: float, effectiveness: float
) -> float:
    """Drag [N] that is measured beyond that of the polar at the measured load factor, with a lag.

    The law takes its drag from the polar, which knows load factor and Mach number; what sideslip,
    elevator and pitch rate add is measured for the estimator, and the thrust has to pay for it too.
    """
    pressure_area = 0.5 * at.density * airspeed * airspeed * at.area
    polar = polar_drag(at, airspeed, effectiveness * x.thrust, row.load_factor_meas)[0]
    beyond = x.drag_coefficient - polar / pressure_area
    if math.isfinite(beyond):
        x.drag_beyond += (1.0 - math.exp(-s.dt / DRAG_LAG)) * (beyond - x.drag_beyond)
    return float(pressure_area * x.drag_beyond)


@compiled
def _for_the_bank_that_is_there(s: Any, m: Any, x: Any) -> float:
    """Load factor command while bank is still on its way to its command.

    The law pairs load factor and bank; load factor comes sooner, and until bank is there it lifts
    where it should turn. n cos(bank demanded) / cos(bank of a healthy inner loop) keeps the lift
    against gravity as demanded; `bank_share` says how much of the way to go there, since what
    serves the path is taken from the turn. Nothing where bank follows at once (the paper's aircraft).
    """
    demand = float(x.demand[1])
    upright = math.cos(x.response[1, 0])
    if m.response_frequency[1] == 0.0 or upright < SMALLEST_UPRIGHT:
        return demand
    return float(demand + s.bank_share * (demand * math.cos(x.demand[2]) / upright - demand))


@compiled
def _decide(s: Any, m: Any, x: Any, at: Any, row: Any) -> None:
    """Law (20), limits, response lead, and the trim-input filter (10)."""
    airspeed, path, heading = x.seen[0], x.seen[1], x.seen[2]
    if s.feedback == 1:
        airspeed, path, heading = (
            x.filter.estimate[0],
            x.filter.estimate[1],
            x.filter.estimate[2],
        )
    errors = (
        airspeed - row.airspeed_ref,
        path - row.flight_path_angle_ref,
        heading - row.heading_ref,
    )
    if s.estimator != NO_ESTIMATOR:
        airspeed, path = x.filter.estimate[0], x.filter.estimate[1]
    if s.track_path == 1:
        rates = _path_demand(s, x, row, airspeed, path)
    else:
        rates = (
            row.airspeed_ref_rate - s.gains[0] * errors[0] - s.integral_gains[0] * x.integral[0],
            row.flight_path_angle_ref_rate
            - s.gains[1] * errors[1]
            - s.integral_gains[1] * x.integral[1],
            row.heading_ref_rate - s.gains[2] * errors[2] - s.integral_gains[2] * x.integral[2],
        )
    effectiveness = law_effectiveness(s, x, row)
    airspeed_rate, path_rate, heading_rate = rates
    unpaid = 0.0  # [m/s^2] of drag that the polar does not know of
    if s.drag_correction == 1:
        unpaid = _drag_correction(s, m, x, at, row, airspeed, effectiveness[0]) / at.mass
    if s.speed_first == 1:
        target = affordable(
            at,
            effectiveness[0] * at.thrust_maximum,
            airspeed,
            path,
            row.flight_path_angle_ref,
            row.airspeed_ref_rate,
            airspeed_rate,
            heading_rate,
        )
        per_g = at.gravity / airspeed
        lowering = give_up(x.given_up, target, row.flight_path_angle_ref, per_g, s.dt)
        path_rate -= lowering + s.gains[1] * x.given_up[0]
        heading_rate -= x.given_up[1] * rates[2]
    row.climb_given_up = x.given_up[0]
    row.turn_given_up = abs(x.given_up[1] * rates[2])
    wanted = control_law(
        at,
        airspeed,
        path,
        x.trim[0],
        x.trim[1],
        x.trim[2],
        effectiveness,
        airspeed_rate + unpaid,
        path_rate,
        heading_rate,
    )
    load_max = load_factor_limit(at, airspeed, m.load_factor_max, m.lift_coefficient_max)
    x.demand[0] = min(max(wanted[0], at.thrust_idle), at.thrust_maximum)
    x.demand[1] = min(max(wanted[1], m.load_factor_min), load_max)
    x.demand[2] = min(max(wanted[2], -math.pi), math.pi)
    row.thrust_saturated = 1.0 if x.demand[0] != wanted[0] else 0.0
    row.load_factor_saturated = 1.0 if x.demand[1] != wanted[1] else 0.0
    if row.thrust_saturated == 0.0:  # an integral that its limit stops would wind up
        x.integral[0] += errors[0] * s.dt
    if row.load_factor_saturated == 0.0:
        x.integral[1] += errors[1] * s.dt
        x.integral[2] += errors[2] * s.dt
    row.trim_input_thrust = x.trim[0]
    row.trim_input_load_factor = x.trim[1]
    row.trim_input_bank_angle = x.trim[2]
    row.load_factor_demand = x.demand[1]
    row.bank_angle_demand = x.demand[2]
    row.thrust_cmd = x.demand[0]
    load_factor_rate = s.lead_filter * (x.demand[1] - x.slow[0])
    bank_rate = s.lead_filter * (x.demand[2] - x.slow[1])
    with_lead = _for_the_bank_that_is_there(s, m, x) + s.lead[0] * load_factor_rate
    row.load_factor_cmd = min(max(with_lead, m.load_factor_min), load_max)
    row.bank_angle_cmd = x.demand[2] + s.lead[1] * bank_rate
    x.command[0], x.command[1] = row.load_factor_cmd, row.bank_angle_cmd
    for k in range(CHANNELS):  # (10)
        x.trim[k] += s.trim_share * (x.demand[k] - x.trim[k])
    for axis in range(2):
        x.slow[axis] += s.lead_share * (x.demand[1 + axis] - x.slow[axis])
