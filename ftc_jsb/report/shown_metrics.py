"""Which metrics the result tables show: title, unit, digits, and how they are written out."""

from typing import Any, NamedTuple

from ftc_jsb.analysis.metrics import Metrics
from ftc_jsb.vocabulary.quantities import QUANTITIES

STATISTICS = {"rmse": "RMSE", "peak_error": "peak", "peak": "peak"}  # in metrics.json: as shown


class ShownMetric(NamedTuple):
    """A row of the result table."""

    key: str  # in metrics.json
    title: str
    unit: str
    digits: int
    judged: bool = False  # the less the better: best and worst are marked
    scale: float = 1.0  # from metrics.json to the unit
    group: str = ""  # heading that starts here


def _of(
    statistic: str, name: str, digits: int, judged: bool = False, group: str = ""
) -> ShownMetric:
    """A statistic of STATISTICS of one quantity."""
    quantity = QUANTITIES[name]
    title = f"{quantity.short_title}, {STATISTICS[statistic]}"
    return ShownMetric(
        f"{statistic}_{quantity.key}", title, quantity.unit, digits, judged, group=group
    )


def _given_up(name: str) -> ShownMetric:
    quantity = QUANTITIES[name]
    return ShownMetric(f"peak_{quantity.key}", quantity.title, quantity.unit, 2, True)


def _travel(name: str, key: str, digits: int, group: str = "") -> ShownMetric:
    """Mean rate of a command; in metrics.json it is in newtons where the command is a thrust."""
    quantity = QUANTITIES[name]
    scale = quantity.factor if key.endswith("_n_per_s") else 1.0
    title, unit = f"{quantity.title}, mean rate", f"{quantity.unit or '1'}/s"
    return ShownMetric(key, title, unit, digits, True, scale, group)


SHOWN_METRICS = (
    _of("rmse", "airspeed", 3, True, "Tracking error"),
    _of("peak_error", "airspeed", 2, True),
    _of("rmse", "flight_path_angle", 4, True),
    _of("peak_error", "flight_path_angle", 3, True),
    _of("rmse", "heading", 4, True),
    _of("peak_error", "heading", 3, True),
    _of("rmse", "position", 1, True),
    ShownMetric("effectiveness_thrust_error_rms", "Effectiveness error, RMS", "", 4, True, group="Estimate"),
    ShownMetric("effectiveness_thrust_error_max", "Effectiveness error, largest", "", 4, True),
    ShownMetric("detection_delay_s", "Detection delay", "s", 2, True),
    ShownMetric("false_alarms", "False alarms", "", 0, True),
    _travel("thrust_cmd", "thrust_travel_n_per_s", 2, "Control effort"),
    _travel("load_factor_cmd", "load_factor_travel_per_s", 3),
    _travel("bank_angle_cmd", "bank_travel_deg_per_s", 2),
    ShownMetric("saturated_time_s", "Time at a limit of thrust or load factor", "s", 2, True),
    _given_up("climb_given_up"),
    _given_up("turn_given_up"),
    _given_up("airspeed_given_up"),
    ShownMetric("unattainable_fraction", "Time in which references were not attainable", "%", 1, True, 100.0),
    ShownMetric("gain_margin_db", "Gain margin, least input", "dB", 1, group="Margins of the outer loop"),
    ShownMetric("phase_margin_deg", "Phase margin, least input", "deg", 1),
    ShownMetric("delay_margin_s", "Delay margin, least input", "s", 3),
    _of("peak", "load_factor", 2, group="Envelope"),
    _of("peak", "bank_angle", 1),
    _of("peak", "sideslip", 2),
    ShownMetric("outside_identified_fraction", "Time outside the fitted range", "%", 1, scale=100.0),
)  # fmt: skip


def metrics_at_hand(flights: dict[str, Metrics]) -> list[ShownMetric]:
    """The metrics that any of these flights has, each group's heading at its first."""
    rows, heading = [], ""
    for metric in SHOWN_METRICS:
        heading = metric.group or heading
        if any(metrics.get(metric.key) is not None for metrics in flights.values()):
            rows.append(metric._replace(group=heading))
            heading = ""
    return rows


def metric_text(metric: ShownMetric, metrics: Metrics) -> str:
    """A metric of a flight as text; a dash where the flight has none."""
    value = metrics.get(metric.key)
    return number_text(None if value is None else metric.scale * value, metric.digits)


def number_text(value: Any, digits: int, rounded: bool = False) -> str:
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
