"""The check cases' section of docs/validation.md, and its figure."""

from collections.abc import Iterator
from pathlib import Path

import numpy as np

from validation.check_cases.cases import CASES
from validation.check_cases.comparison import Compared, compare

TITLE = "NASA's check cases"
WORDS = (
    "The atmospheric check cases 1 to 10 of NASA/TM-2015-218675, spheres and bricks, flown for 30 s with "
    "the steps, the wind and the recording of every flight here (`validation/check_cases`). Published are"
    " four to six simulations of each, an earlier JSBSim among them; the table has the most that ours is "
    "outside what they span, once a second, and what they span. Latitudes are published to 1 mm. Of the "
    "bricks' rates the first-order method by which JSBSim turns bodies is what is left: half the step "
    "halves it, and the limit is inside to 0.01 mrad/s (`tests/six_dof/test_check_cases.py`). The F-16 "
    "cases (11 to 16) are of another F-16 than that of the jsbsim package and are not flown, nor is the "
    "rocket's (17)."
)
FIGURE = Path(__file__).parents[2] / "docs" / "images" / "check_cases.png"
MILLI = 1e3
SHOWN = {"altitude": "altitude [m]", "east": "east [m]", "airspeed": "airspeed [m/s]"}


def check_cases_section() -> Iterator[str]:
    """Table and figure."""
    flown = {case.number: compare(case) for case in CASES}
    yield (
        "| case | outside: place [mm] | airspeed [mm/s] | rates [mrad/s] | spread: altitude [m] "
        "| airspeed [m/s] |"
    )
    yield "|" + "---|" * 6
    for case in CASES:
        found = flown[case.number]
        place = max(found[name].outside for name in ("north", "east", "altitude"))
        rates = [one.outside for name, one in found.items() if name.endswith("rate")]
        turning = f"{MILLI * max(rates):.1f}" if rates else "–"
        yield (
            f"| {case.number} {case.title} | {MILLI * place:.3f} | {MILLI * found['airspeed'].outside:.3f} "
            f"| {turning} | {found['altitude'].spread:.2g} | {found['airspeed'].spread:.2g} |"
        )
    _draw(flown)
    yield ""
    yield f"![Ten check cases: difference to the published simulations](images/{FIGURE.name})"


def _draw(cases: dict[int, dict[str, Compared]]) -> None:
    """Difference to the middle of the published simulations, and their spread, a row a case."""
    from matplotlib.figure import Figure

    figure = Figure(figsize=(9.0, 1.25 * len(CASES) + 0.8), layout="constrained")
    axes = figure.subplots(len(CASES), len(SHOWN), sharex=True, squeeze=False)
    for row, case in zip(axes, CASES, strict=True):
        for axis, (name, label) in zip(row, SHOWN.items(), strict=True):
            one = cases[case.number][name]
            middle = 0.5 * (one.least + one.most)
            low, high, ours = (
                values[1:] - middle[1:] for values in (one.least, one.most, one.flown)
            )
            seconds = np.arange(1, middle.size)  # in wind some say 0 at first, others the wind
            axis.fill_between(seconds, low, high, color="0.8", lw=0)
            axis.plot(seconds, ours, color="C0", lw=1.2)
            axis.ticklabel_format(axis="y", style="sci", scilimits=(-2, 3), useMathText=True)
            axis.tick_params(labelsize=7)
            axis.yaxis.get_offset_text().set_fontsize(7)
            axis.set_xlim(0, middle.size - 1)
            if case is CASES[0]:
                axis.set_title(label, fontsize=9)
            if case is CASES[-1]:
                axis.set_xlabel("time [s]", fontsize=8)
        row[0].set_ylabel(f"case {case.number}", fontsize=8)
    figure.suptitle(
        "Flown less the middle of the published simulations (line), and their spread (grey)",
        fontsize=10,
    )
    figure.savefig(FIGURE, dpi=110)
