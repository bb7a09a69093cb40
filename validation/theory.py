"""Tables of the theory: remainder, bounds, proof, consistency."""

from collections.abc import Iterator
from pathlib import Path

import numpy as np

from ftc_jsb.analysis.input_remainder import flight_remainder
from ftc_jsb.analysis.lyapunov_bound import flight_stability
from ftc_jsb.report.figures.consistency import consistency_figure
from ftc_jsb.runs.theory import LOOPS, analyse, fly_case, foresee
from ftc_jsb.scenario.load import load_scenario
from ftc_jsb.simulation.fly import fly
from ftc_jsb.theory.bounds import bounds
from ftc_jsb.theory.systems import CASES, fighter_by_velocity, textbook_plant
from validation.flights import measured
from validation.noisy import noisy_flights

IMAGES = Path(__file__).parents[1] / "docs" / "images"


def remainder_table() -> Iterator[str]:
    """Proposition 4 and Remark 5 along the paper's flight."""
    yield "| trim input | largest norm of O(.) | RMS |"
    yield "|---|---|---|"
    for zeta in (5, 10, 20, 30, 40, 50, 100, 200):
        size = flight_remainder(fly(load_scenario("paper", [f"loop.trim_filter={zeta}"])))
        yield f"| (10), ζ = {zeta} 1/s | {size.max():.3g} | {np.sqrt(np.mean(size**2)):.3g} |"
    flight = fly(load_scenario("paper"))
    for delay in (0.2, 0.1, 0.05, 0.02, 0.01):
        size = flight_remainder(flight, delay)
        yield f"| u(t − {delay:g} s) | {size.max():.3g} | {np.sqrt(np.mean(size**2)):.3g} |"


def stability_table() -> Iterator[str]:
    """(37)-(40), predicted and flown, along flights of the model `paper`."""
    yield "| loop | λ [1/s] | φ | ball (40) | error predicted | largest error | factor | obeys |"
    yield "|" + "---|" * 8
    for loop in ("ftc", "ekf", "oracle", "no-ftc"):
        proof = flight_stability(fly(load_scenario("paper", [f"loop.name={loop}"])))
        predicted, largest = proof.predicted.max(), proof.error.max()
        yield (
            f"| {loop} | {proof.rate:.2f} | {proof.disturbance:.3g} | {proof.radius:.3g} "
            f"| {predicted:.3g} | {largest:.3g} | {predicted / largest:.1f} "
            f"| {'yes' if proof.obeyed else 'no'} |"
        )


def systems_table() -> Iterator[str]:
    """The proof on every system that `ftc-jsb theory` ships."""
    yield "| system | loop | largest error of each component | predicted | obeys |"
    yield "|" + "---|" * 5
    for name in CASES:
        analysis = analyse(CASES[name]())
        expected = foresee(analysis)
        for loop in LOOPS:
            history, proof, problem, _ = fly_case(analysis, loop, 0, expected)
            if proof is None:
                yield f"| {name} | {loop} | {problem} | | |"
                continue
            largest, most = np.abs(history.error).max(axis=0), proof.predicted_each.max(axis=0)
            yield (
                f"| {name} | {loop} | {', '.join(format(v, '.2g') for v in largest)} "
                f"| {', '.join(format(v, '.2g') for v in most)} "
                f"| {'yes' if proof.obeyed else '; '.join(proof.broken)} |"
            )


def loops_table() -> Iterator[str]:
    """Every loop that tracks the velocity on the paper's scenario."""
    yield "| model | loop | RMSE V [m/s] | path [deg] | heading [deg] | effectiveness error max |"
    yield "|" + "---|" * 6
    for model in ("paper", "identified", "jsbsim"):
        for loop in ("ftc", "ekf", "integral", "oracle", "no-ftc"):
            one = measured("paper", f"model={model}", f"loop.name={loop}")
            error = one["effectiveness_thrust_error_max"]
            yield (
                f"| {model} | {loop} | {one['rmse_airspeed_mps']:.3g} "
                f"| {one['rmse_flight_path_deg']:.4f} | {one['rmse_heading_deg']:.4f} "
                f"| {'–' if error is None else format(error, '.2g')} |"
            )


def bounds_table() -> Iterator[str]:
    """L_1, g_M, L_2 and M of (8)-(9) over the ranges of the systems."""
    yield "| system | units of the inputs | L₁ = g_M | L₂ | M | certified |"
    yield "|---|---|---|---|---|---|"
    fighter = fighter_by_velocity()
    for system, words, units in (
        (textbook_plant(), "1", {}),
        (fighter, "T in 100 kN", {fighter.inputs[0]: 1e5}),
    ):
        found = bounds(system, units)
        certified = found.gain.certified and found.curvature.certified
        yield (
            f"| {system.name} | {words} | {found.gain} | {found.remainder} | {found.curvature} "
            f"| {'yes' if certified else 'no: at least'} |"
        )


def consistency_section() -> Iterator[str]:
    """NEES and NIS of 200 noisy flights, and the figure."""
    found = {channels: noisy_flights(channels) for channels in (1, 3)}
    figure = consistency_figure(found, 0.01)
    figure.savefig(IMAGES / "consistency.png", dpi=150)
    yield "| estimated channels | NEES inside its band [% of the time] | NIS [%] |"
    yield "|---|---|---|"
    for channels, result in found.items():
        nees, nis = result.inside()
        yield f"| {channels} | {100 * nees:.1f} | {100 * nis:.1f} |"
    yield ""
    yield "![NEES and NIS of 200 flights with their bands](images/consistency.png)"
