"""Cosine and sine of an angle that has moved a little: most of what a flight asks for.

Between the stages of a Runge-Kutta step, and from one sigma point to the next, angles move by less
than a degree. The addition theorems then cost a third of a new sine and cosine.
"""

import math

from ftc_jsb.compiled import inlined

LITTLE = 0.03  # [rad]: below, the series leave less than 2e-17


@inlined
def turned(cosine: float, sine: float, angle: float) -> tuple[float, float]:
    """Cosine and sine of an angle whose cosine and sine are given, plus `angle` [rad].

    Equal to `math.cos` and `math.sin` of the sum within rounding, whatever `angle` is.
    """
    if abs(angle) < LITTLE:
        square = angle * angle
        s = angle * (1.0 - square * (1 / 6) * (1.0 - square * (1 / 20) * (1.0 - square * (1 / 42))))
        c = 1.0 - square * (1 / 2) * (1.0 - square * (1 / 12) * (1.0 - square * (1 / 30)))
    else:
        s, c = math.sin(angle), math.cos(angle)
    return cosine * c - sine * s, sine * c + cosine * s
