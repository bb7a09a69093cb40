"""Drag along a recording as the two models of the outer loop have it: the law's and the estimator's."""

from typing import Any

import numpy as np
import numpy.typing as npt

from ftc_jsb.compiled import compiled
from ftc_jsb.point_mass.drag import measured_drag_coefficient
from ftc_jsb.point_mass.dynamics import polar_drag
from ftc_jsb.point_mass.model import at_condition, pressure_area
from ftc_jsb.vocabulary.kernel_types import Records, Vector

Array = npt.NDArray[np.float64]


def modelled_drag(model: npt.NDArray[Any], record: npt.NDArray[Any]) -> tuple[Array, Array]:
    """Drag [N], (rows,) each: by the polar of the law, and by the estimator's measured angles.

    Args:
        model: (1,) MODEL.
        record: (rows,) of the recording.

    Returns:
        Both; nan where the model or the flight has none.
    """
    polar, measured = np.full(record.size, np.nan), np.full(record.size, np.nan)
    _fill(model, record, polar, measured)
    return polar, measured


@compiled
def _fill(model: Any, record: Records, polar: Vector, measured: Vector) -> None:
    m = model[0]
    for i in range(record.shape[0]):
        row = record[i]
        m.mass = m.mass_start * row.mass / record[0].mass  # the loop follows what is burnt
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
