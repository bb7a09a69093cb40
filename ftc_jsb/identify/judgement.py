"""Whether an identification is good enough to fly on."""

from typing import Any

# What each figure of [identification] may be at most, and what it is.
LIMITS = {
    "residual_drag_polar_percent": (5.0, "drag for the law, RMS [%]"),
    "residual_drag_angles_percent": (1.0, "drag for the estimator, RMS [%]"),
    "residual_thrust_percent_of_maximum": (2.0, "thrust, RMS [% of maximum]"),
    "residual_fuel_flow_percent": (5.0, "fuel flow, RMS [%]"),
    "residual_load_factor_response": (0.5, "load factor response, RMS [g]"),
    "residual_bank_response_deg": (5.0, "bank response, RMS [deg]"),
    "held_out_beyond_mach_range_percent": (10.0, "held-out samples beyond the Mach range [%]"),
}
NOT_FLOWN = 0.5  # share of the test flights


def shortcomings(identification: dict[str, Any]) -> list[str]:
    """A sentence for each figure that is not good enough; empty if all are.

    Args:
        identification: [identification] of a `point_mass.toml`.
    """
    found = [
        f"{what}: {identification[key]:g} against {limit:g}"
        for key, (limit, what) in LIMITS.items()
        if not identification[key] <= limit
    ]
    without = identification["flights_not_flown"]
    planned = identification["flights"] + identification["flights_held_out"] + without
    if without > NOT_FLOWN * planned:
        found.append(f"test flights that could not be flown: {without} of {planned}")
    return found
