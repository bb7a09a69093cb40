"""What the loop knows of the aircraft's state: what is measured, or what stands in for a silent sensor."""

import math

from ftc_jsb.compiled import compiled
from ftc_jsb.control.records import NO_ESTIMATOR
from ftc_jsb.estimation.process import OUTPUTS
from ftc_jsb.vocabulary.kernel_types import LoopSettings, LoopState, Row


@compiled
def update_known_state(s: LoopSettings, x: LoopState, row: Row, i: int) -> None:
    """Take the measurements of row `i`; where a sensor is silent, the filter's estimate or what was last known.

    At the start that is the reference, which begins at the initial condition.
    """
    known = x.known
    known.measurement[0] = row.airspeed_meas
    known.measurement[1] = row.flight_path_angle_meas
    known.measurement[2] = row.heading_meas
    if i == 0:
        known.state[0] = row.airspeed_ref
        known.state[1] = row.flight_path_angle_ref
        known.state[2] = row.heading_ref
        known.position[0], known.position[1] = row.north_ref, row.east_ref
        known.altitude = row.altitude_ref
    for k in range(OUTPUTS):
        if math.isfinite(known.measurement[k]):
            known.state[k] = known.measurement[k]
        elif s.estimator != NO_ESTIMATOR and i > 0:
            known.state[k] = x.observer.filter.estimate[k]
    if math.isfinite(row.north_meas):
        known.position[0] = row.north_meas
    if math.isfinite(row.east_meas):
        known.position[1] = row.east_meas
    if math.isfinite(row.altitude_meas):
        known.altitude = row.altitude_meas
