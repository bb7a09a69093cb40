"""The closed inner loop as the point mass knows it: a second-order lag with limits."""

from ftc_jsb.compiled import compiled, inlined


@inlined
def lag_acceleration(
    value: float, rate: float, command: float, frequency: float, damping: float, most: float
) -> float:
    """Second derivative of w^2 / (s^2 + 2 z w s + w^2) at a command, within `most` (0 = no limit)."""
    wanted = frequency * (frequency * (command - value) - 2.0 * damping * rate)
    return min(max(wanted, -most), most) if most > 0.0 else wanted


@compiled
def lag_step(
    value: float,
    rate: float,
    command: float,
    frequency: float,
    damping: float,
    rate_max: float,
    acceleration_max: float,
    dt: float,
) -> tuple[float, float]:
    """Value and rate after a midpoint step of w^2 / (s^2 + 2 z w s + w^2) at a held command.

    Args:
        value, rate: now, in the command's unit and that per second.
        command: held over the step.
        frequency: w [rad/s].
        damping: z.
        rate_max, acceleration_max: limits; 0 = none.
        dt: [s].
    """
    first = lag_acceleration(value, rate, command, frequency, damping, acceleration_max)
    middle_value, middle_rate = value + 0.5 * dt * rate, rate + 0.5 * dt * first
    second = lag_acceleration(
        middle_value, middle_rate, command, frequency, damping, acceleration_max
    )
    following = rate + dt * second
    if rate_max > 0.0:
        following = min(max(following, -rate_max), rate_max)
    return value + dt * middle_rate, following
