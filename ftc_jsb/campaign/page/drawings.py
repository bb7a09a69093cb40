"""Drawings of the page as SVG in the page's own colours: distributions, maps of failures, ROC curves."""

import math
from collections.abc import Sequence
from typing import NamedTuple

import markupsafe
import numpy as np
import numpy.typing as npt

Array = npt.NDArray[np.float64]
WIDTH, HEIGHT = 460, 300  # px of a drawing
LEFT, RIGHT, TOP, BOTTOM = 56, 12, 10, 42  # px around its axes
DASHES = ("", "7 4", "2 3", "7 3 2 3", "11 4")  # px; the first is whole
COLOURS = 6  # that the page's style has
_MOST_POINTS = 3000


class Axes(NamedTuple):
    """Ranges and titles of a drawing."""

    x: tuple[float, float]
    y: tuple[float, float]
    x_title: str
    y_title: str

    def place(self, x: float, y: float) -> tuple[float, float]:
        """Where a point is drawn [px]."""
        across = (x - self.x[0]) / (self.x[1] - self.x[0])
        up = (y - self.y[0]) / (self.y[1] - self.y[0])
        inner = WIDTH - LEFT - RIGHT, HEIGHT - TOP - BOTTOM
        return LEFT + across * inner[0], TOP + (1.0 - up) * inner[1]


Named = tuple[str, Array, Array]  # name, x and y of a line


def curves(
    axes: Axes, lines: Sequence[Named], marks: Sequence[float] = (), chance: bool = False
) -> markupsafe.Markup:
    """Lines with their names, told apart by colour and dash.

    Args:
        axes: that they are drawn on.
        lines: named.
        marks: where there are dashed verticals.
        chance: draw what a coin would do, from the lower left to the upper right, and the names below it.
    """
    parts = [_frame(axes)]
    if chance:
        ends = (*axes.place(axes.x[0], axes.y[0]), *axes.place(axes.x[1], axes.y[1]))
        parts.append('<path class="mark" d="M{:.1f} {:.1f}L{:.1f} {:.1f}"/>'.format(*ends))
    for mark in marks:
        (x, low), (_, high) = axes.place(mark, axes.y[0]), axes.place(mark, axes.y[1])
        parts.append(
            f'<line class="mark" x1="{x:.1f}" x2="{x:.1f}" y1="{low:.1f}" y2="{high:.1f}"/>'
        )
    for number, (name, xs, ys) in enumerate(lines):
        places = " ".join(
            "{:.1f},{:.1f}".format(*axes.place(x, y)) for x, y in zip(xs, ys, strict=True)
        )
        colour = f"var(--line-{number % COLOURS})"
        dash = f' stroke-dasharray="{DASHES[number % len(DASHES)]}"' if number else ""
        stroke = f'fill="none" stroke="{colour}" stroke-width="1.8"{dash}'
        parts.append(f'<polyline {stroke} points="{places}"/>')
        row = (
            HEIGHT - BOTTOM - 12 - 15 * (len(lines) - 1 - number)
            if chance
            else TOP + 14 + 15 * number
        )
        at, anchor, sample = (
            (WIDTH - RIGHT - 42, "end", WIDTH - RIGHT - 36)
            if chance
            else (LEFT + 46, "start", LEFT + 10)
        )
        parts.append(f'<path {stroke} d="M{sample} {row - 4}h30"/>')
        parts.append(
            f'<text x="{at}" y="{row}" text-anchor="{anchor}" fill="{colour}">{markupsafe.escape(name)}</text>'
        )
    return _svg(parts, axes)


def failures(axes: Axes, x: Array, y: Array, failed: npt.NDArray[np.bool_]) -> markupsafe.Markup:
    """A map of cases: crosses where they failed, dots where not."""
    step = max(1, math.ceil(x.size / _MOST_POINTS))
    parts = [_frame(axes)]
    for across, up, bad in zip(x[::step], y[::step], failed[::step], strict=True):
        if not (math.isfinite(across) and math.isfinite(up)):
            continue
        a, b = axes.place(across, up)
        if bad:
            parts.append(f'<path class="bad" d="M{a - 3:.1f} {b - 3:.1f}l6 6m0 -6l-6 6"/>')
        else:
            parts.append(f'<circle class="good" cx="{a:.1f}" cy="{b:.1f}" r="1.7"/>')
    return _svg(parts, axes)


def span(values: Array) -> tuple[float, float]:
    """Range of an axis that shows all of `values`, with some room at its ends."""
    finite = values[np.isfinite(values)]
    low, high = (float(finite.min()), float(finite.max())) if finite.size else (0.0, 1.0)
    room = 0.04 * (high - low) if high > low else 0.5
    return low - room, high + room


def _frame(axes: Axes) -> str:
    right, bottom = WIDTH - RIGHT, HEIGHT - BOTTOM
    parts = [f'<path class="axis" d="M{LEFT} {TOP}V{bottom}H{right}"/>']
    for value in _ticks(axes.x):
        x, _ = axes.place(value, axes.y[0])
        parts.append(_tick("middle", x, bottom + 15.0, value))
    for value in _ticks(axes.y):
        _, y = axes.place(axes.x[0], value)
        parts.append(_tick("end", LEFT - 6.0, y + 4.0, value))
    middle = (LEFT + right) / 2
    parts.append(
        f'<text text-anchor="middle" x="{middle:.0f}" y="{HEIGHT - 8}">{markupsafe.escape(axes.x_title)}</text>'
    )
    upright = (TOP + bottom) / 2
    parts.append(
        f'<text text-anchor="middle" transform="translate(13 {upright:.0f}) rotate(-90)">'
        f"{markupsafe.escape(axes.y_title)}</text>"
    )
    return "".join(parts)


def _tick(anchor: str, x: float, y: float, value: float) -> str:
    return (
        f'<text class="tick" text-anchor="{anchor}" x="{x:.1f}" y="{y:.1f}">{_number(value)}</text>'
    )


def _number(value: float) -> str:
    return f"{value:.4g}".replace("-", "\u2212")


def _ticks(span: tuple[float, float]) -> list[float]:
    """Round numbers in a range, four to eight of them."""
    raw = (span[1] - span[0]) / 5.0
    power = 10.0 ** math.floor(math.log10(raw))
    step = min((f * power for f in (1.0, 2.0, 5.0, 10.0)), key=lambda size: abs(size - raw))
    first = math.ceil(span[0] / step - 1e-9)
    return [k * step for k in range(first, math.floor(span[1] / step + 1e-9) + 1)]


def _svg(parts: Sequence[str], axes: Axes) -> markupsafe.Markup:
    title = markupsafe.escape(f"{axes.y_title} over {axes.x_title}")
    return markupsafe.Markup(
        f'<svg class="drawing" viewBox="0 0 {WIDTH} {HEIGHT}" role="img" aria-label="{title}">'
        + "".join(parts)
        + "</svg>"
    )
