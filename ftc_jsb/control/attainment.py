"""Whether the references can be flown at all, so that it is said where they cannot."""

from ftc_jsb.compiled import compiled
from ftc_jsb.control.decision import Errors
from ftc_jsb.control.law import Rates
from ftc_jsb.vocabulary.kernel_types import LoopSettings, LoopState, Row

PATH_RATE = 2e-3  # [rad/s] that protections change of a wanted rate, and nobody minds
ACCELERATION = 0.1  # [m/s^2], likewise
SHORT = 0.5  # [m/s] of airspeed error at the thrust's limit
LASTING = 1.0  # [s] that it must last before it is said


@compiled
def record_attainment(
    s: LoopSettings, x: LoopState, row: Row, errors: Errors, asked: Rates, allowed: Rates
) -> None:
    """Write `unattainable`: 1 while thrust or envelope have kept the aircraft from its references for 1 s.

    Args:
        s, x, row: settings and state of the loop, row of the recording, its thrust command limited already.
        errors: of tracking.
        asked: rates by references and errors.
        allowed: what priority and envelope have made of them.
    """
    short = (
        abs(asked.flight_path_angle - allowed.flight_path_angle) > PATH_RATE
        or abs(asked.heading - allowed.heading) > PATH_RATE
        or abs(asked.airspeed - allowed.airspeed) > ACCELERATION
        or (row.thrust_saturated == 1.0 and abs(errors.airspeed) > SHORT)
    )
    x.short_time = x.short_time + s.dt if short else 0.0
    row.unattainable = 1.0 if x.short_time > LASTING else 0.0
