"""What the loop does over bad lines at true rates, many draws: `python -m tests.flightgear.study [DRAWS]`."""

import sys
import tempfile
from pathlib import Path

import numpy as np

from ftc_jsb.aircraft.description import load_aircraft
from ftc_jsb.analysis.metrics import flight_metrics
from ftc_jsb.export.flightgear.aircraft_folder import export_flightgear
from ftc_jsb.scenario.schema import AircraftChoice
from tests.flightgear.simulated import SimulatedLink, drawn
from tests.flightgear.test_flight import begin, estimate_error

SLOWEST = 65  # frames of JSBSim, 0.54 s, of a picture that other work stops
LINES = {
    "swapped": 0.02,
    "doubled": 0.03,
    "garbled": 0.02,
}  # shares, besides those that are dropped
CASES = {  # share of lines dropped each way, share of slow pictures
    "20-30 pictures a second": (0.0, 0.0),
    "10 % of lines dropped": (0.1, 0.0),
    "slow pictures": (0.0, 0.02),
    "both": (0.1, 0.02),
}


def figures(folder: Path, dropped: float, slow: float, seed: int) -> tuple[float, ...]:
    """RMSE of airspeed [m/s], path, heading [deg], error of the estimate, longest step [s]."""
    chance = np.random.default_rng(seed)
    frames = chance.integers(4, 7, 100_000)
    stopped = chance.random(frames.size) < slow
    frames[stopped] = chance.integers(12, SLOWEST + 1, int(stopped.sum()))
    link = SimulatedLink(folder, lambda picture: int(frames[picture]))
    if dropped:
        shares = {"dropped": dropped, **LINES}
        link.lines, link.answers = drawn(shares, 2 * seed), drawn(shares, 2 * seed + 1)
    flown = begin(link)[0].fly()
    metrics = flight_metrics(flown)
    rmse = (metrics[f"rmse_{n}"] for n in ("airspeed_mps", "flight_path_deg", "heading_deg"))
    return (*rmse, estimate_error(flown), float(np.diff(flown.record["time"]).max()))


if __name__ == "__main__":
    with tempfile.TemporaryDirectory() as place:
        export_flightgear(load_aircraft("f16"), AircraftChoice(), Path(place))
        for name, (lost, stops) in CASES.items():
            draws = range(int(sys.argv[1]) if len(sys.argv) > 1 else 6)
            found = np.array([figures(Path(place) / "f16-ftc", lost, stops, k) for k in draws])
            print(name, "median", np.round(np.median(found, axis=0), 3), "worst",
                  np.round(found.max(axis=0), 3), flush=True)  # fmt: skip
