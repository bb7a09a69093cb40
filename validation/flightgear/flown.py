"""What the real flights share: the outer loop as a program of its own, and its recording against the limits."""

import signal
import subprocess
import sys
import time
from collections.abc import Mapping
from pathlib import Path
from typing import Any

import numpy as np

from ftc_jsb.analysis.metrics import flight_metrics
from ftc_jsb.recording.flight import Flight
from ftc_jsb.recording.netcdf import load
from validation.flightgear.simulator import Properties

J = "/fdm/jsbsim"
LOOP, SIMULATOR = 5601, 5602  # ports
PICTURES = 25  # a second, at most
RMSE = {"rmse_airspeed_mps": 0.5, "rmse_flight_path_deg": 0.15, "rmse_heading_deg": 0.4}
SETTLED = 3.0  # [s] after a fault within which the estimate may be off
failures: list[str] = []


def check(what: str, value: float, limit: float) -> None:
    """Print a measured value and its limit."""
    good = bool(value <= limit)
    print(f"  {'ok  ' if good else 'FAIL'} {what}: {value:.4g} (at most {limit:g})", flush=True)
    if not good:
        failures.append(what)


def held_to(pictures: int) -> str:
    """FlightGear's option that holds it to so many pictures a second."""
    return f"--prop:double:/sim/frame-rate-throttle-hz={pictures}"


class Loop:
    """`ftc-jsb plugin SCENARIO --attach`."""

    def __init__(
        self, out: Path, ports: tuple[int, int], *overrides: str, scenario: str = "paper"
    ) -> None:
        """Args: results; ports; `key=value`; of the shipped ones."""
        self.out = out
        settings = [part for text in overrides for part in ("--set", text)]
        self._process = subprocess.Popen(
            [sys.executable, "-m", "ftc_jsb", "plugin", scenario, "--attach", f"127.0.0.1:{ports[1]}",
             "--listen", str(ports[0]), "--out", str(out), *settings],
            stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True,
        )  # fmt: skip

    def stop(self) -> None:
        """As a user who closes the terminal."""
        self._process.send_signal(signal.SIGTERM)

    def flight(self) -> Flight:
        """The recording, once it is over."""
        said, _ = self._process.communicate(timeout=600)
        for line in said.splitlines():
            if line.startswith("ftc-jsb:"):
                print(f"       {line}", flush=True)
        return load(self.out / "flight.nc")


def wait_flown(simulator: Properties, seconds: float) -> None:
    """Until the outer loop has flown for so long, in simulation time."""
    while simulator.get(f"{J}/ftc/flying") != 1.0:
        time.sleep(0.2)
    until = simulator.get(f"{J}/simulation/sim-time-sec") + seconds
    while simulator.get(f"{J}/simulation/sim-time-sec") < until:
        time.sleep(0.2)


def worst_estimate(flight: Flight) -> float:
    """Largest error of the estimated effectiveness of thrust outside `SETTLED` after a change of the truth."""
    record = flight.record
    truth, time_ = record["effectiveness_thrust"], record["time"]
    error = np.abs(record["effectiveness_thrust_est"] - truth)
    for changed in time_[1:][np.abs(np.diff(truth)) > 0.01]:
        error[(time_ >= changed) & (time_ < changed + SETTLED)] = 0.0
    return float(np.nanmax(error))


def judge(flight: Flight, rmse: bool = True) -> Mapping[str, Any]:
    """Print the flight's figures against their limits; gives its metrics."""
    metrics = flight_metrics(flight)
    steps = np.diff(flight.record["time"])
    print(f"       {flight.record.size} samples, {1 / np.median(steps):.1f} a second in the median, "
          f"longest step {steps.max():.2f} s, verdict {metrics['verdict']}")  # fmt: skip
    check("flight did not end as planned", float(flight.outcome.status != "complete"), 0)
    if rmse:
        for name, limit in RMSE.items():
            check(name, metrics[name], limit)
    check("error of the estimate outside 3 s after a fault", worst_estimate(flight), 0.05)
    return metrics
