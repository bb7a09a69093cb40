"""Tables of the theory: remainder, bounds, proof, consistency."""

from collections.abc import Iterator
from pathlib import Path

import numpy as np

from ftc_jsb.analysis.input_remainder import flight_remainder
from ftc_jsb.analysis.lyapunov_bound import flight_stability
from ftc_jsb.report.figures.consistency import consistency_figure
from ftc_jsb.scenario.load import load_scenario
from ftc_jsb.simulation.fly import fly
from ftc_jsb.theory.approximation import estimate_bounds
from ftc_jsb.theory.generated import generate
from ftc_jsb.theory.linearization import linearize
from ftc_jsb.theory.systems import fighter_by_velocity, textbook_plant
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
    """(37)-(40) along flights."""
    yield "| model | loop | λ [1/s] | φ | ball radius | largest error | V below its bound |"
    yield "|" + "---|" * 7
    for model in ("paper", "identified", "jsbsim"):
        for loop in ("ftc", "no-ftc"):
            proof = flight_stability(
                fly(load_scenario("paper", [f"model={model}", f"loop.name={loop}"]))
            )
            yield (
                f"| {model} | {loop} | {proof.rate:.2f} | {proof.disturbance:.3g} "
                f"| {proof.radius:.3g} | {proof.error.max():.3g} "
                f"| {'yes' if proof.obeyed else 'no'} |"
            )


def bounds_table() -> Iterator[str]:
    """L_1, g_M and L_2 of (8)-(9) over stated boxes."""
    yield "| system | box | L₁ | g_M | L₂ | largest ‖O‖/‖u − u_n‖ met |"
    yield "|---|---|---|---|---|---|"
    one = np.array([[-1.0, 1.0], [-1.0, 1.0], [-2.0, 2.0]])
    fighter = np.array([[200, 340], [-0.15, 0.15], [-3, 3], [0, 1.1], [0.5, 5], [-1.4, 1.4]], float)
    for system, box, words, scale in (
        (textbook_plant(), one, "x₁, x₂ ∈ [−1, 1], u ∈ [−2, 2]", np.ones(1)),
        (
            fighter_by_velocity(),
            fighter,
            "V 200–340 m/s, γ ±0.15, T 0–110 kN in units of 100 kN, n 0.5–5, bank ±1.4",
            np.array([1e5, 1.0, 1.0]),
        ),
    ):
        kernels = generate(linearize(system))
        n, m = len(system.states), len(system.inputs)
        healthy = np.ones(m)

        def dynamics(x, u, kernels=kernels, n=n, scale=scale, healthy=healthy):
            out = np.zeros(n)
            kernels.dynamics(x, scale * u, healthy, kernels.parameters, out)
            return out

        def gain(x, u, kernels=kernels, n=n, m=m, scale=scale, healthy=healthy):
            out = np.zeros((n, m))
            kernels.trim_gain(x, scale * u, healthy, kernels.parameters, out)
            return out * scale

        found = estimate_bounds(dynamics, gain, box[:, 0], box[:, 1], m)
        yield (
            f"| {system.name} | {words} | {found.lipschitz:.3g} | {found.gain:.3g} "
            f"| {found.remainder:.3g} | {found.remainder_found:.3g} |"
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
