"""Flies, prints what was measured against what is asked for, and ends with 1 if something is not met."""

import argparse
import signal
import subprocess
import sys
import tempfile
import time
from pathlib import Path

import numpy as np

from ftc_jsb.analysis.metrics import flight_metrics
from ftc_jsb.recording.flight import Flight
from ftc_jsb.recording.netcdf import load
from validation.flightgear.relay import BadLine, Ways
from validation.flightgear.simulator import Properties, flightgear, picture, screen

J = "/fdm/jsbsim"
LOOP, SIMULATOR = 5601, 5602  # ports
RELAYED = (5611, 5612)
FRAMES = "--prop:double:/sim/frame-rate-throttle-hz=25"
RMSE = {"rmse_airspeed_mps": 0.5, "rmse_flight_path_deg": 0.15, "rmse_heading_deg": 0.4}
failures: list[str] = []


def check(what: str, value: float, limit: float) -> None:
    """Print a measured value and its limit."""
    good = bool(value <= limit)
    print(f"  {'ok  ' if good else 'FAIL'} {what}: {value:.4g} (at most {limit:g})", flush=True)
    if not good:
        failures.append(what)


class Loop:
    """`ftc-jsb plugin paper --attach`, without the scenario's own fault."""

    def __init__(self, out: Path, ports: tuple[int, int], *overrides: str) -> None:
        """Args: results; ports; `key=value`."""
        self.out = out
        settings = [part for text in ("fault=[]", *overrides) for part in ("--set", text)]
        self._process = subprocess.Popen(
            [sys.executable, "-m", "ftc_jsb", "plugin", "paper", "--attach", f"127.0.0.1:{ports[1]}",
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


def judge(flight: Flight, rmse: bool = True) -> None:
    """Print the flight's figures against their limits."""
    metrics = flight_metrics(flight)
    steps = np.diff(flight.record["time"])
    print(f"       {flight.record.size} samples, {1 / np.median(steps):.1f} a second in the median, "
          f"longest step {steps.max():.2f} s, verdict {metrics['verdict']}")  # fmt: skip
    check("flight did not end as planned", float(flight.outcome.status != "complete"), 0)
    if rmse:
        for name, limit in RMSE.items():
            check(name, metrics[name], limit)
    truth, estimate = (
        flight.record["effectiveness_thrust"],
        flight.record["effectiveness_thrust_est"],
    )
    time_ = flight.record["time"]
    error = np.abs(estimate - truth)
    for changed in time_[1:][np.abs(np.diff(truth)) > 0.01]:
        error[(time_ >= changed) & (time_ < changed + 3.0)] = 0.0
    check("error of the estimate outside 3 s after a fault", float(np.nanmax(error)), 0.05)


def fault_from_dialog(simulator: Properties, kind: str, left: float) -> None:
    """What a click on Inject does."""
    simulator.set("/ftc/dialog/kind", kind)
    simulator.set("/ftc/dialog/left", left)
    simulator.set("/ftc/dialog/inject", 1)


def paper(simulator: Properties, folder: Path) -> None:
    """The paper's manoeuvre, 40 % of thrust lost at 20 s by the dialog."""
    print("Paper's manoeuvre, fault from the dialog at 20 s", flush=True)
    loop = Loop(folder / "paper", (LOOP, SIMULATOR))
    wait_flown(simulator, 20.0)
    fault_from_dialog(simulator, "thrust lost", 0.6)
    judge(loop.flight())
    simulator.set("/ftc/dialog/repair", 1)


def time_as_it_is(simulator: Properties, folder: Path) -> None:
    """A pause of 5 s, and twice the rate for 10 s."""
    print("Pause for 5 s at 12 s, rate x 2 from 25 s to 35 s, fault at 20 s", flush=True)
    loop = Loop(folder / "time", (LOOP, SIMULATOR))
    wait_flown(simulator, 12.0)
    for switch in ("master", "clock"):
        simulator.set(f"/sim/freeze/{switch}", "true")
    before = simulator.get(f"{J}/simulation/sim-time-sec")
    time.sleep(5.0)
    check(
        "time passed in the pause [s]", simulator.get(f"{J}/simulation/sim-time-sec") - before, 0.2
    )
    for switch in ("master", "clock"):
        simulator.set(f"/sim/freeze/{switch}", "false")
    wait_flown(simulator, 8.0)
    fault_from_dialog(simulator, "thrust lost", 0.6)
    wait_flown(simulator, 5.0)
    simulator.set("/sim/speed-up", 2)
    wait_flown(simulator, 10.0)
    simulator.set("/sim/speed-up", 1)
    flight = loop.flight()
    judge(flight, rmse=False)
    times = flight.record["time"]
    fast = np.diff(times)[(times[1:] > 27.0) & (times[1:] < 34.0)]
    print(f"       at twice the rate steps of {1e3 * np.median(fast):.0f} ms in the median")
    simulator.set("/ftc/dialog/repair", 1)


def killed_and_restarted(simulator: Properties, folder: Path) -> None:
    """The loop is killed in the turn, FlightGear flies on, another loop takes over."""
    print("Loop ended in the turn at 8 s and started again 10 s later", flush=True)
    loop = Loop(folder / "killed", (LOOP, SIMULATOR))
    wait_flown(simulator, 8.0)
    loop.stop()
    flight = loop.flight()
    check("recording not readable or empty", float(flight.record.size < 100), 0)
    airspeed = simulator.get(f"{J}/velocities/vt-fps") * 0.3048
    time.sleep(10.0)
    check("airspeed lost by the inner loop alone [m/s]",
          abs(simulator.get(f"{J}/velocities/vt-fps") * 0.3048 - airspeed), 5.0)  # fmt: skip
    check("bank [rad]", abs(simulator.get(f"{J}/ftc/bank/actual")), 0.02)
    check("path [rad]", abs(simulator.get(f"{J}/ftc/hold/path-rad")), 0.02)
    again = Loop(folder / "again", (LOOP, SIMULATOR), "duration=30")
    judge(again.flight(), rmse=False)


def bad_line(simulator: Properties, folder: Path) -> None:
    """A tenth of the lines dropped each way, others doubled, out of order, garbled."""
    print(
        "10 % of lines dropped each way, others doubled, disordered, garbled; fault at 20 s",
        flush=True,
    )
    with BadLine([Ways(RELAYED[1], SIMULATOR), Ways(LOOP, RELAYED[0])]) as line:
        loop = Loop(folder / "bad-line", (RELAYED[0], RELAYED[1]))
        wait_flown(simulator, 20.0)
        fault_from_dialog(simulator, "thrust lost", 0.6)
        judge(loop.flight())
    print(f"       {line.dropped} dropped, {line.passed} passed, refused by the simulator: "
          f"{simulator.get(f'{J}/ftc/received/refused'):.0f}")  # fmt: skip
    simulator.set("/ftc/dialog/repair", 1)


def pilot(simulator: Properties, folder: Path) -> None:
    """A pilot takes the references, banks by the stick, gives back; FlightGear is reset in the end."""
    print("Pilot banks by the stick at 5 s, gives back 8 s later; FlightGear is reset", flush=True)
    level = ("reference.heading_deg=[[0,0]]", "reference.flight_path_deg=[[0,0]]")
    loop = Loop(folder / "pilot", (LOOP, SIMULATOR), *level)
    wait_flown(simulator, 5.0)
    simulator.set(f"{J}/ftc/pilot/wanted", 1)
    time.sleep(1.0)
    before = simulator.get("/controls/flight/aileron")
    simulator.set("/controls/flight/aileron", before + 0.5)
    wait_flown(simulator, 2.0)
    simulator.set("/controls/flight/aileron", before)
    wait_flown(simulator, 6.0)
    asked = float(np.degrees(simulator.get(f"{J}/ftc/pilot/bank-rad")))
    print(f"       the stick has asked for {asked:.1f} deg of bank", flush=True)
    achieved = float(np.degrees(simulator.get(f"{J}/ftc/bank/actual")))
    check("bank off what was asked for [deg]", abs(achieved - asked), 1.5)
    check("the stick asked for less than 15 deg", float(abs(asked) < 15.0), 0)
    simulator.set(f"{J}/ftc/pilot/wanted", 0)
    wait_flown(simulator, 15.0)
    simulator.run("reset")
    flight = loop.flight()
    check("flight did not end by the reset", float("reset" not in flight.outcome.reason), 0)
    record = flight.record
    rate = np.degrees(np.abs(np.diff(record["bank_angle_cmd"]) / np.diff(record["time"])))
    error = np.abs(record["airspeed"] - record["airspeed_ref"]).max()
    print(
        f"       fastest bank command {rate.max():.0f} deg/s, airspeed off by {error:.2f} m/s at most"
    )


FLIGHTS = {
    "paper": paper,
    "time": time_as_it_is,
    "killed": killed_and_restarted,
    "bad-line": bad_line,
    "pilot": pilot,
}


def pictures(folder: Path, images: Path) -> None:
    """View in the turn and dialog after the fault, as docs/flightgear.md shows them."""
    with (
        screen("900x680") as display,
        flightgear(folder, display, "900x680", (LOOP, SIMULATOR), "--enable-hud") as simulator,
    ):
        loop = Loop(folder / "pictures", (LOOP, SIMULATOR))
        simulator.set("/sim/current-view/view-number", 1)
        simulator.set("/sim/hud/visibility[1]", "false")
        wait_flown(simulator, 8.0)
        picture(display, images / "turn.png")
        simulator.set("/sim/current-view/view-number", 0)
        simulator.set("/sim/hud/visibility[1]", "true")
        simulator.set("/ftc/dialog/show", 1)
        wait_flown(simulator, 10.0)
        fault_from_dialog(simulator, "thrust lost", 0.6)
        wait_flown(simulator, 4.0)
        picture(display, images / "dialog.png")
        loop.stop()
        loop.flight()


def main() -> int:
    """Fly."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument(
        "--pictures", type=Path, metavar="DIR", help="take the pictures of the page"
    )
    parser.add_argument("flights", nargs="*", default=[*FLIGHTS], help=", ".join(FLIGHTS))
    given = parser.parse_args()
    with tempfile.TemporaryDirectory(prefix="ftc-jsb-validate-") as temporary:
        folder = Path(temporary)
        if given.pictures:
            given.pictures.mkdir(parents=True, exist_ok=True)
            pictures(folder, given.pictures)
            return 0
        with (
            screen("320x200") as display,
            flightgear(folder, display, "320x200", (LOOP, SIMULATOR), FRAMES) as simulator,
        ):
            for name in given.flights:
                FLIGHTS[name](simulator, folder)
    print("failed: " + "; ".join(failures) if failures else "all as asked for")
    return bool(failures)


if __name__ == "__main__":
    sys.exit(main())
