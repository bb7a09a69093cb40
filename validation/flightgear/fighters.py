"""The real FlightGear flies the fighters: `python -m validation.flightgear.fighters`.

Each flies its shipped scenario with its own fault, in a FlightGear of its own. Prints a table: RMSE of airspeed
[m/s], path and heading [deg], largest error of the estimate outside 3 s after the fault, lines a second in the
median. Ends with 1 if a limit of `flown` is not kept.
"""

import argparse
import sys
import tempfile
from pathlib import Path

import numpy as np

from ftc_jsb.scenario.load import load_scenario
from validation.flightgear.flown import (
    LOOP,
    RMSE,
    SIMULATOR,
    Loop,
    failures,
    held_to,
    judge,
    worst_estimate,
)
from validation.flightgear.simulator import flightgear, screen

PICTURES = 60  # a second, at most: at 25 the F-15, F-4N and T-38 leave the limits
SCENARIOS = ("f15", "f4n", "a4", "t38")
HEADER = (
    "| scenario | V [m/s] | γ [°] | χ [°] | estimate | lines a second |\n|---|---|---|---|---|---|"
)


def fly(name: str, pictures: int, display: str, folder: Path) -> str:
    """A scenario from FlightGear's start to its end; gives the table's row.

    Args:
        name: of a shipped scenario.
        pictures: a second, at most.
        display: of `screen`.
        folder: for the export and the recording; it is not there yet.
    """
    print(f"Scenario {name}", flush=True)
    scenario = load_scenario(name)
    with flightgear(
        folder, display, "320x200", (LOOP, SIMULATOR), held_to(pictures),
        choice=scenario.aircraft, initial=scenario.initial,
    ):  # fmt: skip
        flight = Loop(folder / "flight", (LOOP, SIMULATOR), scenario=name).flight()
    metrics = judge(flight)
    rate = 1.0 / np.median(np.diff(flight.record["time"]))
    errors = " | ".join(f"{metrics[each]:.3f}" for each in RMSE)
    return f"| {name} | {errors} | {worst_estimate(flight):.3f} | {rate:.0f} |"


def main() -> int:
    """Fly."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--pictures", type=int, default=PICTURES, help="a second, at most")
    parser.add_argument("scenarios", nargs="*", default=SCENARIOS, help=", ".join(SCENARIOS))
    given = parser.parse_args()
    with (
        tempfile.TemporaryDirectory(prefix="ftc-jsb-validate-") as folder,
        screen("320x200") as display,
    ):
        rows = [fly(name, given.pictures, display, Path(folder) / name) for name in given.scenarios]
    print("\n".join([HEADER, *rows]))
    print("failed: " + "; ".join(failures) if failures else "all as asked for")
    return bool(failures)


if __name__ == "__main__":
    sys.exit(main())
