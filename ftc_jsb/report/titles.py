"""Names of aircraft, models, loops, flights and limits as a reader knows them."""

from ftc_jsb.report.flight_groups import Flights, by_scenario
from ftc_jsb.scenario.schema import Scenario

LOOPS = {
    "ftc": "with FTC",
    "no-ftc": "without FTC",
    "oracle": "true effectiveness known",
    "integral": "integral action",
    "ekf": "with FTC (EKF)",
    "path": "path tracking with FTC",
}


WRITTEN = {  # names of shipped aircraft's folders: as people write them
    "f16": "F-16",
    "f15": "F-15",
    "F4N": "F-4N",
    "A4": "A-4",
    "T37": "T-37",
    "T38": "T-38",
}


def aircraft_title(scenario: Scenario) -> str:
    """The aircraft's name as people write it; of one that is not shipped its folder's, without the path."""
    name = scenario.aircraft.name.replace("\\", "/").rstrip("/").split("/")[-1]
    return WRITTEN.get(name, name)


def model_title(scenario: Scenario) -> str:
    """Model of a flight, as a heading."""
    if scenario.model == "paper":
        return "Point mass (paper)"
    if scenario.model == "identified":
        return f"Point mass (identified {aircraft_title(scenario)})"
    stock = ", stock controls" if scenario.aircraft.flight_control == "stock" else ""
    if scenario.model == "flightgear":
        return f"FlightGear {aircraft_title(scenario)}{stock}"
    return f"JSBSim {aircraft_title(scenario)}{stock}"


def loop_title(scenario: Scenario) -> str:
    """Outer loop of a flight, as a legend entry."""
    return LOOPS.get(scenario.loop.name, scenario.loop.name)


def flight_title(scenario: Scenario) -> str:
    """Model and loop of a flight, as the name of a line."""
    return f"{model_title(scenario)}, {loop_title(scenario)}"


def flight_titles(flights: Flights) -> dict[str, str]:
    """Name of each flight on the page: model and loop, the scenario where there are several."""
    groups = by_scenario(flights)
    titles: dict[str, str] = {}
    for name, members in groups.items():
        for label, flight in members.items():
            title = flight_title(flight.scenario)
            titles[label] = f"{name}: {title}" if len(groups) > 1 else title
    names = list(titles.values())
    return {
        label: title if names.count(title) == 1 else f"{title} [{label}]"
        for label, title in titles.items()
    }


def limit_title(name: str) -> str:
    """Key of [limits] as words: `error_airspeed` is the airspeed error."""
    words = name.removesuffix("_deg").split("_")
    return " ".join([*words[1:], "error"] if words[0] == "error" else words)
