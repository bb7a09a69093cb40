"""Names of models, loops, faults and verdicts as a reader knows them."""

from ftc_jsb.analysis.metrics import Metrics
from ftc_jsb.analysis.verdict import LOST, reservations
from ftc_jsb.scenario.schema import Scenario
from ftc_jsb.vocabulary.signals import SENSED

LOOPS = {
    "ftc": "with FTC",
    "no-ftc": "without FTC",
    "oracle": "true effectiveness known",
    "integral": "integral action",
    "ekf": "with FTC (EKF)",
    "path": "path tracking with FTC",
}
CHANNEL_TITLES = {"thrust": "Thrust", "load_factor": "Load factor", "bank_angle": "Bank angle"}


def aircraft_title(scenario: Scenario) -> str:
    """The aircraft's name, without its folder."""
    return scenario.aircraft.name.replace("\\", "/").rstrip("/").split("/")[-1]


def model_title(scenario: Scenario) -> str:
    """Model of a flight, as a heading."""
    if scenario.model == "paper":
        return "Point mass (paper)"
    if scenario.model == "identified":
        return f"Point mass (identified {aircraft_title(scenario)})"
    stock = ", stock controls" if scenario.aircraft.flight_control == "stock" else ""
    return f"JSBSim {aircraft_title(scenario)}{stock}"


def loop_title(scenario: Scenario) -> str:
    """Outer loop of a flight, as a legend entry."""
    return LOOPS.get(scenario.loop.name, scenario.loop.name)


def flight_title(scenario: Scenario) -> str:
    """Model and loop of a flight, as the name of a line."""
    return f"{model_title(scenario)}, {loop_title(scenario)}"


def limit_title(name: str) -> str:
    """Key of [limits] as words: `error_airspeed` is the airspeed error."""
    words = name.removesuffix("_deg").split("_")
    return " ".join([*words[1:], "error"] if words[0] == "error" else words)


def fault_sentences(scenario: Scenario) -> list[str]:
    """What each fault of a scenario does and when, from the keys of the file."""
    sentences = []
    for fault in scenario.fault:
        keys = fault.model_dump(mode="json", exclude_none=True)
        target, kind = str(keys.pop("target")), str(keys.pop("kind")).replace("-", " ")
        start, end = keys.pop("start", None), keys.pop("end", None)
        when = f" from {start:g} s" if start is not None else ""
        when += f" to {end:g} s" if end is not None else ""
        how = ", ".join(
            str(value) if key == "shape" else f"{key.replace('_', ' ')} {value}"
            for key, value in keys.items()
            if (key, value) != ("shape", "step")
        )
        name = target.replace("_", " ").capitalize()
        sentences.append(f"{name}: {kind}{when}" + (f" ({how})" if how else ""))
    return sentences


def air_and_sensors(scenario: Scenario) -> list[str]:
    """Wind and sensors, where they are not still air and perfect ones."""
    facts = []
    wind, sensors = scenario.wind, scenario.sensors
    if wind.speed > 0.0:
        facts.append(f"Wind {wind.speed:g} m/s from {wind.from_deg:g}°")
    if wind.turbulence != "none":
        facts.append(f"{wind.turbulence.capitalize()} turbulence")
    if wind.gust:
        facts.append("Gusts")
    own = any(getattr(sensors, name) is not None for name in SENSED)
    if sensors.profile != "perfect" or own:
        facts.append(f"{sensors.profile.capitalize()} sensors{', changed' if own else ''}")
    return facts


def verdict(metrics: Metrics) -> str:
    """How a flight ended, and what else is to be said of it, in a few words."""
    found = str(metrics["verdict"])
    broken = metrics["limits_broken"]
    if metrics["status"] != "complete":
        found = f"{metrics['status']} at {metrics['end_time_s']:.1f} s"
    elif found == LOST:
        found = (
            f"{LOST}: {metrics['loss_of_control']} from {metrics['loss_of_control_time_s']:.1f} s"
        )
    elif broken:
        found = f"limit broken: {limit_title(broken[0]['name'])} at {broken[0]['time']:.1f} s"
    return "; ".join([found, *(said.text(metrics) for said in reservations(metrics))])
