"""The paper's outer loop as one compiled step: measure, estimate, decide, limit, filter.

Every built-in loop is this kernel with other settings: which estimator runs, and where the law
takes the effectiveness from. It reads one row of the recording and writes its decisions there.
"""

import math
from typing import Any

import numpy as np

from ftc_jsb.compiled import compiled
from ftc_jsb.control.law import control_law
from ftc_jsb.control.path import acceleration, rates_of
from ftc_jsb.estimation.detector import DETECTOR, detect
from ftc_jsb.estimation.ekf import predict_extended
from ftc_jsb.estimation.process import CHANNELS, FILTER, OUTPUTS, STATES, Forcing
from ftc_jsb.estimation.ukf import predict_unscented
from ftc_jsb.estimation.update import update
from ftc_jsb.point_mass.drag import measured_drag_coefficient
from ftc_jsb.point_mass.dynamics import level_trim_thrust, load_factor_limit, velocity
from ftc_jsb.point_mass.model import at_condition
from ftc_jsb.point_mass.thrust import healthy_thrust, next_rotor_speed, rotor_speed_target

NO_ESTIMATOR, UNSCENTED, EXTENDED = 0, 1, 2
ESTIMATED, ASSUMED_HEALTHY, TRUE = 0, 1, 2

LOOP_SETTINGS = np.dtype(
    [
        ("dt", float),  # [s]
        ("estimator", np.int64),  # NO_ESTIMATOR, UNSCENTED or EXTENDED
        ("effectiveness", np.int64),  # the law's: ESTIMATED, ASSUMED_HEALTHY or TRUE
        ("gains", float, (3,)),  # K_c [1/s]
        ("integral_gains", float, (3,)),  # [1/s^2]
        ("track_path", np.int64),  # 1: y is the position, of index 2
        ("path_gains", float, (2,)),  # of position [1/s^2] and velocity errors [1/s]
        ("trim_filter", float),  # zeta of (10) [1/s]
        ("effectiveness_floor", float),  # sigma: the least effectiveness the law divides by
        ("lead", float, (2,)),  # [s] of load factor and bank, against the inner loop's lag
        ("process_noise", float, (STATES,)),
        ("measurement_noise", float, (OUTPUTS,)),
        ("initial_covariance", float, (STATES,)),
        ("spread", float),  # n_a + kappa of (26)
        ("gate", float),  # bound on the normalised innovation squared; 0 = off
        ("gate_patience", np.int64),
        ("bounded", np.int64),  # 1: estimates kept in [sigma, 1]
        ("detector_margin", float),
        ("detector_sigmas", float),
        ("detector_hold", float),  # [s]
    ]
)

LOOP_STATE = np.dtype(
    [
        ("trim", float, (3,)),  # u_n of (10): thrust [N], load factor, bank [rad]
        ("demand", float, (3,)),  # limited u of the previous sample
        ("integral", float, (3,)),  # of the tracking errors
        ("rotor_speed", float),  # of the healthy engine that the loop imagines
        ("thrust", float),  # that engine's thrust [N]
        ("drag_coefficient", float),  # measured, of the previous sample
        ("alpha", float),  # [rad]
        ("load_factor", float),
        ("bank_angle", float),  # [rad]
        ("measurement", float, (OUTPUTS,)),
        ("filter", FILTER),
        ("detector", DETECTOR),
    ]
)


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
    at = at_condition(m, row.airspeed_meas, row.altitude_meas)
    if i == 0:
        _start(s, m, x, at, row)
    else:
        _estimate(s, m, x, at, row)
    _report(s, m, x, at, row)
    _decide(s, m, x, at, row)


@compiled
def _start(s: Any, m: Any, x: Any, at: Any, row: Any) -> None:
    """Level trim as u_n(0), the first measurement as the first estimate."""
    thrust = level_trim_thrust(at, row.airspeed_meas, row.flight_path_angle_meas)
    x.trim[0] = min(max(thrust, at.thrust_idle), at.thrust_maximum)
    x.trim[1] = math.cos(row.flight_path_angle_meas)
    x.trim[2] = 0.0
    for k in range(3):
        x.demand[k] = x.trim[k]
        x.integral[k] = 0.0
    x.rotor_speed = rotor_speed_target(at, x.trim[0])
    x.thrust = healthy_thrust(at, x.rotor_speed, x.trim[0])
    x.drag_coefficient, x.alpha, x.load_factor, x.bank_angle = _sensed(m, at, row)
    f = x.filter
    f.rejected = 0
    f.nis = math.nan  # nothing is predicted before the first sample
    for k in range(OUTPUTS):
        f.innovation[k] = math.nan
        f.innovation_covariance[k, k] = math.nan
    for a in range(f.count):
        f.estimate[a] = x.measurement[a] if a < OUTPUTS else 1.0
        for b in range(f.count):
            f.covariance[a, b] = 0.0
        f.covariance[a, a] = s.initial_covariance[a]
    x.detector.declared = 0
    x.detector.elapsed = 0.0


@compiled
def _sensed(m: Any, at: Any, row: Any) -> tuple[float, float, float, float]:
    """Measured drag coefficient, alpha, load factor and bank; nan where there is none."""
    coefficient = math.nan
    if m.measured_mach_count > 0:
        coefficient = measured_drag_coefficient(
            m,
            row.airspeed_meas / at.sound_speed,
            row.alpha_meas,
            row.sideslip_meas,
            row.elevator_meas,
            row.flap_meas,
            row.pitch_rate_meas / row.airspeed_meas,
        )
    return coefficient, row.alpha_meas, row.load_factor_meas, row.bank_angle_meas


@compiled
def _estimates_channel(f: Any, channel: int) -> bool:
    for a in range(f.count - OUTPUTS):
        if f.channel[a] == channel:
            return True
    return False


@compiled
def _estimate(s: Any, m: Any, x: Any, at: Any, row: Any) -> None:
    """Predict over the sample that has passed and correct by what is measured now."""
    thrust = x.demand[0]
    if m.spool_up[0] > 0.0:
        x.rotor_speed = next_rotor_speed(m, at, x.rotor_speed, x.demand[0], s.dt)
        now = healthy_thrust(at, x.rotor_speed, x.demand[0])
        thrust = 0.5 * (x.thrust + now)
        x.thrust = now
    else:
        x.thrust = thrust
    drag_coefficient, alpha, load_factor, bank_angle = _sensed(m, at, row)
    mean_drag = 0.5 * (x.drag_coefficient + drag_coefficient)
    mean_alpha = 0.5 * (x.alpha + alpha)
    acting_load_factor, acting_bank_angle = x.demand[1], x.demand[2]
    if m.response_frequency[0] > 0.0 and not _estimates_channel(x.filter, 1):
        mean = 0.5 * (x.load_factor + load_factor)
        acting_load_factor = mean if math.isfinite(mean) else acting_load_factor
    if m.response_frequency[1] > 0.0 and not _estimates_channel(x.filter, 2):
        mean = 0.5 * (x.bank_angle + bank_angle)
        acting_bank_angle = mean if math.isfinite(mean) else acting_bank_angle
    x.drag_coefficient, x.alpha = drag_coefficient, alpha
    x.load_factor, x.bank_angle = load_factor, bank_angle
    if s.estimator == NO_ESTIMATOR:
        return
    forcing = Forcing(
        thrust,
        acting_load_factor,
        acting_bank_angle,
        math.isfinite(mean_drag),
        mean_drag,
        mean_alpha,
    )
    if s.estimator == UNSCENTED:
        predict_unscented(x.filter, at, forcing, s.process_noise, s.spread, s.dt)
    else:
        predict_extended(x.filter, at, forcing, s.process_noise, s.dt)
    floor = s.effectiveness_floor if s.bounded == 1 else 0.0
    update(x.filter, x.measurement, s.measurement_noise, s.gate, s.gate_patience, floor)


@compiled
def _outside(m: Any, x: Any, at: Any, row: Any) -> bool:
    """Whether Mach number, altitude or lift coefficient are outside the range of the fit."""
    if m.valid_mach[1] == 0.0:
        return False
    mach = row.airspeed_meas / at.sound_speed
    pressure_area = 0.5 * at.density * row.airspeed_meas * row.airspeed_meas * m.area
    load_factor = row.load_factor_meas if math.isfinite(row.load_factor_meas) else x.demand[1]
    lift = load_factor * m.mass * m.gravity / pressure_area
    return bool(
        mach < m.valid_mach[0]
        or mach > m.valid_mach[1]
        or lift < m.valid_lift[0]
        or lift > m.valid_lift[1]
        or row.altitude_meas < m.valid_altitude[0]
        or row.altitude_meas > m.valid_altitude[1]
    )


@compiled
def _report(s: Any, m: Any, x: Any, at: Any, row: Any) -> None:
    """Write estimates, innovations and the detector's verdict; nan where nothing estimates."""
    row.thrust_model = x.thrust
    row.outside_range = 1.0 if _outside(m, x, at, row) else 0.0
    row.fault_declared = 0.0
    if s.estimator == NO_ESTIMATOR:
        return
    f = x.filter
    row.airspeed_est = f.estimate[0]
    row.flight_path_angle_est = f.estimate[1]
    row.heading_est = f.estimate[2]
    row.airspeed_std = math.sqrt(f.covariance[0, 0])
    row.flight_path_angle_std = math.sqrt(f.covariance[1, 1])
    row.heading_std = math.sqrt(f.covariance[2, 2])
    row.airspeed_innovation = f.innovation[0]
    row.flight_path_angle_innovation = f.innovation[1]
    row.heading_innovation = f.innovation[2]
    row.airspeed_innovation_std = math.sqrt(f.innovation_covariance[0, 0])
    row.flight_path_angle_innovation_std = math.sqrt(f.innovation_covariance[1, 1])
    row.heading_innovation_std = math.sqrt(f.innovation_covariance[2, 2])
    row.innovation_squared = f.nis
    statistic = 0.0
    for a in range(f.count - OUTPUTS):
        estimate = f.estimate[OUTPUTS + a]
        deviation = math.sqrt(f.covariance[OUTPUTS + a, OUTPUTS + a])
        if f.channel[a] == 0:
            row.effectiveness_thrust_est = estimate
            row.effectiveness_thrust_std = deviation
            statistic = detect(
                x.detector,
                estimate,
                deviation,
                s.detector_margin,
                s.detector_sigmas,
                s.detector_hold,
                s.dt,
            )
        elif f.channel[a] == 1:
            row.effectiveness_load_factor_est = estimate
            row.effectiveness_load_factor_std = deviation
        else:
            row.effectiveness_bank_angle_est = estimate
            row.effectiveness_bank_angle_std = deviation
    row.fault_statistic = statistic
    row.fault_declared = float(x.detector.declared)


@compiled
def _law_effectiveness(s: Any, x: Any, row: Any) -> tuple[float, float, float]:
    """What the law divides by, never below sigma."""
    thrust, load_factor, bank_angle = 1.0, 1.0, 1.0
    if s.effectiveness == ESTIMATED:
        for a in range(x.filter.count - OUTPUTS):
            value = x.filter.estimate[OUTPUTS + a]
            if x.filter.channel[a] == 0:
                thrust = value
            elif x.filter.channel[a] == 1:
                load_factor = value
            else:
                bank_angle = value
    elif s.effectiveness == TRUE:
        thrust = row.effectiveness_thrust
        load_factor = row.effectiveness_load_factor
        bank_angle = row.effectiveness_bank_angle
    floor = s.effectiveness_floor
    return max(thrust, floor), max(load_factor, floor), max(bank_angle, floor)


@compiled
def _path_demand(s: Any, row: Any, airspeed: float, path: float) -> Any:
    """Rates that the path asks for: y_m'' - K e of (17) for y = position, e of (16) with its rate."""
    reference = (row.airspeed_ref, row.flight_path_angle_ref, row.heading_ref)
    rate = (row.airspeed_ref_rate, row.flight_path_angle_ref_rate, row.heading_ref_rate)
    wanted = acceleration(*reference, *rate)
    moving = velocity(row.airspeed_meas, row.flight_path_angle_meas, row.heading_meas)
    meant = velocity(*reference)
    far, fast = s.path_gains[0], s.path_gains[1]
    total = (
        wanted[0] - far * (row.north_meas - row.north_ref) - fast * (moving[0] - meant[0]),
        wanted[1] - far * (row.east_meas - row.east_ref) - fast * (moving[1] - meant[1]),
        wanted[2] - far * (row.altitude_meas - row.altitude_ref) - fast * (moving[2] - meant[2]),
    )
    return rates_of(airspeed, path, row.heading_meas, total)


@compiled
def _decide(s: Any, m: Any, x: Any, at: Any, row: Any) -> None:
    """Law (20), limits, response lead, and the trim-input filter (10)."""
    errors = (
        row.airspeed_meas - row.airspeed_ref,
        row.flight_path_angle_meas - row.flight_path_angle_ref,
        row.heading_meas - row.heading_ref,
    )
    airspeed, path = x.measurement[0], x.measurement[1]
    if s.estimator != NO_ESTIMATOR:
        airspeed, path = x.filter.estimate[0], x.filter.estimate[1]
    if s.track_path == 1:
        rates = _path_demand(s, row, airspeed, path)
    else:
        rates = (
            row.airspeed_ref_rate - s.gains[0] * errors[0] - s.integral_gains[0] * x.integral[0],
            row.flight_path_angle_ref_rate
            - s.gains[1] * errors[1]
            - s.integral_gains[1] * x.integral[1],
            row.heading_ref_rate - s.gains[2] * errors[2] - s.integral_gains[2] * x.integral[2],
        )
    wanted = control_law(
        at,
        airspeed,
        path,
        x.trim[0],
        x.trim[1],
        x.trim[2],
        _law_effectiveness(s, x, row),
        rates[0],
        rates[1],
        rates[2],
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
    load_factor_rate = s.trim_filter * (x.demand[1] - x.trim[1])
    bank_rate = s.trim_filter * (x.demand[2] - x.trim[2])
    with_lead = x.demand[1] + s.lead[0] * load_factor_rate
    row.load_factor_cmd = min(max(with_lead, m.load_factor_min), load_max)
    row.bank_angle_cmd = x.demand[2] + s.lead[1] * bank_rate
    share = 1.0 - math.exp(-s.trim_filter * s.dt)
    for k in range(CHANNELS):  # (10), exact for a command held over the sample
        x.trim[k] += share * (x.demand[k] - x.trim[k])
