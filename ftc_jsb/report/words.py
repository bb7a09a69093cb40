"""Names of models, loops and numbers as a reader knows them."""

from typing import NamedTuple

from ftc_jsb.metrics import Metrics
from ftc_jsb.scenario.schema import Scenario

LOOPS = {
    "ftc": "with FTC",
    "no-ftc": "without FTC",
    "oracle": "true effectiveness known",
    "integral": "integral action",
    "ekf": "with FTC (EKF)",
    "path": "path tracking with FTC",
}


class Figure(NamedTuple):
    """A number of the result table."""

    key: str  # in metrics.json
    title: str
    unit: str
    digits: int


FIGURES = (
    Figure("rmse_airspeed_mps", "RMSE airspeed", "m/s", 3),
    Figure("rmse_flight_path_deg", "RMSE flight path", "deg", 4),
    Figure("rmse_heading_deg", "RMSE heading", "deg", 4),
    Figure("peak_error_airspeed_mps", "Peak error airspeed", "m/s", 2),
    Figure("rmse_position_m", "RMSE position", "m", 1),
    Figure("effectiveness_thrust_error_rms", "Effectiveness error RMS", "", 4),
    Figure("effectiveness_thrust_error_max", "Effectiveness error max", "", 4),
    Figure("detection_delay_s", "Detection delay", "s", 2),
    Figure("false_alarms", "False alarms", "", 0),
    Figure("saturated_fraction", "Time at a limit", "%", 1),
    Figure("outside_identified_fraction", "Time outside fitted range", "%", 1),
    Figure("peak_load_factor", "Peak load factor", "", 2),
    Figure("peak_bank_deg", "Peak bank", "deg", 1),
    Figure("peak_sideslip_deg", "Peak sideslip", "deg", 2),
)


def model_title(scenario: Scenario) -> str:
    """Model of a flight, as a heading."""
    aircraft = scenario.aircraft.name.replace("\\", "/").rstrip("/").split("/")[-1]
    if scenario.model == "paper":
        return "Point mass, paper's aircraft"
    if scenario.model == "identified":
        return f"Point mass, identified {aircraft}"
    stock = ", stock controls" if scenario.aircraft.flight_control == "stock" else ""
    return f"JSBSim {aircraft}, 6-DOF{stock}"


def loop_title(scenario: Scenario) -> str:
    """Outer loop of a flight, as a legend entry."""
    return LOOPS.get(scenario.loop.name, scenario.loop.name)


def shown(figure: Figure, metrics: Metrics) -> str:
    """A number of the table as text; a dash where the flight has none."""
    value = metrics[figure.key]
    if value is None:
        return "–"
    if figure.unit == "%":
        value = 100.0 * value
    text = f"{value:.{figure.digits}f}"
    if float(text) == 0.0 and value != 0.0:  # say how small, not that it is nothing
        return f"{value:.1e}"
    return text


def verdict(metrics: Metrics) -> str:
    """How a flight ended, in a few words."""
    if metrics["status"] != "complete":
        return f"{metrics['status']} at {metrics['end_time_s']:.1f} s"
    broken = metrics["limits_broken"]
    if not broken:
        return "inside limits"
    return f"limit broken: {broken[0]['name']} at {broken[0]['time']:.1f} s"
