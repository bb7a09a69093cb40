"""What errors of the instruments do to the force along the velocity, and so to the effectiveness of thrust.

The innovation of that force, measured less k T cos(alpha) - D over the mass, is wrong by the accelerometer's
error, by that of alpha, which turns the load factor into it and makes drag, and by that of sideslip, which
makes drag. Noise adds to R. Biases are considered, not estimated (Schmidt 1966): the steady filter takes them
over whole, so that what they do to the effectiveness adds to its standard deviation.
"""

import math

from ftc_jsb.compiled import compiled
from ftc_jsb.point_mass.drag import measured_drag_coefficient
from ftc_jsb.point_mass.dynamics import polar_drag
from ftc_jsb.point_mass.model import Condition, pressure_area
from ftc_jsb.units import STANDARD_GRAVITY
from ftc_jsb.vocabulary.kernel_types import LoopSettings, LoopState, ModelRecord, Observer, Row

STEP = math.radians(0.2)  # [rad], of the differences
FASTER = 2.0  # [m/s], likewise
LEAST_THRUST = 0.02  # of the weight: below, thrust tells nothing
BLIND = 10.0  # standard deviation of an effectiveness that nothing is known of
BLIND_FROM = 0.5  # considered standard deviation from which on the estimate is held
MODEL_DOUBT = 0.003  # of the drag: what the fits leave on flights they have not seen
LAG = 0.5  # [s], of the sensitivities: vanes are noisy
WINDOW = 10.0  # [s], over which innovations are averaged
LARGEST = 3.0  # [sigma]
CORRELATION_MAX = 0.9
ANGLES = 4
ALPHA, SIDESLIP, ELEVATOR, FLAP, AIRSPEED, NOTHING = range(6)  # what may be moved


@compiled
def drag_coefficient_measured(
    m: ModelRecord, x: LoopState, at: Condition, row: Row, moved: int, step: float
) -> float:
    """Drag coefficient of the measured angles, surfaces and pitch rate; nan where there is none.

    Args:
        m, x, at, row: model, state of the loop, model at this condition, row of the recording.
        moved: the measurement that `step` is added to: alpha, the magnitude of sideslip, elevator, flap
            [rad], airspeed [m/s]; NOTHING.
        step: as above.
    """
    if m.measured_mach_count == 0:
        return math.nan
    airspeed = x.known.state[0] + (step if moved == AIRSPEED else 0.0)
    return measured_drag_coefficient(
        m,
        airspeed / at.sound_speed,
        row.alpha_meas + (step if moved == ALPHA else 0.0),
        abs(row.sideslip_meas) + (step if moved == SIDESLIP else 0.0),
        row.elevator_meas + (step if moved == ELEVATOR else 0.0),
        row.flap_meas + (step if moved == FLAP else 0.0),
        row.pitch_rate_meas / airspeed,
    )


@compiled
def consider_instruments(
    s: LoopSettings, m: ModelRecord, x: LoopState, at: Condition, row: Row, slope: float
) -> None:
    """R of this sample, and the considered standard deviation of the effectiveness.

    Args:
        s, m, x, at, row: settings, model and state of the loop, model at this condition, row of the recording.
        slope: of the force along the velocity over mass, per effectiveness [m/s^2].
    """
    o = x.observer
    airspeed = o.filter.estimate[0]
    per_coefficient = pressure_area(at, airspeed) / m.mass
    drag = drag_coefficient_measured(m, x, at, row, NOTHING, 0.0)
    rise = drag_coefficient_measured(m, x, at, row, AIRSPEED, FASTER) - drag
    measured = math.isfinite(drag)
    if not measured:  # the polar's, which no angle changes
        polar = polar_drag(at, airspeed, o.thrust, row.load_factor_meas)[0]
        drag, rise = polar / pressure_area(at, airspeed), 0.0
    to_airspeed = per_coefficient * (2.0 * drag / airspeed + rise / FASTER)
    noise = s.acceleration_noise + to_airspeed**2 * s.measurement_noise[0]
    square = s.acceleration_bias**2 + (to_airspeed * s.airspeed_bias) ** 2
    square += (MODEL_DOUBT * per_coefficient * drag) ** 2
    for angle in range(ANGLES):
        to_angle = 0.0
        if measured:
            moved = drag_coefficient_measured(m, x, at, row, angle, STEP)
            to_angle = per_coefficient * (moved - drag) / STEP
        if angle == ALPHA:
            to_angle -= STANDARD_GRAVITY * row.load_factor_meas
        noise += to_angle**2 * s.angle_noise[angle]
        square += (to_angle * s.angle_bias[angle]) ** 2
    if not math.isfinite(noise + square):  # a silent instrument
        return
    doubt = o.thrust_doubt / m.mass  # of a spooling engine, which passes: R has it
    o.blind = 1 if math.hypot(math.sqrt(square), doubt) > BLIND_FROM * abs(slope) else 0
    share = 1.0 - math.exp(-s.dt / LAG)
    o.acceleration_noise += share * (noise - o.acceleration_noise)
    if abs(slope) > LEAST_THRUST * m.gravity:
        considered = min(math.sqrt(square) / abs(slope), BLIND)
        o.considered += share * (considered - o.considered)


@compiled
def noise_as_seen(o: Observer, innovation: float, variance: float, dt: float) -> float:
    """R of the force along the velocity, larger where its innovations are: by their power and correlation.

    Gusts turn and delay what the vanes tell, models leave something out: more than R knows, and not white.
    Noise of power p and correlation r from one sample to the next averages out as slowly as white noise of
    variance p (1 + r) / (1 - r). A single jump, such as a loss, is counted as 3 sigma at most.

    Args:
        o: state of the observer, advanced.
        innovation: [m/s^2].
        variance: of the innovation, as R and the filter have it [m^2/s^4].
        dt: sample time [s].
    """
    normalised = min(max(innovation / math.sqrt(variance), -LARGEST), LARGEST)
    share = 1.0 - math.exp(-dt / WINDOW)
    o.power += share * (normalised * normalised - o.power)
    o.product += share * (normalised * o.last - o.product)
    o.last = normalised
    correlation = min(max(o.product / max(o.power, 1e-6), 0.0), CORRELATION_MAX)
    slower = (1.0 + correlation) / (1.0 - correlation)
    return float(o.acceleration_noise * max(o.power, 1.0) * slower)
