"""Transports and trainers of the jsbsim package, from the installed file to a loss of thrust.

`python -m validation.transports` drafts, designs, identifies and flies each, and prints the table;
`scenarios` writes the scenarios of those that are shipped.
"""

import sys
import tempfile
from collections.abc import Iterator
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np

from ftc_jsb.aircraft.description import Aircraft, load_aircraft
from ftc_jsb.aircraft.test_range import design_airspeeds
from ftc_jsb.analysis.metrics import flight_metrics
from ftc_jsb.analysis.verdict import passed
from ftc_jsb.draft.aircraft_file import draft
from ftc_jsb.errors import UserError
from ftc_jsb.identify.identification import identify
from ftc_jsb.identify.point_mass_contents import write_point_mass
from ftc_jsb.inner_loop_design.criteria import criteria_missed
from ftc_jsb.inner_loop_design.design import design, write_design
from ftc_jsb.inner_loop_design.handling import CLASSES, class_of
from ftc_jsb.inner_loop_design.published_steps import fly_steps
from ftc_jsb.scenario.load import load_scenario
from ftc_jsb.simulation.fly import fly
from validation.fighters import LEFT, highest_speed, manoeuvre, scenario_text

TITLE = "Transports and trainers"
WORDS = (
    "Aircraft of the jsbsim package as `ftc-jsb inner-loop NAME` drafts and designs them and `ftc-jsb "
    "identify` identifies them, nothing touched by hand (T-37 and 737: as shipped); then the paper's "
    "manoeuvre with its angles scaled, at the highest speed at which 0.6 of the thrust is 1.15 times what "
    "it needs, and the loss to 0.6 at 20 s (`validation/transports.py`). Wanted: the effectiveness within "
    "0.02 at the end of the flight. "
    "Drag residuals are RMS on held-out tests that go to the ends of the range, thrust of maximum."
)
AIRCRAFT = ("T37", "737", "global5000", "MD11", "A320", "B747", "787-8")
SHIPPED = {"T37": ("t37", "T-37"), "737": ("737", "737")}
SCENARIOS = [scenario for scenario, _ in SHIPPED.values()]
SCALES = (0.4, 0.3, 0.2)  # of the paper's angles: 30 to 45 deg of bank at their speeds
ALTITUDES = (3048.0, 1000.0)  # [m], the lower where thrust does not pay at the higher
STEP = 5  # [m/s]
TARGET = 0.02  # of the effectiveness, at the end of the flight
KNOWN = 5.0  # [s] after the fault from which the estimate counts


def make(name: str, folder: Path) -> Aircraft:
    """Draft, design and identify an installed aircraft into a folder, as the commands do."""
    aircraft = load_aircraft(str(draft(name, folder / name, _silent).parent))
    write_design(aircraft.folder / "inner_loop.xml", aircraft, design(aircraft, _silent))
    write_point_mass(aircraft.folder / "point_mass.toml", identify(aircraft, _silent))
    return aircraft


def _silent(_: str) -> None:
    pass


class Condition(NamedTuple):
    """Where the manoeuvre is flown."""

    speed: tuple[float, float, float]  # [m/s], scale of the angles, share of maximum thrust
    altitude: float  # [m]


def condition(aircraft: Aircraft) -> Condition:
    """`highest_speed` within what the inner loop is designed for.

    Raises:
        UserError: none is found.
    """
    low, *_, high = design_airspeeds(aircraft)
    speeds = range(int(high) // STEP * STEP, int(low), -STEP)
    for altitude in ALTITUDES:
        try:
            found = highest_speed(str(aircraft.folder), speeds, SCALES, altitude)
        except ValueError:
            continue
        return Condition(found, altitude)
    raise UserError(f"no speed at which {LEFT:g} of the thrust pays for the manoeuvre")


def transports_table() -> Iterator[str]:
    """Each aircraft: its inner loop, its point mass, and a loss of thrust to 0.6 at 20 s."""
    yield (
        "| aircraft | class | criteria | drag for the law [%] | for the estimator [%] | thrust [%] "
        "| V [m/s] | altitude [m] | angles x | effectiveness error at the end "
        "| largest from 5 s after the fault "
        "| RMSE V with FTC [m/s] | without [m/s] | path [deg] | heading [deg] | verdict | target |"
    )
    yield "|" + "---|" * 17
    with tempfile.TemporaryDirectory(prefix="ftc-jsb-") as scratch:
        for name in AIRCRAFT:
            try:
                shipped = name in SHIPPED
                yield _row(load_aircraft(name) if shipped else make(name, Path(scratch)))
            except UserError as error:
                yield f"| {name} | {error} |" + " |" * 15


def _row(aircraft: Aircraft) -> str:
    from ftc_jsb.aircraft.point_mass_file import load_point_mass

    kind = class_of(aircraft)
    missed = [m for steps in fly_steps(aircraft) for m in criteria_missed(steps, CLASSES[kind])]
    fit: dict[str, Any] = load_point_mass(aircraft.folder).identification
    (airspeed, scale, _), altitude = condition(aircraft)
    flown = manoeuvre(str(aircraft.folder), airspeed, scale, altitude)
    changes = ["model=jsbsim", "limits={}", *flown]
    flight = fly(load_scenario("paper", changes))
    metrics = flight_metrics(flight)
    without = flight_metrics(fly(load_scenario("paper", [*changes, "loop.name=no-ftc"])))
    row = flight.record[:-1]
    error = np.abs(row["effectiveness_thrust_est"] - row["effectiveness_thrust"])
    known = row["time"] >= flight.scenario.fault[0].start + KNOWN
    return (
        f"| {aircraft.name} | {kind} | {'kept' if not missed else '; '.join(missed)} "
        f"| {fit['residual_drag_polar_percent']:.2f} | {fit['residual_drag_angles_percent']:.3f} "
        f"| {fit['residual_thrust_percent_of_maximum']:.3f} | {airspeed:g} | {altitude:g} | {scale:g} "
        f"| {error[-1]:.4f} | {error[known].max():.4f} | {metrics['rmse_airspeed_mps']:.3f} "
        f"| {without['rmse_airspeed_mps']:.3f} | {metrics['rmse_flight_path_deg']:.3f} "
        f"| {metrics['rmse_heading_deg']:.3f} | {'inside limits' if passed(metrics) else 'not kept'} "
        f"| {'met' if error[-1] <= TARGET else 'missed'} |"
    )


def write_scenarios(folder: Path) -> Iterator[str]:
    """Write the scenario of each that is shipped; a line for each."""
    template = (folder / "paper.toml").read_text(encoding="utf-8")
    for name, (scenario, title) in SHIPPED.items():
        found, altitude = condition(load_aircraft(name))
        text = scenario_text(template, name, title, scenario, found, "transports", altitude)
        (folder / f"{scenario}.toml").write_text(text, encoding="utf-8")
        yield f"{name}: {found[0]:g} m/s, angles x {found[1]:g}"


if __name__ == "__main__":
    if sys.argv[1:] == ["scenarios"]:
        for line in write_scenarios(Path(__file__).parents[1] / "scenarios"):
            print(line)
    else:
        for line in transports_table():
            print(line, flush=True)
