"""Flies, prints what was measured against what is asked for, and ends with 1 if something is not met."""

import argparse
import sys
import tempfile
import time
from pathlib import Path

import numpy as np

from validation.flightgear.flown import (
    LOOP,
    PICTURES,
    SIMULATOR,
    J,
    Loop,
    check,
    failures,
    held_to,
    judge,
    wait_flown,
)
from validation.flightgear.relay import BadLine, Ways
from validation.flightgear.simulator import Properties, flightgear, picture, screen

RELAYED = (5611, 5612)  # ports
HEALTHY = "fault=[]"  # the dialog's faults alone


def fault_from_dialog(simulator: Properties, kind: str, left: float) -> None:
    """What a click on Inject does."""
    simulator.set("/ftc/dialog/kind", kind)
    simulator.set("/ftc/dialog/left", left)
    simulator.set("/ftc/dialog/inject", 1)


def paper(simulator: Properties, folder: Path) -> None:
    """The paper's manoeuvre, 40 % of thrust lost at 20 s by the dialog."""
    print("Paper's manoeuvre, fault from the dialog at 20 s", flush=True)
    loop = Loop(folder / "paper", (LOOP, SIMULATOR), HEALTHY)
    wait_flown(simulator, 20.0)
    fault_from_dialog(simulator, "thrust lost", 0.6)
    judge(loop.flight())
    simulator.set("/ftc/dialog/repair", 1)


def time_as_it_is(simulator: Properties, folder: Path) -> None:
    """A pause of 5 s, and twice the rate for 10 s."""
    print("Pause for 5 s at 12 s, rate x 2 from 25 s to 35 s, fault at 20 s", flush=True)
    loop = Loop(folder / "time", (LOOP, SIMULATOR), HEALTHY)
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
    loop = Loop(folder / "killed", (LOOP, SIMULATOR), HEALTHY)
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
    again = Loop(folder / "again", (LOOP, SIMULATOR), HEALTHY, "duration=30")
    judge(again.flight(), rmse=False)


def bad_line(simulator: Properties, folder: Path) -> None:
    """A tenth of the lines dropped each way, others doubled, out of order, garbled."""
    print(
        "10 % of lines dropped each way, others doubled, disordered, garbled; fault at 20 s",
        flush=True,
    )
    with BadLine([Ways(RELAYED[1], SIMULATOR), Ways(LOOP, RELAYED[0])]) as line:
        loop = Loop(folder / "bad-line", RELAYED, HEALTHY)
        wait_flown(simulator, 20.0)
        fault_from_dialog(simulator, "thrust lost", 0.6)
        judge(loop.flight())
    print(f"       {line.dropped} dropped, {line.passed} passed, refused by the simulator: "
          f"{simulator.get(f'{J}/ftc/received/refused'):.0f}")  # fmt: skip
    simulator.set("/ftc/dialog/repair", 1)


def pilot(simulator: Properties, folder: Path) -> None:
    """A pilot takes the references, banks by the stick, gives back."""
    print("Pilot banks by the stick at 5 s, gives back 8 s later", flush=True)
    level = ("reference.heading_deg=[[0,0]]", "reference.flight_path_deg=[[0,0]]")
    loop = Loop(folder / "pilot", (LOOP, SIMULATOR), HEALTHY, *level)
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
    loop.stop()
    record = loop.flight().record
    rate = np.degrees(np.abs(np.diff(record["bank_angle_cmd"]) / np.diff(record["time"])))
    error = np.abs(record["airspeed"] - record["airspeed_ref"]).max()
    print(
        f"       fastest bank command {rate.max():.0f} deg/s, airspeed off by {error:.2f} m/s at most"
    )


def reset(simulator: Properties, folder: Path) -> None:
    """FlightGear is reset in the turn, and a new loop flies it from where it begins again."""
    print("FlightGear is reset in the turn at 8 s; a new loop flies it, fault at 10 s", flush=True)
    loop = Loop(folder / "before-reset", (LOOP, SIMULATOR), HEALTHY)
    wait_flown(simulator, 8.0)
    simulator.run("reset")
    flight = loop.flight()
    check("flight did not end by the reset", float("reset" not in flight.outcome.reason), 0)
    simulator.connect()
    again = Loop(folder / "after-reset", (LOOP, SIMULATOR), HEALTHY, "duration=30")
    wait_flown(simulator, 10.0)
    fault_from_dialog(simulator, "thrust lost", 0.6)
    judge(again.flight(), rmse=False)
    simulator.set("/ftc/dialog/repair", 1)


FLIGHTS = {
    "paper": paper,
    "time": time_as_it_is,
    "killed": killed_and_restarted,
    "bad-line": bad_line,
    "pilot": pilot,
    "reset": reset,
}


def pictures(folder: Path, images: Path) -> None:
    """View in the turn and dialog after the fault, as docs/flightgear.md shows them."""
    with (
        screen("900x680") as display,
        flightgear(folder, display, "900x680", (LOOP, SIMULATOR), "--enable-hud") as simulator,
    ):
        simulator.set("/sim/speed-up", 0.25)  # drawn slowly, flown at 20 pictures a second and more
        loop = Loop(folder / "pictures", (LOOP, SIMULATOR), HEALTHY, "loop.name=robust")
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
            flightgear(
                folder, display, "320x200", (LOOP, SIMULATOR), held_to(PICTURES)
            ) as simulator,
        ):
            for name in given.flights:
                FLIGHTS[name](simulator, folder)
    print("failed: " + "; ".join(failures) if failures else "all as asked for")
    return bool(failures)


if __name__ == "__main__":
    sys.exit(main())
