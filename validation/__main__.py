"""`make validate`: many flights and long ones, measured and written to docs/validation.md."""

import datetime
import sys
from collections.abc import Callable, Iterator
from concurrent.futures import ProcessPoolExecutor
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np

from ftc_jsb.analysis.verdict import passed
from ftc_jsb.errors import UserError
from ftc_jsb.recording.provenance import versions
from ftc_jsb.scenario.load import load_scenario, scenario_names
from validation import envelope, instruments, margins, missions, transports
from validation.campaigns import robustness_section
from validation.check_cases import section as check_cases
from validation.cost import cost_table, long_flights
from validation.fighters import SCENARIOS, fighters_table
from validation.flights import measured, random_manoeuvre
from validation.isolation import table as isolation
from validation.robust import false_alarms_table, fighters_robust_table, robust_table
from validation.theory import (
    bounds_table,
    consistency_section,
    loops_table,
    remainder_table,
    stability_table,
    systems_table,
)

TARGET = Path(__file__).parents[1] / "docs" / "validation.md"
PROCESSES = 2


def scenarios_table() -> Iterator[str]:
    """Every shipped scenario on every model."""
    yield (
        "| scenario | model | RMSE V with FTC [m/s] | without [m/s] | path [deg] | heading [deg] "
        "| effectiveness error 95 % | max | detection [s] | false alarms | at a limit [%] | verdict |"
    )
    yield "|" + "---|" * 12
    elsewhere = {"helix", "turbulence", *SCENARIOS.values(), *transports.SCENARIOS} - {"paper"}
    for name in (n for n in scenario_names() if n not in elsewhere):
        for model in load_scenario(name).compare.models:
            one = measured(name, f"model={model}")
            other = measured(name, f"model={model}", "loop.name=no-ftc")
            delay = one["detection_delay_s"]
            yield (
                f"| {name} | {model} | {one['rmse_airspeed_mps']:.3g} | {other['rmse_airspeed_mps']:.3g} "
                f"| {one['rmse_flight_path_deg']:.4f} | {one['rmse_heading_deg']:.4f} "
                f"| {one['effectiveness_thrust_error_p95']:.2g} "
                f"| {one['effectiveness_thrust_error_max']:.2g} "
                f"| {'–' if delay is None else format(delay, '.2f')} | {one['false_alarms']} "
                f"| {100 * one['saturated_fraction']:.0f} "
                f"| {'inside limits' if passed(one) else 'limit broken'} |"
            )


def path_table() -> Iterator[str]:
    """The helix by position and by velocity."""
    yield "| model | loop | RMS distance [m] | largest [m] | RMSE V [m/s] | effectiveness error max |"
    yield "|" + "---|" * 6
    for model in ("paper", "identified", "jsbsim"):
        for loop in ("path", "ftc"):
            one = measured("helix", f"model={model}", f"loop.name={loop}")
            yield (
                f"| {model} | {loop} | {one['rmse_position_m']:.2f} "
                f"| {one['peak_error_position_m']:.2f} | {one['rmse_airspeed_mps']:.3f} "
                f"| {one['effectiveness_thrust_error_max']:.2g} |"
            )


def assumptions_table() -> Iterator[str]:
    """What the paper's conclusions owe to what the paper does not say."""
    yield (
        "| what is varied | RMSE V with FTC [m/s] | without [m/s] | ratio "
        "| estimate within 0.01 after [s] |"
    )
    yield "|---|---|---|---|---|"
    variations: dict[str, list[str]] = {"as shipped": []}
    for k in (0.4, 0.5, 0.7, 0.8, 0.9):
        variations[f"effectiveness {k}"] = [f"fault[0].effectiveness={k}"]
    for start in (5, 12, 30, 40):
        variations[f"fault at {start} s"] = [f"fault[0].start={start}"]
    for factor in (1e-2, 1e2):
        p0 = [factor * value for value in (1e-6, 1e-8, 1e-6, 1e-4)]
        variations[f"P0 x {factor:g}"] = [f"loop.estimator.initial_covariance={p0}"]
    for rate in (20, 50, 200, 400):
        variations[f"outer loop at {rate} Hz"] = [f"loop.rate={rate}"]
    for zeta in (5, 10, 20):
        variations[f"trim filter {zeta} 1/s"] = [f"loop.trim_filter={zeta}"]
    for name, overrides in variations.items():
        law = ("loop.priority=none", *overrides)  # the paper's alone
        one, other = measured("paper", *law), measured("paper", "loop.name=no-ftc", *law)
        start = load_scenario("paper", overrides).fault[0].start
        ratio = other["rmse_airspeed_mps"] / one["rmse_airspeed_mps"]
        yield (
            f"| {name} | {one['rmse_airspeed_mps']:.3g} | {other['rmse_airspeed_mps']:.3g} "
            f"| {ratio:.0f} | {one['last_wrong_s'] - start:.2f} |"
        )


def random_flight(seed: int) -> dict[str, Any]:
    """One random manoeuvre on the JSBSim F-16."""
    return measured("paper", "model=jsbsim", *random_manoeuvre(seed))


def random_table(count: int) -> Iterator[str]:
    """Seeded random manoeuvres on the JSBSim F-16, none of which was tuned to."""
    with ProcessPoolExecutor(PROCESSES) as pool:
        flights = list(pool.map(random_flight, range(1000, 1000 + count)))
    yield "| number | median | 95 % | worst |"
    yield "|---|---|---|---|"
    for key, title in (
        ("rmse_airspeed_mps", "RMSE V [m/s]"),
        ("rmse_flight_path_deg", "RMSE path [deg]"),
        ("rmse_heading_deg", "RMSE heading [deg]"),
        ("effectiveness_thrust_error_p95", "effectiveness error, 95 % of samples"),
        ("effectiveness_thrust_error_max", "effectiveness error, max"),
        ("detection_delay_s", "detection delay [s]"),
        ("false_alarms", "false alarms"),
        ("peak_sideslip_deg", "peak sideslip [deg]"),
    ):
        values = np.array([np.nan if f[key] is None else f[key] for f in flights], dtype=float)
        missing = int(np.isnan(values).sum())
        note = f" ({missing} not declared)" if missing else ""
        yield (
            f"| {title}{note} | {np.nanmedian(values):.4g} | {np.nanpercentile(values, 95):.4g} "
            f"| {np.nanmax(values):.4g} |"
        )
    good = sum(passed(flight) for flight in flights)
    yield f"\n{good} of {count} flights stayed inside every limit."


class Section(NamedTuple):
    """A part of the page: what is flown, and the lines that it gives."""

    title: str
    words: str
    lines: Callable[[], Iterator[str]]


SECTIONS = tuple(
    Section(*each)
    for each in (
        (
            "Every shipped scenario on every model",
            "The estimate is judged outside the first 2 s and 2 s after each fault step. Fighters, transports, "
            "turbulence and the helix have tables of their own.",
            scenarios_table,
        ),
        (
            "Five fighters",
            "The paper's manoeuvre on each JSBSim fighter at the highest speed up to 300 m/s at which 0.6 "
            "of its thrust is 1.15 times what it needs (`validation/fighters.py` finds it; angles "
            "scaled down where no speed does). Last: the identified point mass against it.",
            fighters_table,
        ),
        (transports.TITLE, transports.WORDS, transports.transports_table),
        (
            "A climbing helix",
            "Scenario `helix`: 250 m/s, 4°/s, 4° of climb, thrust effectiveness 0.7 from 40 s; the loop "
            "`path` tracks the position, the paper's loop the velocity.",
            path_table,
        ),
        (
            "What the paper does not say",
            "The paper gives neither size nor time of the fault, nor P0, nor the sample time. Its "
            "conclusion, that the loop with the estimate tracks the airspeed far better, does not hang "
            "on these guesses as long as the thrust that is left can pay for the manoeuvre. At "
            "effectiveness 0.5 and below it cannot: thrust saturates, and knowing the effectiveness "
            "buys little. (Model `paper`.)",
            assumptions_table,
        ),
        (
            "Sensors and turbulence",
            "The paper's scenario on the JSBSim F-16 with seeds 0 to 19 (one flight where nothing is random): "
            '`sensors.profile = "tactical"`, `wind.turbulence = "moderate"`, and parts of them. Wanted '
            "of the line in bold: 95 % within 0.04, detection within 1.5 s. RMSE of the airspeed is "
            "mostly the gusts themselves.",
            robust_table,
        ),
        (
            "Sensors and turbulence, five fighters",
            "Drag grows with |sideslip|, on the F-15 by 4 per rad in C_D: a gust of 0.6° is 60 kN there, and "
            "a vane that is 0.1° off errs by 10 kN of the 50 kN of thrust. On the F-15, and less so "
            "on the T-38, that is the limit of the estimate. A slower vane with its mean taken off made it "
            "worse: the mean of twenty seconds of gusts is no zero.",
            fighters_robust_table,
        ),
        (instruments.TITLE, instruments.WORDS, instruments.instruments_table),
        (isolation.TITLE, isolation.WORDS, isolation.table),
        (envelope.TITLE, envelope.WORDS, envelope.envelope_section),
        (missions.TITLE, missions.WORDS, missions.missions_section),
        (
            "Hours without a fault",
            "Ten paper manoeuvres in a row on the JSBSim F-16, tactical sensors, moderate turbulence, "
            "seeds 0 to 19.",
            false_alarms_table,
        ),
        (margins.TITLE, margins.WORDS, margins.margins_section),
        (
            "Sixty random manoeuvres on the JSBSim F-16",
            "Turns, climbs, speeds, altitudes and faults from seeds 1000 to 1059 "
            "(`validation/flights.py`, `random_manoeuvre`); nothing was tuned to them.",
            lambda: random_table(60),
        ),
        (
            "The remainder of the affine form",
            "‖O(·)‖ of (7) along the paper's flight, errors scaled by 1 m/s and 1°: with the trim "
            "filter (10) over Remark 5's range and beyond, and with the delayed input u(t − τ) that the "
            "paper improves on. A filter (10) lags by 1/ζ, and compares with a delay of that size: what "
            "the filter buys is not a smaller remainder for the same lag, but no memory of past inputs.",
            remainder_table,
        ),
        (
            "Constants of Assumption 2 and Proposition 4",
            "Suprema over the ranges of the systems (`theory/systems/`), effectiveness 0.3 to 1, enclosed by "
            "ball arithmetic between a value that was met and one that is proven.",
            bounds_table,
        ),
        (
            "The proof in numbers",
            "(37)–(40) with K = I, Q = I, H = I/2 and μ₁ at half its limit, errors scaled by 1 m/s and "
            "1°, predicted from constants over a box and the flight of section 3 ([theory](theory.md"
            "#the-proof-in-numbers)). The ball takes the largest φ as if it lasted; the error predicted takes "
            "φ(t) with the best μ₁.",
            stability_table,
        ),
        (
            "The proof on other systems",
            "The cases that `ftc-jsb theory` ships ([theory](theory.md#systems)), in their own units: an error "
            "and its derivatives below the index, of one output after another.",
            systems_table,
        ),
        (
            "Loops",
            "The paper's scenario by each loop that tracks the velocity.",
            loops_table,
        ),
        (
            "Consistency of the filter",
            "200 seeded flights of the filter's own model whose plant noise is the filter's Q and R "
            "(`analysis/consistency.py`, `validation/noisy.py`): averages of NEES and NIS against "
            "their 95 % χ² bands. With the paper's Q and R on the paper's noiseless plant, or on the "
            "F-16, the filter is not consistent and its σ is no confidence: Q and R are settings there.",
            consistency_section,
        ),
        (
            "Campaign `robustness`",
            "The first cases of the shipped [campaign](campaigns.md): five fighters, everything dispersed at "
            "once; probability of leaving a limit with its 95 % interval. Failures of `robust` by what they "
            "come from: the same case without its fault fails, too; thrust for no loop: even with path and "
            "airspeed given up as far as their limits, k T_max is less than the references need, by the drag "
            "measured on the healthy twin; thrust short: k T_max is less than the references need for a "
            "second or more before the limit breaks; thrust enough: neither.",
            robustness_section,
        ),
        (check_cases.TITLE, check_cases.WORDS, check_cases.check_cases_section),
        (
            "Cost of a step",
            "Called from Python, median of 7 times 20 000 calls on the machine of this page.",
            cost_table,
        ),
        (
            "Long flights",
            "In memory, 100 Hz, JSBSim at 200 Hz, full internal fuel: with 0.43 of it the F-16 runs dry "
            "after 35 min.",
            long_flights,
        ),
    )
)


def section(each: Section, day: str) -> str:
    """Fly a section; its part of the page."""
    print(each.title, file=sys.stderr, flush=True)
    return "\n".join([f"## {each.title}", "", each.words, day, "", *each.lines()]) + "\n"


def main(wanted: list[str]) -> int:
    """Fly everything, or the sections whose titles hold a part that is wanted, and write the page.

    Args:
        wanted: parts of titles; none: everything.

    Returns:
        Exit code: 2 where no title holds any of them.
    """
    chosen = [
        s for s in SECTIONS if not wanted or any(w.lower() in s.title.lower() for w in wanted)
    ]
    if not chosen:
        print(f"{wanted}: no section of that name; expected a part of one of:", file=sys.stderr)
        print("\n".join(each.title for each in SECTIONS), file=sys.stderr)
        return 2
    today = datetime.datetime.now(datetime.UTC).date()
    made = ", ".join(f"{name} {version}" for name, version in versions().items())
    parts = {}
    if wanted and TARGET.is_file():
        for part in TARGET.read_text(encoding="utf-8").split("\n## ")[1:]:
            parts[part.partition("\n")[0]] = f"## {part.rstrip()}\n"
    for each in chosen:
        parts[each.title] = section(each, f"(Flown on {today}.)")
    lines = [
        "# Validation",
        "",
        f"Made by `make validate`, or by `python -m validation TITLE` for a section; last with {made}.",
        "What each number means is in [the scenario guide](scenarios.md#metrics).",
        "",
    ]
    page = "\n".join(lines) + "\n" + "\n".join(parts[s.title] for s in SECTIONS if s.title in parts)
    TARGET.write_text(page, encoding="utf-8")
    print(f"Written: {TARGET}")
    return 0


if __name__ == "__main__":
    try:
        sys.exit(main(sys.argv[1:]))
    except UserError as error:
        sys.exit(str(error))
