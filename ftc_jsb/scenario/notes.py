"""What is allowed in a scenario but seldom meant."""

from ftc_jsb.scenario.schema import Scenario


def notes(scenario: Scenario) -> list[str]:
    """A sentence for each thing that a reader of the scenario would ask about."""
    found = []
    for key, start, unit in (
        ("airspeed", scenario.initial.airspeed, "m/s"),
        ("flight_path_deg", scenario.initial.flight_path_deg, "deg"),
        ("heading_deg", scenario.initial.heading_deg, "deg"),
    ):
        points = getattr(scenario.reference, key)
        wanted = start if points is None else points[0][1]
        if wanted != start:
            found.append(
                f"reference.{key} starts at {wanted:g} {unit}, initial.{key} is {start:g}: "
                "the flight begins with that error"
            )
    for index, fault in enumerate(scenario.fault):
        if fault.start >= scenario.duration:
            found.append(
                f"fault[{index}] starts at {fault.start:g} s, after the flight of "
                f"{scenario.duration:g} s has ended"
            )
    return found
