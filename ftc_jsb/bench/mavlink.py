"""Cost of the MAVLink vehicle: share of a core at default rates, and how well real time is kept."""

import socket
import time
from typing import NamedTuple

from ftc_jsb.mavlink.link.endpoint import LOOPBACK, Endpoint
from ftc_jsb.mavlink.link.vehicle_link import Link
from ftc_jsb.mavlink.live import live_flight
from ftc_jsb.scenario.load import load_scenario
from ftc_jsb.simulation.fly import fly
from ftc_jsb.simulation.pacing import Pacer


class MavlinkCost(NamedTuple):
    """Measured on a flight at 1 x, with a ground station that listens."""

    core_share: float  # of one core, by the vehicle's thread
    messages_per_s: float
    pacing_error_median_ms: float
    pacing_error_p99_ms: float
    pacing_error_max_ms: float
    overruns: int  # samples that began later than one sample after they were due
    samples: int
    alone_error_median_ms: (
        float  # the same flight without a vehicle: what the machine itself is late
    )
    alone_error_p99_ms: float


def measure_mavlink(model: str = "jsbsim", seconds: float = 10.0) -> MavlinkCost:
    """Fly `model` in real time for `seconds` with telemetry at default rates to a port of this machine.

    Raises:
        UserError: the flight cannot be had.
    """
    scenario = load_scenario("paper", [f"model={model}", f"duration={seconds}", "fault=[]"])
    with socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as ground:
        ground.bind((LOOPBACK, 0))
        link = Link(Endpoint("udpout", LOOPBACK, ground.getsockname()[1]))
        with live_flight(scenario, 1.0, link, None, 0.0) as live:
            spent, since, sent = [], [], []

            def mark() -> None:
                spent.append(live.vehicle.core_seconds())
                since.append(time.perf_counter())
                sent.append(live.vehicle.statistics().sent)

            def first_row(record: object, i: int) -> None:
                if i == 0:
                    mark()

            fly(scenario, (first_row, *live.observers), commands=live.commands)
            mark()
    assert live.pacer is not None
    error = live.pacer.error()
    pacer = Pacer(scenario.loop.rate, 1.0)
    fly(scenario, (pacer,))
    alone = pacer.error()
    wall = since[1] - since[0]
    return MavlinkCost(
        core_share=(spent[1] - spent[0]) / wall,
        messages_per_s=(sent[1] - sent[0]) / wall,
        pacing_error_median_ms=1e3 * error.median,
        pacing_error_p99_ms=1e3 * error.p99,
        pacing_error_max_ms=1e3 * error.largest,
        overruns=error.overruns,
        samples=error.samples,
        alone_error_median_ms=1e3 * alone.median,
        alone_error_p99_ms=1e3 * alone.p99,
    )


if __name__ == "__main__":
    for name, value in measure_mavlink()._asdict().items():
        print(f"{name}: {value:.4g}")
