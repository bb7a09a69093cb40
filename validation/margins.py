"""Margins of the outer loop on every JSBSim aircraft: `python -m validation.margins` prints the
table and draws the figure of docs/margins.md.
"""

from collections.abc import Iterator
from concurrent.futures import ProcessPoolExecutor
from pathlib import Path

from ftc_jsb.errors import UserError
from ftc_jsb.margins.condition import level_scenario
from ftc_jsb.margins.measure import CHANNELS, ChannelMargins, channel_margins
from ftc_jsb.report.figures.bode import bode_figure
from ftc_jsb.report.terminal.margins import margins_table
from ftc_jsb.resources import PAPER_AIRCRAFT, aircraft_names
from ftc_jsb.vocabulary.channels import Channel

IMAGES = Path(__file__).parents[1] / "docs" / "images"
SHOWN = "f16"  # whose frequency responses are drawn
PROCESSES = 2

TITLE = "Margins of the outer loop"
WORDS = (
    "Gain, phase and delay that the loop `ftc` bears at each of its inputs, one at a time, in straight and "
    "level flight of the 6-DOF aircraft at the middle of its test range, estimator on "
    "([margins](margins.md) says how). The first number of a pair is inserted until the loop breaks, the "
    "second is from the frequency response; they must agree to 0.5 dB and to 5 % or a sample. Signals are "
    "small: 20 N, 0.005 g, 0.005 rad."
)


def _measured(name: str, channel: Channel) -> ChannelMargins | str:
    try:
        return channel_margins(level_scenario(name, "jsbsim"), channel, lambda line: None)
    except UserError as error:
        return str(error)


def margins_section() -> Iterator[str]:
    """A row for each aircraft and input; draws the figure of one aircraft."""
    names = [name for name in aircraft_names() if name != PAPER_AIRCRAFT]
    cases = [(name, channel) for name in names for channel in CHANNELS]
    with ProcessPoolExecutor(PROCESSES) as pool:
        results = list(pool.map(_measured, *zip(*cases, strict=True)))
    heading = margins_table([])[0]
    yield f"| aircraft | condition | {' | '.join(heading)} |"
    yield "|" + "---|" * (len(heading) + 2)
    for (name, channel), found in zip(cases, results, strict=True):
        initial = level_scenario(name, "jsbsim").initial
        condition = f"{initial.airspeed:g} m/s, {initial.altitude:g} m"
        if isinstance(found, str):
            yield f"| {name} | {condition} | {channel} | not measured: {found} |" + " |" * 5
        else:
            yield f"| {name} | {condition} | {' | '.join(margins_table([found])[1])} |"
    drawn = [
        found
        for (name, _), found in zip(cases, results, strict=True)
        if name == SHOWN and not isinstance(found, str)
    ]
    if drawn:
        initial = level_scenario(SHOWN, "jsbsim").initial
        title = f"{SHOWN}, loop ftc, {initial.airspeed:g} m/s, {initial.altitude:g} m"
        bode_figure(title, drawn).savefig(IMAGES / "margins.png", dpi=150)
        yield ""
        yield (
            "![Bode diagrams of the opened loop at thrust, load factor and bank angle of the F-16]"
            "(images/margins.png)"
        )


if __name__ == "__main__":
    for line in margins_section():
        print(line)
