"""The unscented Kalman filter (22)-(34) literally: the reference form that the flying one is tested by."""

from collections.abc import Callable

import numpy as np
import numpy.typing as npt

Array = npt.NDArray[np.float64]


def augmented_step(
    process: Callable[[Array], Array],
    observe: Callable[[Array], Array],
    x: Array,
    p: Array,
    noise: Array,
    y: Array,
    kappa: float | None = None,
) -> tuple[Array, Array]:
    """One prediction and correction with the augmented vector [x, v, xi].

    Args:
        process: f of (21) over one sample, (n,) to (n,).
        observe: h of (21), (n,) to (m,).
        x, p: estimate (n,) and covariance (n, n) at k-1.
        noise: (n + m, n + m), joint covariance of process and measurement noise, [Q, P_vxi; P_xiv, R].
        y: (m,), the measurement at k.
        kappa: of (26); 3 - n_a if not given.

    Returns:
        Estimate and covariance at k.
    """
    n, m = len(x), len(y)
    na = 2 * n + m
    spread = 3.0 if kappa is None else na + kappa
    xa = np.concatenate([x, np.zeros(n + m)])  # (22), (23)
    pa = np.zeros((na, na))  # (25)
    pa[:n, :n], pa[n:, n:] = p, noise
    root = np.linalg.cholesky(spread * pa)
    points = np.column_stack([xa, xa[:, None] + root, xa[:, None] - root])  # (26)
    weights = np.full(2 * na + 1, 0.5 / spread)  # (29)
    weights[0] = 1.0 - na / spread
    chi = np.stack([process(a[:n]) + a[n : 2 * n] for a in points.T], axis=1)  # (27)
    mean = chi[:, 0] + (chi - chi[:, :1]) @ weights  # (28)
    away = chi - mean[:, None]
    predicted = (away * weights) @ away.T  # (30)
    # (31), with the index and the measurement noise that it lacks in print
    seen = np.stack([observe(c) for c in chi.T], axis=1) + points[2 * n :]
    output = seen[:, 0] + (seen - seen[:, :1]) @ weights  # (32)
    off = seen - output[:, None]
    pyy = (off * weights) @ off.T  # (33)
    pxy = (away * weights) @ off.T
    gain = np.linalg.solve(pyy.T, pxy.T).T
    return mean + gain @ (y - output), predicted - gain @ pyy @ gain.T  # (34)
