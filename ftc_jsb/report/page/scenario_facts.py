"""What a scenario asks for, in sentences: its faults, its air, its sensors."""

from ftc_jsb.scenario.schema import Scenario
from ftc_jsb.vocabulary.signals import SENSED


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
