"""A magnified piece of a panel around the fault, where the panel has room for it."""

import itertools
from typing import NamedTuple

import numpy as np
import numpy.typing as npt
from matplotlib.axes import Axes
from matplotlib.lines import Line2D

Array = npt.NDArray[np.float64]

SIZES = ((0.34, 0.36), (0.28, 0.3))  # of the panel, the first that fits
LEFT, BELOW, EDGE = 0.10, 0.12, 0.03  # of the panel, to its frame; with the inset's tick labels
STEPS = 12  # places tried along each side
LETTER = (0.09, 0.85)  # right and lower end of the panel's letter
SAMPLES = 400  # of a line, by which a place is judged
LEAST_SIZE = 1.0e-3  # of the panel's height: what is smaller is not worth magnifying
MARGIN = 0.08  # of the magnified height, above and below


class Inset(NamedTuple):
    """Where a panel is magnified, and what."""

    corner: tuple[float, float]  # lower left, in parts of the panel
    size: tuple[float, float]  # likewise
    window: tuple[float, float]  # [s]
    heights: tuple[float, float]


def find_inset(axes: Axes, fault: float | None, before: float, after: float) -> Inset | None:
    """The emptiest place of a panel, for `before` to `after` seconds around a fault.

    Args:
        axes: with all its lines.
        fault: when it sets in [s]; None is never.
        before, after: [s].

    Returns:
        None where there is no room, or nothing to be seen.
    """
    if fault is None:
        return None
    lines = _lines(axes)
    window = (fault - before, fault + after)
    heights = _heights(lines, window)
    low, high = axes.get_ylim()
    if heights is None or heights[1] - heights[0] < LEAST_SIZE * (high - low):
        return None
    points = np.concatenate([_in_parts(axes, line) for line in lines])
    for size in SIZES:
        corner = _emptiest(points, size)
        if corner is not None:
            return Inset(corner, size, window, heights)
    return None


def draw_inset(axes: Axes, found: Inset, fault: float) -> None:
    """Draw the lines of a panel once more, magnified."""
    inset = axes.inset_axes((*found.corner, *found.size))
    for line in _lines(axes):
        inset.plot(
            line.get_xdata(), line.get_ydata(), color=line.get_color(),
            linestyle=line.get_linestyle(), linewidth=0.8 * line.get_linewidth(),
        )  # fmt: skip
    inset.axvline(fault, color="#666666", linestyle=":", linewidth=0.7)
    low, high = found.heights
    margin = MARGIN * (high - low)
    inset.set_xlim(found.window)
    inset.set_ylim(low - margin, high + margin)
    inset.tick_params(labelsize=5.5, length=1.5, pad=1.0)
    inset.locator_params(nbins=3)
    inset.set_facecolor("white")
    for spine in inset.spines.values():
        spine.set(visible=True, color="#666666", linewidth=0.5)
    axes.indicate_inset_zoom(inset, edgecolor="#666666", linewidth=0.5, alpha=0.8)


def _lines(axes: Axes) -> list[Line2D]:
    """Curves of a panel; not the marks of its faults."""
    return [line for line in axes.get_lines() if len(np.atleast_1d(line.get_xdata())) > 2]


def _heights(lines: list[Line2D], window: tuple[float, float]) -> tuple[float, float] | None:
    """Least and largest value of all lines in a window of time."""
    found = []
    for line in lines:
        x, y = np.asarray(line.get_xdata(), float), np.asarray(line.get_ydata(), float)
        inside = y[(x >= window[0]) & (x <= window[1]) & np.isfinite(y)]
        if inside.size:
            found += [float(inside.min()), float(inside.max())]
    return (min(found), max(found)) if found else None


def _emptiest(points: Array, size: tuple[float, float]) -> tuple[float, float] | None:
    """Lower left corner, in parts of the panel, where no line passes, far from all; None without one."""
    across = np.linspace(LEFT, 1.0 - EDGE - size[0], STEPS)
    up = np.linspace(BELOW, 1.0 - EDGE - size[1], STEPS)
    free = [
        (float(x), float(y))
        for x, y in itertools.product(across, up)
        if not _passed(points, (x, y), size)
    ]
    return min(free, key=lambda corner: _crowding(points, corner, size), default=None)


def _in_parts(axes: Axes, line: Line2D) -> Array:
    """(samples, 2): a line in parts of its panel, evenly in time."""
    (left, right), (low, high) = axes.get_xlim(), axes.get_ylim()
    x, y = np.asarray(line.get_xdata(), float), np.asarray(line.get_ydata(), float)
    at = np.linspace(left, right, SAMPLES)
    values = np.interp(at, x, y, np.nan, np.nan)
    return np.column_stack([(at - left) / (right - left), (values - low) / (high - low)])


def _passed(points: Array, corner: tuple[float, float], size: tuple[float, float]) -> bool:
    """Whether a line, or the panel's letter, is behind an inset or behind its tick labels."""
    left, low = corner[0] - LEFT + EDGE, corner[1] - BELOW + EDGE
    right, high = corner[0] + size[0] + EDGE, corner[1] + size[1] + EDGE
    letter = left < LETTER[0] and high > LETTER[1]
    inside = (points[:, 0] > left) & (points[:, 0] < right)
    return letter or bool(np.any(inside & (points[:, 1] > low) & (points[:, 1] < high)))


def _crowding(points: Array, corner: tuple[float, float], size: tuple[float, float]) -> float:
    """The nearer lines are to the middle of an inset, the more."""
    middle = np.array(corner) + 0.5 * np.array(size)
    square = np.nansum((points - middle) ** 2, axis=1)
    return float(np.sum(1.0 / (square + 1e-3)))
