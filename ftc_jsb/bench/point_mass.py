"""Point-mass flights: a step, the NumPy form, many cases in one call, an hour of flight."""

import statistics
import time

from ftc_jsb.bench.numpy_form import fly_in_numpy
from ftc_jsb.bench.timing import in_turns, in_two_processes, ratio
from ftc_jsb.scenario.load import load_scenario
from ftc_jsb.scenario.schema import Scenario
from ftc_jsb.simulation.assembly import point_mass_of
from ftc_jsb.simulation.batch import fly_batch
from ftc_jsb.simulation.fly import fly


def _watch(record: object, i: int) -> None: ...


_watch.coarse = True  # type: ignore[attr-defined]


def measure_step(rounds: int = 9, numpy_samples: int = 300) -> dict[str, float]:
    """A 60 s flight of the paper, closed loop with recording, and the same loop in NumPy."""
    scenario = load_scenario("paper", ['loop.priority="none"'])
    first = fly(scenario).record[0]
    model = point_mass_of(scenario).record(0.0)[0]
    flights = []

    def compiled() -> int:
        factor = fly(scenario, (_watch,)).real_time_factor
        assert factor is not None
        flights.append(scenario.duration / factor)
        return scenario.samples

    def numpy() -> int:
        fly_in_numpy(scenario, model, float(first["trim_input_thrust"]), numpy_samples)
        return numpy_samples

    times = in_turns({"numpy": numpy, "compiled": compiled}, rounds)
    steps = [seconds / scenario.samples for seconds in flights[1:]]
    return {
        "point_mass_us_per_step": statistics.median(steps) * 1e6,
        "point_mass_us_per_step_best": min(steps) * 1e6,
        "point_mass_60_s_ms": statistics.median(flights[1:]) * 1e3,
        "numpy_us_per_step": statistics.median(times["numpy"]) * 1e6,
        "point_mass_vs_numpy": ratio(times["numpy"], steps),
    }


def dispersed(cases: int) -> list[Scenario]:
    """The paper with faults of every size and time, and real sensors of every seed."""
    base = load_scenario("paper", ["sensors.profile='tactical'", "loop.name='robust'"])
    fault = base.fault[0]
    return [
        base.model_copy(
            update={
                "seed": case,
                "fault": (
                    fault.model_copy(
                        update={"effectiveness": 0.5 + 0.4 * (case % 11) / 11, "start": 15.0 + case % 9}
                    ),
                ),
            }
        )
        for case in range(cases)
    ]  # fmt: skip


def _batch_seconds(scenarios: list[Scenario]) -> float:
    started = time.perf_counter()
    fly_batch(scenarios)
    return time.perf_counter() - started


def measure_flights(cases: int = 60) -> dict[str, float]:
    """Dispersed 60 s flights a second in one compiled call: one process and two."""
    scenarios = dispersed(cases)
    _batch_seconds(scenarios[:2])
    one = cases / statistics.median(_batch_seconds(scenarios) for _ in range(3))
    elapsed = in_two_processes(_batch_seconds, [scenarios[:2]] * 4, [scenarios] * 2)
    two = 2 * cases / elapsed
    return {"point_mass_flights_per_s": one, "point_mass_flights_per_s_2_processes": two}


def measure_linearity() -> dict[str, float]:
    """Time of a step in an hour of flight over that in a minute."""
    works = {}
    for name, duration in (("minute", 60), ("hour", 3600)):
        scenario = load_scenario("nominal", ['model="paper"', f"duration={duration}"])

        def work(scenario: Scenario = scenario) -> int:
            fly(scenario, (_watch,))
            return scenario.samples

        works[name] = work
    times = in_turns(works, 2)
    return {"hour_vs_minute_per_step": ratio(times["hour"], times["minute"])}
