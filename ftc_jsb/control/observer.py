"""The knowing half of the outer loop: what was flown, estimated and declared, sample by sample."""

import math
from typing import Any

from ftc_jsb.compiled import compiled
from ftc_jsb.control.records import ESTIMATED, NO_ESTIMATOR, TRUE, UNSCENTED
from ftc_jsb.estimation.detector import detect
from ftc_jsb.estimation.ekf import predict_extended
from ftc_jsb.estimation.process import OUTPUTS, Forcing
from ftc_jsb.estimation.ukf import predict_unscented
from ftc_jsb.estimation.update import update, update_by_state
from ftc_jsb.point_mass.drag import measured_drag_coefficient
from ftc_jsb.point_mass.dynamics import polar_drag
from ftc_jsb.point_mass.response import lag_step
from ftc_jsb.point_mass.thrust import healthy_thrust, next_rotor_speed


@compiled
def sensed(m: Any, x: Any, at: Any, row: Any) -> tuple[float, float, float, float]:
    """Measured drag coefficient, alpha, load factor and bank; nan where there is none."""
    coefficient = math.nan
    if m.measured_mach_count > 0:
        coefficient = measured_drag_coefficient(
            m,
            x.seen[0] / at.sound_speed,
            row.alpha_meas,
            row.sideslip_meas,
            row.elevator_meas,
            row.flap_meas,
            row.pitch_rate_meas / x.seen[0],
        )
    return coefficient, row.alpha_meas, row.load_factor_meas, row.bank_angle_meas


@compiled
def estimates_channel(f: Any, channel: int) -> bool:
    """Whether a FILTER record estimates a channel (0 thrust, 1 load factor, 2 bank angle)."""
    for a in range(f.count - OUTPUTS):
        if f.channel[a] == channel:
            return True
    return False


@compiled
def _acting(m: Any, x: Any, axis: int, measured: float, dt: float) -> float:
    """Load factor (axis 0) or bank (1) that acted over the sample, as the process model takes it.

    At once what was demanded, where the aircraft has no lag (the paper's). Else what is measured; but
    where the channel's own effectiveness is estimated, that would hide the loss: then the response of a
    healthy inner loop to the commands, which the filter multiplies by its estimate.
    """
    if m.response_frequency[axis] == 0.0:
        return float(x.demand[1 + axis])
    before = x.response[axis, 0]
    rate_max = m.bank_rate_max if axis == 1 else 0.0
    acceleration_max = m.bank_acceleration_max if axis == 1 else 0.0
    x.response[axis, 0], x.response[axis, 1] = lag_step(
        before,
        x.response[axis, 1],
        x.command[axis],
        m.response_frequency[axis],
        m.response_damping[axis],
        rate_max,
        acceleration_max,
        dt,
    )
    if estimates_channel(x.filter, 1 + axis) or not math.isfinite(measured):
        return float(0.5 * (before + x.response[axis, 0]))
    return measured


@compiled
def estimate(s: Any, m: Any, x: Any, at: Any, row: Any) -> None:
    """Predict over the sample that has passed and correct by what is measured now."""
    thrust = x.demand[0]
    if m.spool_up[0] > 0.0:
        x.rotor_speed = next_rotor_speed(m, at, x.rotor_speed, x.demand[0], s.dt)
        now = healthy_thrust(at, x.rotor_speed, x.demand[0])
        thrust = 0.5 * (x.thrust + now)
        x.thrust = now
    else:
        x.thrust = thrust
    drag_coefficient, alpha, load_factor, bank_angle = sensed(m, x, at, row)
    mean_drag = 0.5 * (x.drag_coefficient + drag_coefficient)
    mean_alpha = 0.5 * (x.alpha + alpha)
    acting_load_factor = _acting(m, x, 0, 0.5 * (x.load_factor + load_factor), s.dt)
    acting_bank_angle = _acting(m, x, 1, 0.5 * (x.bank_angle + bank_angle), s.dt)
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
        predict_unscented(x.filter, at, forcing, x.process_noise, s.spread, s.dt)
    else:
        predict_extended(x.filter, at, forcing, x.process_noise, s.dt)
    floor = s.effectiveness_floor if s.bounded == 1 else 0.0
    update(x.filter, x.measurement, s.measurement_noise, s.gate, s.gate_patience, floor)
    if s.acceleration_noise > 0.0:
        _weigh_acceleration(s, m, x, at, row, drag_coefficient, alpha, load_factor, floor)


@compiled
def _weigh_acceleration(
    s: Any,
    m: Any,
    x: Any,
    at: Any,
    row: Any,
    drag_coefficient: float,
    alpha: float,
    load_factor: float,
    floor: float,
) -> None:
    """Correct by the force along the velocity: k T cos(alpha) - D over the mass.

    The accelerometers feel thrust and drag and not the gust that moves the airspeed, so that in
    turbulence they tell of the thrust what the airspeed cannot.
    """
    x.acceleration_innovation, x.acceleration_innovation_std = math.nan, math.nan
    airspeed = x.filter.estimate[0]
    pressure_area = 0.5 * at.density * airspeed * airspeed * at.area
    if not math.isfinite(drag_coefficient):  # no measured drag: the polar's, at the measured n
        alpha, load = 0.0, load_factor if math.isfinite(load_factor) else x.demand[1]
        drag, alpha = polar_drag(at, airspeed, x.thrust, load)
    else:
        drag = pressure_area * drag_coefficient
    slope = x.thrust * math.cos(alpha) / m.mass  # of the acceleration, per effectiveness
    if not math.isfinite(row.acceleration_meas + slope + drag):
        return
    effectiveness, place = 1.0, -1
    for a in range(x.filter.count - OUTPUTS):
        if x.filter.channel[a] == 0:
            place = OUTPUTS + a
            effectiveness = x.filter.estimate[place]
    x.acceleration_innovation = row.acceleration_meas - (effectiveness * slope - drag / m.mass)
    if place < 0:
        return
    x.acceleration_innovation_std = update_by_state(
        x.filter, place, slope, x.acceleration_innovation, s.acceleration_noise, floor
    )


@compiled
def _outside(m: Any, x: Any, at: Any, row: Any) -> bool:
    """Whether Mach number, altitude or lift coefficient are outside the range of the fit."""
    if m.valid_mach[1] == 0.0:
        return False
    mach = x.seen[0] / at.sound_speed
    pressure_area = 0.5 * at.density * x.seen[0] * x.seen[0] * m.area
    load_factor = row.load_factor_meas if math.isfinite(row.load_factor_meas) else x.demand[1]
    lift = load_factor * m.mass * m.gravity / pressure_area
    return bool(
        mach < m.valid_mach[0]
        or mach > m.valid_mach[1]
        or lift < m.valid_lift[0]
        or lift > m.valid_lift[1]
        or x.altitude < m.valid_altitude[0]
        or x.altitude > m.valid_altitude[1]
    )


@compiled
def report(s: Any, m: Any, x: Any, at: Any, row: Any) -> None:
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
    if s.acceleration_noise > 0.0:
        row.acceleration_innovation = x.acceleration_innovation
        row.acceleration_innovation_std = x.acceleration_innovation_std
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
def law_effectiveness(s: Any, x: Any, row: Any) -> tuple[float, float, float]:
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
        if not math.isfinite(thrust):  # the truth of a stuck throttle cannot be told
            thrust = 1.0
    floor = s.effectiveness_floor
    return max(thrust, floor), max(load_factor, floor), max(bank_angle, floor)
