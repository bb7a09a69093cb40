"""The numbers of the result table: title, unit, digits, and how they are written out."""

from typing import Any, NamedTuple

from ftc_jsb.analysis.metrics import Metrics


class Number(NamedTuple):
    """A row of the result table."""

    key: str  # in metrics.json
    title: str
    unit: str
    digits: int
    judged: bool = False  # the less the better: best and worst are marked
    scale: float = 1.0  # from metrics.json to the unit
    group: str = ""  # heading that starts here


NUMBERS = (
    Number("rmse_airspeed_mps", "Airspeed, RMSE", "m/s", 3, True, group="Tracking error"),
    Number("peak_error_airspeed_mps", "Airspeed, peak", "m/s", 2, True),
    Number("rmse_flight_path_deg", "Flight path, RMSE", "deg", 4, True),
    Number("peak_error_flight_path_deg", "Flight path, peak", "deg", 3, True),
    Number("rmse_heading_deg", "Heading, RMSE", "deg", 4, True),
    Number("peak_error_heading_deg", "Heading, peak", "deg", 3, True),
    Number("rmse_position_m", "Position, RMSE", "m", 1, True),
    Number(
        "effectiveness_thrust_error_rms", "Effectiveness error, RMS", "", 4, True, group="Estimate"
    ),
    Number("effectiveness_thrust_error_max", "Effectiveness error, largest", "", 4, True),
    Number("detection_delay_s", "Detection delay", "s", 2, True),
    Number("false_alarms", "False alarms", "", 0, True),
    Number(
        "thrust_travel_n_per_s",
        "Thrust command, mean rate",
        "kN/s",
        2,
        True,
        1e-3,
        "Control effort",
    ),
    Number("load_factor_travel_per_s", "Load factor command, mean rate", "1/s", 3, True),
    Number("bank_travel_deg_per_s", "Bank command, mean rate", "deg/s", 2, True),
    Number("saturated_time_s", "Time at a limit of thrust or load factor", "s", 2, True),
    Number("peak_climb_given_up_deg", "Climb given up for want of thrust", "deg", 2, True),
    Number("peak_turn_given_up_deg_s", "Turn given up for want of thrust", "deg/s", 2, True),
    Number(
        "gain_margin_db", "Gain margin, least input", "dB", 1, group="Margins of the outer loop"
    ),
    Number("phase_margin_deg", "Phase margin, least input", "deg", 1),
    Number("delay_margin_s", "Delay margin, least input", "s", 3),
    Number("peak_load_factor", "Load factor, peak", "", 2, group="Envelope"),
    Number("peak_bank_deg", "Bank, peak", "deg", 1),
    Number("peak_sideslip_deg", "Sideslip, peak", "deg", 2),
    Number("outside_identified_fraction", "Time outside the fitted range", "%", 1, scale=100.0),
)


def present(flights: dict[str, Metrics]) -> list[Number]:
    """The numbers that any of these flights has, each group's heading at its first."""
    rows, heading = [], ""
    for number in NUMBERS:
        heading = number.group or heading
        if any(metrics.get(number.key) is not None for metrics in flights.values()):
            rows.append(number._replace(group=heading))
            heading = ""
    return rows


def shown(number: Number, metrics: Metrics) -> str:
    """A number of the table as text; a dash where the flight has none."""
    value = metrics.get(number.key)
    return written(None if value is None else number.scale * value, number.digits)


def written(value: Any, digits: int, rounded: bool = False) -> str:
    """A number with so many decimals, or how small it is where that would say nothing.

    Args:
        value: None is unknown, a dash.
        digits: after the point.
        rounded: let a small number be written as zero.
    """
    if value is None:
        return "–"
    text = f"{value:.{digits}f}"
    if float(text) == 0.0 and value != 0.0 and not rounded:
        return f"{value:.1e}"
    return text
