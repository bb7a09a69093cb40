"""All that is measured, in one run, against the targets."""

import statistics
from collections.abc import Callable
from importlib import import_module
from typing import Any, NamedTuple

from ftc_jsb.bench import estimator, point_mass, six_dof, startup

Measured = dict[str, float | None]


class Figure(NamedTuple):
    """A figure and its bound."""

    key: str
    meaning: str
    most: float | None = None
    least: float | None = None


FIGURES: tuple[Figure, ...] = (
    Figure("six_dof_ratio", "JSBSim flight with recording / bare run() loop", most=1.5),
    Figure("six_dof_us_per_sample", "µs a sample of that flight, best chunk"),
    Figure("six_dof_bare_us_per_sample", "µs a sample of the bare loop, best chunk"),
    Figure("second_loop_us_per_step", "a second outer loop in the same flight, µs a step", most=5.0),
    Figure("ukf_vs_filterpy", "FilterPy's UKF step / ours", least=100.0),
    Figure("ukf_vs_augmented", "augmented reference form in NumPy / ours"),
    Figure("ukf_us", "UKF step called from Python, µs"),
    Figure("point_mass_us_per_step", "point-mass flight, µs a step", most=1.5),
    Figure("point_mass_us_per_step_best", "the same, best flight"),
    Figure("point_mass_60_s_ms", "60 s of point-mass flight, ms", most=10.0),
    Figure("point_mass_vs_numpy", "the same loop in NumPy / ours", least=100.0),
    Figure("numpy_us_per_step", "the loop in NumPy, µs a step"),
    Figure("hour_vs_minute_per_step", "a step in 1 h of flight / in 1 min"),
    Figure("point_mass_flights_per_s", "dispersed point-mass flights a second, one process"),
    Figure("point_mass_flights_per_s_2_processes", "the same, two processes"),
    Figure("six_dof_flights_per_s", "JSBSim flights a second, one process"),
    Figure("six_dof_flights_per_s_2_processes", "the same, two processes"),
    Figure("mavlink_core_share", "MAVLink vehicle, share of a core at 1 x"),
    Figure("help_s", "ftc-jsb --help, s", most=0.4),
    Figure("list_s", "ftc-jsb list, s"),
    Figure("check_paper_s", "ftc-jsb check paper, point mass only, s"),
    Figure("fly_paper_s", "ftc-jsb fly paper, s", most=1.5),
    Figure("first_run_s", "ftc-jsb fly paper, kernels not yet compiled, s", most=15.0),
    Figure("peak_rss_mb", "peak memory of ftc-jsb fly paper, MB"),
)  # fmt: skip


def measure_all(progress: Callable[[str], None]) -> Measured:
    """Every figure of FIGURES; None where a part that it needs is not installed.

    Args:
        progress: told what is measured next.
    """
    scenario = six_dof.six_dof_scenario()
    parts: tuple[tuple[str, Callable[[], Any]], ...] = (
        ("start-up", startup.measure_startup),
        ("first run, kernels compiled anew", startup.measure_first_run),
        ("JSBSim flight against the bare loop", lambda: _median_ratio(scenario)),
        ("a second outer loop", lambda: six_dof.measure_second_loop(scenario)),
        ("UKF", estimator.measure_ukf),
        ("point-mass step", point_mass.measure_step),
        ("an hour of flight", point_mass.measure_linearity),
        ("point-mass flights a second", point_mass.measure_flights),
        ("JSBSim flights a second", lambda: six_dof.measure_flights(scenario)),
        ("MAVLink", measure_mavlink_share),
    )
    found: Measured = dict.fromkeys((figure.key for figure in FIGURES), None)
    for number, (title, measure) in enumerate(parts, 1):
        progress(f"[{number}/{len(parts)}] {title}")
        found.update(measure())
    return found


def _median_ratio(scenario: Any) -> Measured:
    """Of three flights, the first of which warms up."""
    flights = [six_dof.measure_ratio(scenario) for _ in range(4)][1:]
    return {key: statistics.median(flight[key] for flight in flights) for key in flights[0]}


def measure_mavlink_share() -> Measured:
    """Share of a core that the MAVLink vehicle takes; None without it."""
    try:
        mavlink = import_module("ftc_jsb.bench.mavlink")
    except ImportError:
        return {"mavlink_core_share": None}
    return {"mavlink_core_share": float(mavlink.measure_mavlink().core_share)}


def lines(found: Measured) -> list[str]:
    """The figures as a table, with what was aimed at."""
    width = max(len(figure.meaning) for figure in FIGURES)
    table = []
    for key, meaning, most, least in FIGURES:
        value = found[key]
        text = "not installed" if value is None else f"{value:.4g}"
        aim = f"≤ {most:g}" if most is not None else f"≥ {least:g}" if least is not None else ""
        table.append(
            f"{meaning:<{width}}  {text:>13}  {aim:>7}  {met_or_missed(value, most, least)}".rstrip()
        )
    return table


def met_or_missed(value: float | None, most: float | None, least: float | None) -> str:
    """`met` or `missed`; nothing where there is no target or no figure."""
    if value is None or (most is None and least is None):
        return ""
    good = (most is None or value <= most) and (least is None or value >= least)
    return "met" if good else "missed"
