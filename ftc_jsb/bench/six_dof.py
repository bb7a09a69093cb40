"""JSBSim flights: against the bare loop of the same aircraft, flights a second, a second outer loop."""

import time
from statistics import median
from typing import Any

from ftc_jsb.bench.timing import in_turns, in_two_processes
from ftc_jsb.control.protocol import LoopSetup
from ftc_jsb.loops.registry import build_loop
from ftc_jsb.scenario.load import load_scenario
from ftc_jsb.scenario.schema import Scenario
from ftc_jsb.simulation.assembly import blank_recording, point_mass_of
from ftc_jsb.simulation.fly import fly
from ftc_jsb.six_dof.plant import JsbsimPlant

CHUNK = 50  # samples flown, then as many of the bare loop


def six_dof_scenario(duration: float = 60.0) -> Scenario:
    """The JSBSim F-16 with real sensors, turbulence and the loop made for them."""
    return load_scenario("turbulence", ['model="jsbsim"', f"duration={duration}"])


class BareLoop:
    """An observer that runs a second, uncontrolled aircraft between chunks of the first one's flight."""

    def __init__(self, scenario: Scenario) -> None:
        """Args: the scenario that is observed; the second aircraft is trimmed for it."""
        dt, self._steps = 1.0 / scenario.loop.rate, scenario.simulation.jsbsim_steps
        self._plant = JsbsimPlant(scenario.aircraft, scenario.initial, dt, self._steps)
        self._plant.reset(blank_recording(scenario))
        self.flown: list[float] = []  # [s] a sample, by chunk
        self.bare: list[float] = []
        self._started = time.perf_counter()

    def __call__(self, record: Any, i: int) -> None:
        """Every CHUNK samples: time them, and as many of the bare loop."""
        if i % CHUNK:
            return
        now = time.perf_counter()
        self.flown.append((now - self._started) / CHUNK)
        run = self._plant.fdm.run
        for _ in range(CHUNK * self._steps):
            run()
        self._started = time.perf_counter()
        self.bare.append((self._started - now) / CHUNK)


def measure_ratio(scenario: Scenario) -> dict[str, float]:
    """Time of a closed-loop flight with recording over that of the bare `fdm.run()` loop."""
    bare = BareLoop(scenario)
    fly(scenario, (bare,))
    flown, alone = bare.flown[1:], bare.bare[1:]  # before the first chunk the aircraft was trimmed
    return {
        "six_dof_ratio": median(a / b for a, b in zip(flown, alone, strict=True)),
        "six_dof_us_per_sample": min(flown) * 1e6,
        "six_dof_bare_us_per_sample": min(alone) * 1e6,
    }


def measure_second_loop(scenario: Scenario, rounds: int = 7) -> dict[str, float]:
    """Cost of one more outer loop that works on the same recording [µs a step]."""
    record = fly(scenario).record.copy()
    aircraft = point_mass_of(scenario)
    fuel = scenario.aircraft.fuel_fraction
    setup = LoopSetup(aircraft, aircraft.initial_mass(fuel), scenario.loop, 0.01, scenario.sensors)
    loop = build_loop(setup, aircraft.record(fuel), record)

    def work() -> int:
        for i in range(record.size):
            loop.step(i)
        return record.size

    return {"second_loop_us_per_step": median(in_turns({"": work}, rounds)[""]) * 1e6}


def _flight_seconds(scenario: Scenario) -> float:
    started = time.perf_counter()
    fly(scenario)
    return time.perf_counter() - started


def measure_flights(scenario: Scenario, flights: int = 4) -> dict[str, float]:
    """JSBSim flights a second, weaving and trim included, in one process and in two."""
    one = 1.0 / median(_flight_seconds(scenario) for _ in range(flights))
    elapsed = in_two_processes(_flight_seconds, [scenario] * 2, [scenario] * (2 * flights))
    two = 2 * flights / elapsed
    return {"six_dof_flights_per_s": one, "six_dof_flights_per_s_2_processes": two}
