"""The raw commands of a scenario, (44) for the paper's, sampled over the flight."""

import numpy as np
import numpy.typing as npt

from ftc_jsb.scenario.schema import Reference


def raw_commands(reference: Reference, times: npt.NDArray[np.float64]) -> npt.NDArray[np.float64]:
    """Commands of airspeed [m/s], flight path angle [rad] and heading [rad] before the filter.

    Args:
        reference: breakpoints; linear between, held outside. (44) leaves t = 5 s open, which is
            no matter: both pieces are 0 there.
        times: (rows,) [s].

    Returns:
        (rows, 3).
    """
    columns = [
        np.interp(times, *np.array(points, dtype=float).T)
        for points in (reference.airspeed, reference.flight_path_deg, reference.heading_deg)
    ]
    columns[1:] = [np.radians(column) for column in columns[1:]]
    return np.stack(columns, axis=1)
