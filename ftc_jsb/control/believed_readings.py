"""Which readings the loop believes: the isolation between the recording and the outer loop."""

import math
from typing import Any

from ftc_jsb.compiled import compiled
from ftc_jsb.estimation.process import place_of_channel
from ftc_jsb.frames import measure_path
from ftc_jsb.isolation.isolate import (
    confirm_thrust,
    isolate,
    restart_isolation,
    start_isolation,
)
from ftc_jsb.isolation.records import ACCEPTED, COUNT, SURFACE_COUNT, THRUST_ROW
from ftc_jsb.isolation.redundancy import ELEVATOR, LOAD_X, LOAD_Z, PITCH_RATE
from ftc_jsb.point_mass.model import at_condition
from ftc_jsb.vocabulary.channels import THRUST
from ftc_jsb.vocabulary.hypotheses import FIRST_INSTRUMENT, FIRST_SURFACE, THRUST_LOSS
from ftc_jsb.vocabulary.kernel_types import (
    IsolationState,
    LoopSettings,
    LoopState,
    ModelRecord,
    Row,
    Vector,
)

LIKELY = 4.0  # log likelihood ratio of an instrument that may be what a loss of thrust seems to be
LONGEST = 0.06  # [s] between samples; after longer ones the comparison begins anew
SPOILT = 0.1  # of the effectiveness: standard deviation of what a wrong instrument has left behind


@compiled
def isolate_if_asked(
    isolates: bool | None, s: LoopSettings, m: ModelRecord, x: LoopState, row: Row, i: int
) -> None:
    """`isolate_faults`, where the settings ask for it.

    Numba drops what a None guards before it compiles it: of the time that a flight's kernels take to be
    compiled, isolation is two fifths.
    """
    if isolates is None:
        return
    if s.isolation.enabled == 1:
        isolate_faults(s, m, x, row, i)


@compiled
def isolate_faults(s: LoopSettings, m: ModelRecord, x: LoopState, row: Row, i: int) -> None:
    """Replace the readings of row `i` that cannot be believed, and say whose fault it is.

    Args:
        s, m, x: settings, model and state of the loop.
        row: row `i` of the recording; its readings (`_meas`) are those of the instruments, and afterwards
            what the loop and the inner loop are given.
        i: row; 0 starts.
    """
    iso = x.isolation
    raw = iso.raw
    _read(row, raw)
    iso.commanded[0], iso.commanded[1], iso.commanded[2] = (
        row.elevator_cmd, row.aileron_cmd, row.rudder_cmd,
    )  # fmt: skip
    if i == 0:
        start_isolation(iso, raw)
        iso.flies = 1 if math.isfinite(raw[PITCH_RATE]) or math.isfinite(raw[ELEVATOR]) else 0
    elif iso.flies == 1 and s.dt > LONGEST:
        restart_isolation(iso, raw)
    elif iso.flies == 1:
        at = at_condition(m, x.known.state[0], x.known.altitude)
        f = x.observer.filter
        place = place_of_channel(f, THRUST)
        estimate = f.estimate[place] if place >= 0 else 1.0
        confirm_thrust(iso, estimate, s.dt)
        thrust = x.observer.thrust * iso.effectiveness
        doubt = x.observer.thrust_doubt * iso.effectiveness
        isolate(s.isolation, m, at, iso, raw, thrust, doubt, estimate, s.dt)
        if math.isfinite(iso.before) and place >= 0:
            f.estimate[place] = iso.before
            f.covariance[place, place] += SPOILT**2
        iso.before = math.nan
        if _any_excluded(iso):
            _write(iso.signals, row)
            measure_path(row)
            if iso.wait > 0.0 and _load_excluded(iso):  # its error is not known yet
                row.acceleration_meas = math.nan
    if iso.flies == 0:  # a point mass has no gyros and no surfaces to compare with
        return
    row.suspect, row.suspect_probability = iso.suspect, iso.probability
    row.isolation_statistic = iso.statistic
    for j in range(SURFACE_COUNT):
        told = iso.surfaces[j].statistic / s.isolation.threshold
        row.isolation_statistic = max(row.isolation_statistic, told)
    bits = 0
    for k in range(COUNT):
        if iso.excluded[k] != ACCEPTED:
            bits += 1 << k
    row.excluded = bits


@compiled
def _any_excluded(iso: IsolationState) -> bool:
    for k in range(COUNT):
        if iso.excluded[k] != ACCEPTED:
            return True
    return False


@compiled
def _load_excluded(iso: IsolationState) -> bool:
    for k in range(LOAD_X, LOAD_Z + 1):
        if iso.excluded[k] != ACCEPTED:
            return True
    return False


@compiled
def believe_isolation(iso: IsolationState, detector: Any, row: Row) -> None:
    """The detector of thrust believes the isolation, where there is one.

    A loss that the isolation is sure of is declared at once; while an instrument is suspect, or the estimate
    recovers from it, the estimate's own statistic tells nothing.
    """
    if iso.flies == 0:
        return
    if iso.suspect == THRUST_LOSS and iso.statistic > 1.0 and iso.thrust == 1:
        detector.declared, detector.elapsed = 1, 0.0
    instrument = FIRST_INSTRUMENT <= iso.suspect < FIRST_SURFACE and iso.statistic > 1.0
    if (instrument or iso.quiet > 0.0) and iso.thrust == 0:
        detector.declared, detector.elapsed = 0, 0.0
    if iso.thrust == 0 and detector.declared == 1 and _instrument_leads(iso):
        detector.declared, detector.elapsed = 0, 0.0
    iso.thrust = detector.declared


@compiled
def _instrument_leads(iso: IsolationState) -> bool:
    """Whether an instrument, though not yet suspect, explains more than lost thrust does.

    A slow drift of the pitot spoils the effectiveness before it stands out.
    """
    if iso.suspect == THRUST_LOSS:
        return False
    leading = 0.0
    for row in range(COUNT):
        leading = max(leading, iso.likelihood[row])
    return bool(leading > max(LIKELY, iso.likelihood[THRUST_ROW]))


@compiled
def _read(row: Row, out: Vector) -> None:
    """Readings of a row, in the order of SIGNALS."""
    out[0] = row.airspeed_meas
    out[1] = row.altitude_meas
    out[2] = row.alpha_meas
    out[3] = row.sideslip_meas
    out[4] = row.roll_meas
    out[5] = row.pitch_meas
    out[6] = row.yaw_meas
    out[7] = row.roll_rate_meas
    out[8] = row.pitch_rate_meas
    out[9] = row.yaw_rate_meas
    out[10] = row.load_factor_x_meas
    out[11] = row.load_factor_y_meas
    out[12] = row.load_factor_z_meas
    out[13] = row.north_meas
    out[14] = row.east_meas
    out[15] = row.elevator_meas
    out[16] = row.flap_meas
    out[17] = row.aileron_meas
    out[18] = row.rudder_meas


@compiled
def _write(signals: Vector, row: Row) -> None:
    """Believed signals, in the order of SIGNALS, to a row."""
    row.airspeed_meas = signals[0]
    row.altitude_meas = signals[1]
    row.alpha_meas = signals[2]
    row.sideslip_meas = signals[3]
    row.roll_meas = signals[4]
    row.pitch_meas = signals[5]
    row.yaw_meas = signals[6]
    row.roll_rate_meas = signals[7]
    row.pitch_rate_meas = signals[8]
    row.yaw_rate_meas = signals[9]
    row.load_factor_x_meas = signals[10]
    row.load_factor_y_meas = signals[11]
    row.load_factor_z_meas = signals[12]
    row.north_meas = signals[13]
    row.east_meas = signals[14]
    row.elevator_meas = signals[15]
    row.flap_meas = signals[16]
    row.aileron_meas = signals[17]
    row.rudder_meas = signals[18]
