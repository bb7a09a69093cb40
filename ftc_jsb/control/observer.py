"""The knowing half of the outer loop: what was flown, estimated and declared, sample by sample."""

import math

from ftc_jsb.compiled import compiled
from ftc_jsb.control.believed_readings import believe_isolation
from ftc_jsb.control.instruments import (
    NOTHING,
    consider_instruments,
    drag_coefficient_measured,
    noise_as_seen,
)
from ftc_jsb.control.records import NO_ESTIMATOR, UNSCENTED
from ftc_jsb.estimation.detector import detect
from ftc_jsb.estimation.ekf import predict_extended
from ftc_jsb.estimation.process import OUTPUTS, Forcing, place_of_channel
from ftc_jsb.estimation.ukf import predict_unscented
from ftc_jsb.estimation.update import update, update_by_state
from ftc_jsb.point_mass.dynamics import polar_drag
from ftc_jsb.point_mass.fuel import burn_fuel
from ftc_jsb.point_mass.model import Condition, pressure_area
from ftc_jsb.point_mass.response import lag_step
from ftc_jsb.point_mass.thrust import (
    healthy_thrust,
    next_rotor_speed,
    other_rotor_speed,
    rotor_speed_target,
    thrust_doubt,
)
from ftc_jsb.vocabulary.channels import BANK_ANGLE, LOAD_FACTOR, THRUST
from ftc_jsb.vocabulary.kernel_types import LoopSettings, LoopState, ModelRecord, Row

NOT_YET = -1.0  # rotor speed before the first command, to which JSBSim's rotors jump out of a trim
SPOOLING = 20.0  # samples for which the error of a spooling engine's thrust stays about the same


@compiled
def start_observer(s: LoopSettings, m: ModelRecord, x: LoopState, at: Condition, row: Row) -> None:
    """A healthy engine at trim, the known state as the first estimate, nothing declared."""
    o = x.observer
    o.trim_thrust = x.trim[0]
    o.rotor_speed = rotor_speed_target(at, x.trim[0])
    o.thrust = healthy_thrust(at, o.rotor_speed, x.trim[0])
    o.other_rotor, o.thrust_doubt = NOT_YET, 0.0
    o.fuel_flow = m.fuel_flow[3]
    o.drag_coefficient = drag_coefficient_measured(m, x, at, row, NOTHING, 0.0)
    o.alpha, o.load_factor, o.bank_angle = row.alpha_meas, row.load_factor_meas, row.bank_angle_meas
    f = o.filter
    f.rejected = 0
    f.nis = math.nan  # nothing is predicted before the first sample
    for k in range(OUTPUTS):
        f.innovation[k] = math.nan
        f.innovation_covariance[k, k] = math.nan
    for a in range(f.count):
        f.estimate[a] = x.known.state[a] if a < OUTPUTS else 1.0
        for b in range(f.count):
            f.covariance[a, b] = 0.0
        f.covariance[a, a] = s.initial_covariance[a]
    o.acceleration_innovation, o.acceleration_innovation_std = math.nan, math.nan
    o.acceleration_noise, o.considered, o.blind = s.acceleration_noise, 0.0, 0
    o.noise_seen, o.power, o.product, o.last = s.acceleration_noise, 1.0, 0.0, 0.0
    o.detector.declared = 0
    o.detector.elapsed = 0.0


@compiled
def observe(s: LoopSettings, m: ModelRecord, x: LoopState, at: Condition, row: Row) -> None:
    """Predict over the sample that has passed and correct by what is measured now."""
    _set_process_noise(s, m, x)
    forcing = _forcing_of_sample(s, m, x, at, row)
    _follow_mass(s, m, x, at, forcing.thrust)
    if s.estimator == NO_ESTIMATOR:
        return
    o = x.observer
    if s.estimator == UNSCENTED:
        predict_unscented(o.filter, at, forcing, o.process_noise, s.spread, s.dt)
    else:
        predict_extended(o.filter, at, forcing, o.process_noise, s.dt)
    floor = s.effectiveness_floor if s.bounded == 1 else 0.0
    update(o.filter, x.known.measurement, s.measurement_noise, s.gate, s.gate_patience, floor)
    if s.acceleration_noise > 0.0:
        _update_by_acceleration(s, m, x, at, row, floor)


@compiled
def _set_process_noise(s: LoopSettings, m: ModelRecord, x: LoopState) -> None:
    """Q of this sample: settings may be changed in flight.

    The response time sets that of the thrust alone: what is seen of the force along the velocity tells
    nothing of how load factor and bank may change, whose Q is that of the settings.
    """
    o = x.observer
    for a in range(o.filter.count):
        o.process_noise[a] = s.process_noise[a]
    place = place_of_channel(o.filter, THRUST)
    if place >= 0 and s.response_time > 0.0:
        o.process_noise[place] = _effectiveness_noise(s, m, o.trim_thrust, o.noise_seen)
        if o.blind == 1:
            o.process_noise[place] = 0.0


@compiled
def _effectiveness_noise(
    s: LoopSettings, m: ModelRecord, trim_thrust: float, noise_now: float
) -> float:
    """Q of an effectiveness that lets the filter follow a loss in `response_time`.

    A random walk of variance q a step, seen each step with variance r, is followed by the steady
    Kalman filter with the gain sqrt(q / r), that is in the time dt sqrt(r / q). r is that of the
    force along the velocity over the thrust of trim; without the accelerometer it is that of the
    airspeed's change over the response time.
    """
    noise = noise_now
    if noise == 0.0:
        steps = s.response_time / s.dt
        noise = (s.process_noise[0] * steps + 2.0 * s.measurement_noise[0]) / s.response_time**2
        noise *= steps
    r = noise * (m.mass / max(trim_thrust, 0.1 * m.mass * m.gravity)) ** 2
    return float(r * (s.dt / s.response_time) ** 2)


@compiled
def _forcing_of_sample(
    s: LoopSettings, m: ModelRecord, x: LoopState, at: Condition, row: Row
) -> Forcing:
    """What acted over the sample that has passed: means of its start and its end."""
    o = x.observer
    thrust = _healthy_thrust_of_sample(s, m, x, at)
    drag_coefficient = drag_coefficient_measured(m, x, at, row, NOTHING, 0.0)
    mean_drag = 0.5 * (o.drag_coefficient + drag_coefficient)
    mean_alpha = 0.5 * (o.alpha + row.alpha_meas)
    mean_load_factor = 0.5 * (o.load_factor + row.load_factor_meas)
    mean_bank_angle = 0.5 * (o.bank_angle + row.bank_angle_meas)
    load_factor = _acting(m, x, LOAD_FACTOR, mean_load_factor, s.dt)
    bank_angle = _acting(m, x, BANK_ANGLE, mean_bank_angle, s.dt)
    o.drag_coefficient, o.alpha = drag_coefficient, row.alpha_meas
    o.load_factor, o.bank_angle = row.load_factor_meas, row.bank_angle_meas
    measured = math.isfinite(mean_drag)
    return Forcing(thrust, load_factor, bank_angle, measured, mean_drag, mean_alpha)


@compiled
def _healthy_thrust_of_sample(
    s: LoopSettings, m: ModelRecord, x: LoopState, at: Condition
) -> float:
    """Thrust [N] that a healthy engine gave over the sample, on the average."""
    o = x.observer
    thrust = float(x.demand[0])
    if m.spool_up[0] > 0.0:
        o.rotor_speed = next_rotor_speed(m, at, o.rotor_speed, x.demand[0], s.dt)
        if o.other_rotor == NOT_YET:
            o.other_rotor = rotor_speed_target(at, x.demand[0])
        o.other_rotor = other_rotor_speed(m, at, o.other_rotor, x.demand[0], s.dt)
        o.thrust_doubt = thrust_doubt(at, o.rotor_speed, o.other_rotor)
        now = healthy_thrust(at, o.rotor_speed, x.demand[0])
        thrust = 0.5 * (o.thrust + now)
        o.thrust = now
    else:
        o.thrust = thrust
    return thrust


@compiled
def _follow_mass(
    s: LoopSettings, m: ModelRecord, x: LoopState, at: Condition, thrust: float
) -> None:
    """Take from the mass what the engine has burnt over the sample, by the thrust that it is believed to give.

    That is the healthy engine's [N] times the estimated effectiveness. No flow is measured: it would tell of
    the fault that is to be found.
    """
    o = x.observer
    place = place_of_channel(o.filter, THRUST)
    if s.estimator != NO_ESTIMATOR and place >= 0:
        effectiveness = o.filter.estimate[place]
        if effectiveness < s.effectiveness_floor:  # an engine that is dead burns nothing
            o.fuel_flow = 0.0
            return
        thrust *= min(effectiveness, s.effectiveness_most)
    o.fuel_flow = burn_fuel(m, at, o.fuel_flow, o.rotor_speed, thrust, x.demand[0], s.dt)


@compiled
def _acting(m: ModelRecord, x: LoopState, channel: int, measured: float, dt: float) -> float:
    """Load factor or bank that acted over the sample, as the process model takes it.

    At once what was demanded, where the aircraft has no lag (the paper's). Else what is measured; but
    where the channel's own effectiveness is estimated, that would hide the loss: then the response of a
    healthy inner loop to the commands, which the filter multiplies by its estimate.
    """
    axis = channel - LOAD_FACTOR
    if m.response_frequency[axis] == 0.0:
        return float(x.demand[channel])
    lag = x.inner_loop
    before = lag.response[axis, 0]
    rate_max = m.bank_rate_max if channel == BANK_ANGLE else 0.0
    acceleration_max = m.bank_acceleration_max if channel == BANK_ANGLE else 0.0
    lag.response[axis, 0], lag.response[axis, 1] = lag_step(
        before,
        lag.response[axis, 1],
        lag.command[axis],
        m.response_frequency[axis],
        m.response_damping[axis],
        rate_max,
        acceleration_max,
        dt,
    )
    if place_of_channel(x.observer.filter, channel) >= 0 or not math.isfinite(measured):
        return float(0.5 * (before + lag.response[axis, 0]))
    return measured


@compiled
def _update_by_acceleration(
    s: LoopSettings, m: ModelRecord, x: LoopState, at: Condition, row: Row, floor: float
) -> None:
    """Correct by the force along the velocity: k T cos(alpha) - D over the mass.

    The accelerometers feel thrust and drag and not the gust that moves the airspeed, so that in
    turbulence they tell of the thrust what the airspeed cannot.
    """
    o = x.observer
    o.acceleration_innovation, o.acceleration_innovation_std = math.nan, math.nan
    airspeed = o.filter.estimate[0]
    if math.isfinite(o.drag_coefficient):
        drag, alpha = pressure_area(at, airspeed) * o.drag_coefficient, o.alpha
    else:  # no measured drag: the polar's, at the measured n
        load = o.load_factor if math.isfinite(o.load_factor) else x.demand[1]
        drag, alpha = polar_drag(at, airspeed, o.thrust, load)
    slope = o.thrust * math.cos(alpha) / m.mass  # of the acceleration, per effectiveness
    if not math.isfinite(row.acceleration_meas + slope + drag):
        return
    consider_instruments(s, m, x, at, row, slope)
    place = place_of_channel(o.filter, THRUST)
    effectiveness = o.filter.estimate[place] if place >= 0 else 1.0
    o.acceleration_innovation = row.acceleration_meas - (effectiveness * slope - drag / m.mass)
    if place >= 0:
        spooling = SPOOLING * (effectiveness * o.thrust_doubt / m.mass) ** 2
        variance = (
            slope * slope * o.filter.covariance[place, place] + o.acceleration_noise + spooling
        )
        o.acceleration_innovation_std = math.sqrt(variance)
        if o.blind == 1:  # near no thrust: what is estimated is held
            return
        o.noise_seen = noise_as_seen(o, o.acceleration_innovation, variance, s.dt)
        noise = o.noise_seen + spooling
        o.acceleration_innovation_std = update_by_state(
            o.filter, place, slope, o.acceleration_innovation, noise, floor
        )


@compiled
def record_estimates(
    s: LoopSettings, m: ModelRecord, x: LoopState, at: Condition, row: Row
) -> None:
    """Write estimates, innovations and the detector's verdict; nan where nothing estimates."""
    o = x.observer
    row.thrust_model = o.thrust
    row.outside_range = 1.0 if _outside_range(m, x, at, row) else 0.0
    row.fault_declared = 0.0
    if s.estimator == NO_ESTIMATOR:
        return
    _record_state(x, row)
    if s.acceleration_noise > 0.0:
        row.acceleration_innovation = o.acceleration_innovation
        row.acceleration_innovation_std = o.acceleration_innovation_std
    _record_effectiveness(s, x, row)


@compiled
def _record_state(x: LoopState, row: Row) -> None:
    """Estimates of airspeed, flight path angle and heading, and their innovations."""
    f = x.observer.filter
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


@compiled
def _record_effectiveness(s: LoopSettings, x: LoopState, row: Row) -> None:
    """Estimates of the effectiveness, and what the detector makes of the thrust's."""
    o = x.observer
    f = o.filter
    statistic = 0.0
    for a in range(f.count - OUTPUTS):
        estimate = f.estimate[OUTPUTS + a]
        deviation = math.sqrt(f.covariance[OUTPUTS + a, OUTPUTS + a])
        if f.channel[a] == THRUST:
            deviation = math.hypot(deviation, o.considered)
        if f.channel[a] == THRUST:
            row.effectiveness_thrust_est = estimate
            row.effectiveness_thrust_std = deviation
            statistic = detect(
                o.detector,
                estimate,
                deviation,
                s.detector_margin,
                s.detector_sigmas,
                s.detector_hold,
                s.dt,
            )
        elif f.channel[a] == LOAD_FACTOR:
            row.effectiveness_load_factor_est = estimate
            row.effectiveness_load_factor_std = deviation
        else:
            row.effectiveness_bank_angle_est = estimate
            row.effectiveness_bank_angle_std = deviation
    row.fault_statistic = statistic
    if s.isolation.enabled == 1:
        believe_isolation(x.isolation, o.detector, row)
    row.fault_declared = float(o.detector.declared)


@compiled
def _outside_range(m: ModelRecord, x: LoopState, at: Condition, row: Row) -> bool:
    """Whether Mach number, altitude or lift coefficient are outside the range of the fit."""
    if m.valid_mach[1] == 0.0:
        return False
    airspeed, altitude = x.known.state[0], x.known.altitude
    mach = airspeed / at.sound_speed
    load_factor = row.load_factor_meas if math.isfinite(row.load_factor_meas) else x.demand[1]
    lift = load_factor * m.mass * m.gravity / pressure_area(at, airspeed)
    return bool(
        mach < m.valid_mach[0]
        or mach > m.valid_mach[1]
        or lift < m.valid_lift[0]
        or lift > m.valid_lift[1]
        or altitude < m.valid_altitude[0]
        or altitude > m.valid_altitude[1]
    )
