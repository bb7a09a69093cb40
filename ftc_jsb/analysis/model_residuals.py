"""Residual of the drag and thrust models along a flight: what the loop counts on minus what was flown."""

from typing import Any

import numpy as np
import numpy.typing as npt

from ftc_jsb.compiled import compiled
from ftc_jsb.point_mass.drag import measured_drag_coefficient
from ftc_jsb.point_mass.dynamics import polar_drag
from ftc_jsb.point_mass.model import at_condition, pressure_area

Array = npt.NDArray[np.float64]


def model_residuals(
    model: npt.NDArray[Any], record: npt.NDArray[Any]
) -> tuple[Array, Array, Array]:
    """Drag by the polar of the law, drag by the estimator's measured angles, and thrust: [N].

    An error of the drag over the thrust is an error of the estimated effectiveness. The thrust
    residual is expected times true effectiveness minus delivered.

    Args:
        model: (1,) MODEL.
        record: (rows,) of the recording.

    Returns:
        Three arrays (rows,), model minus flight; nan where the model or the flight has none.
    """
    polar, measured = np.full(record.size, np.nan), np.full(record.size, np.nan)
    _drag(model, record, polar, measured)
    if model[0]["spool_up"][0] > 0.0:  # what acted until the row
        effectiveness = np.concatenate(
            [record["effectiveness_thrust"][:1], record["effectiveness_thrust"][:-1]]
        )
        thrust = effectiveness * record["thrust_model"] - record["thrust"]
    else:  # an engine without a spool answers in the same row
        thrust = record["effectiveness_thrust"] * record["thrust_cmd"] - record["thrust"]
    return polar - record["drag"], measured - record["drag"], thrust


@compiled
def _drag(model: Any, record: Any, polar: Any, measured: Any) -> None:
    m = model[0]
    for i in range(record.shape[0]):
        row = record[i]
        at = at_condition(m, row.airspeed, row.altitude)
        polar[i] = polar_drag(at, row.airspeed, row.thrust, row.load_factor)[0]
        if m.measured_mach_count > 0:
            measured[i] = pressure_area(at, row.airspeed) * measured_drag_coefficient(
                m,
                row.airspeed_meas / at.sound_speed,
                row.alpha_meas,
                row.sideslip_meas,
                row.elevator_meas,
                row.flap_meas,
                row.pitch_rate_meas / row.airspeed_meas,
            )
