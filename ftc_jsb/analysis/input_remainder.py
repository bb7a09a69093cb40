"""The remainder O(.) of (5)-(7) along a flight of the paper's aircraft: what a trim input leaves out."""

import numpy as np
import numpy.typing as npt

from ftc_jsb.analysis.lyapunov_bound import ERROR_SCALE
from ftc_jsb.recording.flight import Flight
from ftc_jsb.theory.generated import generate
from ftc_jsb.theory.linearization import linearize
from ftc_jsb.theory.systems import fighter_by_velocity
from ftc_jsb.vocabulary.channels import CHANNELS, TRACKED

Array = npt.NDArray[np.float64]


def flight_remainder(flight: Flight, delay: float | None = None) -> Array:
    """||O(.)|| of (7) along a flight of the paper's aircraft, (rows,), scaled as the errors are.

    Args:
        flight: of the model `paper`.
        delay: use u(t - delay) [s] in place of the trim input, the approximation of [21, 22] that the
            paper improves on; None = the recorded u_n of (10).
    """
    record = flight.record[:-1]
    kernels = generate(linearize(fighter_by_velocity()))
    u = np.stack(
        [record["thrust_cmd"], record["load_factor_demand"], record["bank_angle_demand"]], 1
    )
    if delay is None:
        trim = np.stack([record[f"trim_input_{name}"] for name in CHANNELS], axis=1)
    else:
        steps = max(round(delay / flight.row_period), 1)
        trim = np.concatenate([np.repeat(u[:1], steps, axis=0), u[:-steps]])
    k = np.stack([record[f"effectiveness_{name}"] for name in CHANNELS], axis=1)
    x = np.stack([record[name] for name in TRACKED], axis=1)
    sizes = np.empty(len(record))
    exact, at_trim, gain = np.empty(3), np.empty(3), np.empty((3, 3))
    for i in range(len(record)):
        kernels.dynamics(x[i], u[i], k[i], kernels.parameters, exact)
        kernels.dynamics(x[i], trim[i], k[i], kernels.parameters, at_trim)
        kernels.trim_gain(x[i], trim[i], k[i], kernels.parameters, gain)
        sizes[i] = np.linalg.norm((exact - at_trim - gain @ (u[i] - trim[i])) / ERROR_SCALE)
    return sizes
