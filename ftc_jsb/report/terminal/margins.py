"""Margins of the outer loop as a table."""

from collections.abc import Sequence

import numpy as np

from ftc_jsb.margins.document import decibel
from ftc_jsb.margins.measure import MOST_DELAY, MOST_GAIN, ChannelMargins
from ftc_jsb.vocabulary.quantities import QUANTITIES


def margins_table(found: Sequence[ChannelMargins]) -> list[list[str]]:
    """Heading and one row for each input; the first number of a pair is inserted, the second response."""
    rows = [["input", "gain [dB]", "at [rad/s]", "phase [°]", "at [rad/s]", "delay [s]", "agree"]]
    for each in found:
        c = each.classical
        rows.append(
            [
                QUANTITIES[each.channel].title,
                f"{_or_more(decibel(each.gain), decibel(MOST_GAIN), '.1f')} / "
                f"{_or_more(decibel(c.gain), decibel(MOST_GAIN), '.1f')}",
                _or_none(c.phase_crossover, ".0f"),
                _or_none(np.degrees(c.phase), ".1f"),
                _or_none(c.gain_crossover, ".2f"),
                f"{_or_more(each.delay, MOST_DELAY, '.3f')} / {_or_more(c.delay, MOST_DELAY, '.3f')}",
                "yes" if each.agree else "NO",
            ]
        )
    return rows


def print_margins(title: str, found: Sequence[ChannelMargins]) -> None:
    """Print the table."""
    from rich.box import SIMPLE_HEAD
    from rich.console import Console
    from rich.table import Table
    from rich.text import Text

    heading, *rows = margins_table(found)
    table = Table(
        title=f"{title}\ngain and delay: inserted / by frequency response",
        box=SIMPLE_HEAD,
        padding=(0, 1, 0, 0),
    )
    for name in heading:
        table.add_column(
            Text(name.replace(" ", "\n")),
            justify="left" if name == "input" else "right",
            no_wrap=True,
        )
    for row in rows:
        table.add_row(*row)
    Console().print(table)


def _or_more(value: float, most: float, form: str) -> str:
    return f"> {most:g}" if value > most else format(value, form)


def _or_none(value: float, form: str) -> str:
    return format(value, form) if np.isfinite(value) else "–"
