"""The five fighters: the speed that their thrust can pay for, their scenarios, and their tables.

`python -m validation.fighters speeds` finds the speeds, `scenarios` writes the scenario files
from them, `table` prints what the flights gave.
"""

import sys
from collections.abc import Iterator, Sequence
from pathlib import Path
from typing import Any

import numpy as np

from ftc_jsb.analysis.metrics import flight_metrics
from ftc_jsb.recording.flight import Flight
from ftc_jsb.scenario.load import load_scenario
from ftc_jsb.simulation.fly import fly

SCENARIOS = {"f16": "paper", "f15": "f15", "F4N": "f4n", "A4": "a4", "T38": "t38"}
LEFT = 0.6  # effectiveness after the fault
ALTITUDE = 3048.0  # [m]
RESERVE = 1.15  # of the thrust needed
SPEEDS = range(300, 189, -5)  # [m/s], not below what inner loops are designed for
SCALES = (1.0, 0.9, 0.8, 0.7, 0.6, 0.5, 0.4, 0.3)  # of the manoeuvre's angles
PATH = ((0, 0), (15, 0), (25, 5), (35, 5), (45, 0))  # (44): time [s], angle [deg]
HEADING = ((0, 0), (5, 0), (10, 30), (20, 30), (30, -30), (40, -30), (45, 0))


def manoeuvre(name: str, airspeed: float, scale: float, altitude: float = ALTITUDE) -> list[str]:
    """Overrides that make the paper's manoeuvre one of an aircraft, at a speed [m/s] and scaled."""
    path = [[time, round(scale * angle, 3)] for time, angle in PATH]
    heading = [[time, round(scale * angle, 3)] for time, angle in HEADING]
    return [
        f"aircraft.name='{name}'",
        f"initial.altitude={altitude}",
        f"initial.airspeed={airspeed}",
        f"reference.airspeed=[[0, {airspeed}]]",
        f"reference.flight_path_deg={path}",
        f"reference.heading_deg={heading}",
    ]


def thrust_share(name: str, airspeed: float, scale: float, model: str, altitude: float) -> float:
    """Largest part of the maximum thrust that the fault-free manoeuvre takes on `model`."""
    changes = [f"model={model}", *manoeuvre(name, airspeed, scale, altitude)]
    flight = fly(load_scenario("nominal", changes))
    if flight.outcome.status != "complete":
        return float("inf")
    row = flight.record[100:-1]  # after the first second, of which the start is a part
    if row["thrust_saturated"].any():
        return float("inf")
    return float(np.max(row["thrust_cmd"] / maximum_thrust(name, row)))


def maximum_thrust(name: str, rows: Any) -> Any:
    """Maximum thrust [N] of a healthy aircraft at the Mach number and altitude of recorded rows."""
    from ftc_jsb.aircraft.point_mass_file import load_point_mass
    from ftc_jsb.point_mass.model import at_condition
    from ftc_jsb.resources import aircraft_folder

    model = load_point_mass(aircraft_folder(name)).record(0.43)
    return np.array(
        [
            at_condition(model[0], float(row["airspeed"]), float(row["altitude"])).thrust_maximum
            for row in rows
        ]
    )


def highest_speed(
    name: str,
    speeds: Sequence[int] = SPEEDS,
    scales: Sequence[float] = SCALES,
    altitude: float = ALTITUDE,
) -> tuple[float, float, float]:
    """Speed [m/s], scale and share of maximum thrust of the paper's manoeuvre for an aircraft.

    The highest speed up to 300 m/s at which what the fault leaves is at least RESERVE times the
    thrust needed, all along the manoeuvre; where no speed does, the angles are scaled down first.
    What is needed is flown on JSBSim, sideslip in rolls and all; the point mass, which needs less,
    only rules out what is far off.
    """
    for scale in scales:
        for airspeed in speeds:
            if RESERVE * thrust_share(name, airspeed, scale, "identified", altitude) > LEFT:
                continue
            share = thrust_share(name, airspeed, scale, "jsbsim", altitude)
            if RESERVE * share <= LEFT:
                return float(airspeed), scale, share
    raise ValueError(f"{name}: no speed and no scale down to {scales[-1]}")


TITLES = {"f15": "F-15", "F4N": "F-4N", "A4": "A-4", "T38": "T-38"}


def write_scenarios(folder: Path) -> Iterator[str]:
    """Write the scenario of each fighter but the F-16, which flies `paper` itself; a line for each."""
    template = (folder / "paper.toml").read_text(encoding="utf-8")
    for name, title in TITLES.items():
        found = highest_speed(name)
        text = scenario_text(template, name, title, SCENARIOS[name], found)
        (folder / f"{SCENARIOS[name]}.toml").write_text(text, encoding="utf-8")
        airspeed, scale, share = found
        yield f"{name}: {airspeed:g} m/s, angles x {scale:g}, {100.0 * share:.1f} % of maximum thrust"


def scenario_text(
    template: str,
    name: str,
    title: str,
    scenario: str,
    found: tuple[float, float, float],
    made_by: str = "fighters",
    altitude: float = ALTITUDE,
) -> str:
    """The paper's scenario for another aircraft.

    Args:
        template: text of `paper.toml`.
        name: of the aircraft.
        title: what people call it.
        scenario: name of the new one.
        found: speed, scale and share of `highest_speed`.
        made_by: module of `validation` that writes it.
        altitude: [m].
    """
    airspeed, scale, share = found
    slowest = min(150, airspeed - 50) if airspeed > 150 else 0.6 * airspeed
    for old, new in {
        template.splitlines()[0]: f"# The paper's manoeuvre on the {title}. Made by "
        f"`python -m validation.{made_by} scenarios`, which finds the speed.",
        'name = "paper"': f'name = "{scenario}"',
        "Zhou et al. 2014, section 5: thrust effectiveness": "The paper's manoeuvre on the "
        f"{title}{'' if scale == 1.0 else f', angles x {scale:g}'}: thrust effectiveness",
        'model = "paper"': 'model = "jsbsim"',
        'name = "f16"': f'name = "{name}"',
        "airspeed = 300.0               # m/s": f"airspeed = {airspeed:.1f}               "
        f"# m/s: {100.0 * share:.0f} % of maximum thrust at most, healthy",
        "altitude = 3048.0": f"altitude = {altitude:.1f}",
        "airspeed = [[0, 300]]": f"airspeed = [[0, {airspeed:g}]]",
        "airspeed = [150, 420]": f"airspeed = [{slowest:g}, 420]",
        _toml("flight_path_deg", PATH, 1.0): _toml("flight_path_deg", PATH, scale),
        _toml("heading_deg", HEADING, 1.0): _toml("heading_deg", HEADING, scale),
        'models = ["paper", "identified", "jsbsim"]': 'models = ["identified", "jsbsim"]',
    }.items():
        if old not in template:
            raise ValueError(f"paper.toml: expected {old!r}")
        template = template.replace(old, new)
    return template


def _toml(key: str, points: tuple[tuple[int, int], ...], scale: float) -> str:
    inner = ", ".join(f"[{time}, {round(scale * angle, 3):g}]" for time, angle in points)
    return f"{key} = [{inner}]"


def fighters_table() -> Iterator[str]:
    """Each fighter on its scenario: estimate, tracking with and without FTC, point mass against 6-DOF."""
    yield (
        "| fighter | V [m/s] | angles x | effectiveness error 95 % | max | RMSE V with FTC [m/s] "
        "| path [deg] | heading [deg] | V without [m/s] | ratio | point mass V [m/s] | path [deg] "
        "| heading [deg] | position at the end [m] | targets |"
    )
    yield "|" + "---|" * 15
    for name, scenario in SCENARIOS.items():
        yield fighter_row(name, scenario)


def fighter_row(name: str, scenario: str) -> str:
    """Numbers of one fighter, and which targets it misses."""
    flight = fly(load_scenario(scenario, ["model=jsbsim"]))
    without = flight_metrics(fly(load_scenario(scenario, ["model=jsbsim", "loop.name=no-ftc"])))
    point = fly(load_scenario(scenario, ["model=identified"]))
    one = flight_metrics(flight)
    ratio = without["rmse_airspeed_mps"] / one["rmse_airspeed_mps"]
    apart = difference(flight, point)
    judged = {
        "effectiveness 95 %": (one["effectiveness_thrust_error_p95"], 0.01),
        "effectiveness max": (one["effectiveness_thrust_error_max"], 0.03),
        "V": (one["rmse_airspeed_mps"], 0.4),
        "path": (one["rmse_flight_path_deg"], 0.06),
        "heading": (one["rmse_heading_deg"], 0.15),
        "ratio": (6.0, ratio),
        "point mass V": (apart[0], 0.3),
        "point mass path": (apart[1], 0.05),
        "point mass heading": (apart[2], 0.15),
        "point mass position": (apart[3], 25.0),
    }
    missed = [key for key, (value, limit) in judged.items() if not value <= limit]
    path = flight.scenario.reference.flight_path_deg
    return (
        f"| {name} | {flight.scenario.initial.airspeed:g} "
        f"| {max(angle for _, angle in path) / 5.0:g} "
        f"| {one['effectiveness_thrust_error_p95']:.4f} | {one['effectiveness_thrust_error_max']:.4f} "
        f"| {one['rmse_airspeed_mps']:.3f} | {one['rmse_flight_path_deg']:.4f} "
        f"| {one['rmse_heading_deg']:.4f} | {without['rmse_airspeed_mps']:.2f} | {ratio:.0f} "
        f"| {apart[0]:.3f} | {apart[1]:.4f} | {apart[2]:.4f} | {apart[3]:.1f} "
        f"| {'met' if not missed else 'missed: ' + ', '.join(missed)} |"
    )


def difference(one: Flight, other: Flight) -> tuple[float, float, float, float]:
    """RMS of airspeed [m/s], path [deg] and heading [deg] between two flights; last distance [m]."""
    a, b = one.record, other.record
    rms = [
        float(np.sqrt(np.mean((a[key] - b[key]) ** 2)))
        for key in ("airspeed", "flight_path_angle", "heading")
    ]
    last = sum((a[key][-2] - b[key][-2]) ** 2 for key in ("north", "east", "altitude"))
    return rms[0], float(np.degrees(rms[1])), float(np.degrees(rms[2])), float(np.sqrt(last))


if __name__ == "__main__":
    if sys.argv[1:] == ["speeds"]:
        for fighter in SCENARIOS:
            found = highest_speed(fighter)
            print(f"{fighter}: {found[0]:g} m/s, angles x {found[1]:g}, share {found[2]:.3f}")
    elif sys.argv[1:] == ["scenarios"]:
        for line in write_scenarios(Path(__file__).parents[1] / "scenarios"):
            print(line)
    else:
        for line in fighters_table():
            print(line)
