"""The proof's quantities along a flown fighter: remainder O of (5)-(7), V and the ball of (37)-(40)."""

import numpy as np
import numpy.typing as npt

from ftc_jsb.recording.flight import Flight
from ftc_jsb.theory.gains import given_gains
from ftc_jsb.theory.generated import generate
from ftc_jsb.theory.linearization import linearize
from ftc_jsb.theory.lyapunov import LyapunovBound, lyapunov_bound
from ftc_jsb.theory.systems import fighter_by_velocity

Array = npt.NDArray[np.float64]
OUTPUTS = ("airspeed", "flight_path_angle", "heading")
SCALE = np.array([1.0, np.radians(1.0), np.radians(1.0)])  # 1 m/s, 1 deg, 1 deg: (40) adds them


def flight_stability(flight: Flight, young: float = 0.5) -> LyapunovBound:
    """V(t), lambda, phi and the ball of (40) along a flight of a loop that tracks velocity.

    The errors are scaled by 1 m/s and 1 deg. What the law did not count on, P x~ and O(.) of the
    proof but also the hold of a sample, the inner loop's lag and limits, is d = y' - y_m' + K e with
    y' by central differences of the true state, so that nothing is left out of the bound.

    Args:
        flight: with the gains of its scenario.
        young: mu_1 as a part of its upper limit.
    """
    record = flight.record
    time = record["time"]
    error = np.stack([record[name] - record[f"{name}_ref"] for name in OUTPUTS], axis=1)
    rate = np.stack([np.gradient(record[name], time) for name in OUTPUTS], axis=1)
    wanted = np.stack([record[f"{name}_ref_rate"] for name in OUTPUTS], axis=1)
    k = np.diag(flight.scenario.loop.gains)
    residual = (rate - wanted) / SCALE + error / SCALE @ k.T
    gains = given_gains(np.zeros((3, 3)), np.eye(3), k)
    return lyapunov_bound(time, error / SCALE, residual, np.eye(3), gains, young)


def flight_remainder(flight: Flight, delay: float | None = None) -> Array:
    """||O(.)|| of (7) along a flight of the paper's aircraft, (rows,), scaled as the errors are.

    Args:
        flight: of the model `paper`.
        delay: use u(t - delay) [s] in place of the trim input, the approximation of [21, 22] that the
            paper improves on; None = the recorded u_n of (10).
    """
    record = flight.record[:-1]
    kernels = generate(linearize(fighter_by_velocity()))
    names = ("thrust", "load_factor", "bank_angle")
    u = np.stack(
        [record["thrust_cmd"], record["load_factor_demand"], record["bank_angle_demand"]], 1
    )
    if delay is None:
        trim = np.stack([record[f"trim_input_{name}"] for name in names], axis=1)
    else:
        steps = max(round(delay / flight.row_period), 1)
        trim = np.concatenate([np.repeat(u[:1], steps, axis=0), u[:-steps]])
    k = np.stack([record[f"effectiveness_{name}"] for name in names], axis=1)
    x = np.stack([record[name] for name in OUTPUTS], axis=1)
    sizes = np.empty(len(record))
    exact, at_trim, gain = np.empty(3), np.empty(3), np.empty((3, 3))
    for i in range(len(record)):
        kernels.dynamics(x[i], u[i], k[i], kernels.parameters, exact)
        kernels.dynamics(x[i], trim[i], k[i], kernels.parameters, at_trim)
        kernels.trim_gain(x[i], trim[i], k[i], kernels.parameters, gain)
        sizes[i] = np.linalg.norm((exact - at_trim - gain @ (u[i] - trim[i])) / SCALE)
    return sizes
