"""What the figures for print share: sizes, fonts, line styles, and how they are saved."""

import string
from collections.abc import Iterable, Sequence
from pathlib import Path
from typing import Any, NamedTuple

import matplotlib as mpl
import matplotlib.pyplot as plt
from matplotlib import font_manager
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from ftc_jsb.atomic_file import atomic_file
from ftc_jsb.errors import FigureError

COLUMN = 3.5  # [in], one column of a two-column page
PAGE = 7.16  # [in], both columns
POINTS = 1500  # of a line; more cannot be seen
FORMATS = ("pdf", "svg", "png")

# Okabe and Ito's colours, told apart by every eye; dashes tell them apart in grey.
STYLES: tuple[dict[str, Any], ...] = (
    {"color": "#0072B2", "linestyle": "-"},
    {"color": "#D55E00", "linestyle": (0, (4, 1.5))},
    {"color": "#009E73", "linestyle": (0, (1, 1))},
    {"color": "#CC79A7", "linestyle": (0, (5, 1, 1, 1))},
    {"color": "#56B4E9", "linestyle": (0, (2, 1))},
)
REFERENCE: dict[str, Any] = {"color": "#222222", "linestyle": "-", "linewidth": 0.6}
FAULT: dict[str, Any] = {"color": "#666666", "linestyle": ":", "linewidth": 0.8}
UNOBSERVABLE: dict[str, Any] = {"color": "#bbbbbb", "alpha": 0.35, "lw": 0}

RC: dict[Any, Any] = {
    "font.size": 8.0,
    "axes.titlesize": 8.0,
    "axes.labelsize": 8.0,
    "xtick.labelsize": 7.0,
    "ytick.labelsize": 7.0,
    "axes.grid": True,
    "axes.spines.top": False,
    "axes.spines.right": False,
    "axes.axisbelow": True,
    "grid.color": "#dddddd",
    "grid.linewidth": 0.5,
    "lines.linewidth": 1.1,
    "legend.frameon": False,
    "legend.fontsize": 7.5,
    "figure.constrained_layout.use": True,
    "svg.fonttype": "none",
    "svg.hashsalt": "ftc-jsb",
    "pdf.fonttype": 42,
}


class Print(NamedTuple):
    """What a publisher asks of figures."""

    font: str | None = None  # family; None is matplotlib's own
    width: float | None = None  # [in]; None is a column for one model, else a page
    formats: tuple[str, ...] = FORMATS

    def checked(self) -> "Print":
        """The same.

        Raises:
            FigureError: the font is not installed here.
        """
        generic = ("serif", "sans-serif", "monospace")
        if self.font is not None and self.font not in generic:
            try:
                font_manager.findfont(self.font, fallback_to_default=False)
            except ValueError:
                known = sorted(set(font_manager.get_font_names()))
                raise FigureError(
                    f"--font {self.font}: not installed; expected one of {', '.join((*generic, *known))}"
                ) from None
        return self


def width(columns: int, asked: float | None = None) -> float:
    """Width [in] of a figure with this many models beside each other, unless one is asked for."""
    if asked is not None:
        return asked
    return COLUMN if columns == 1 else PAGE * max(columns, 3) / 3.0


def letter_panels(panels: Iterable[Axes]) -> None:
    """(a), (b), (c) in the upper left corner of each panel; a single one needs none."""
    axes = list(panels)
    for letter, one in zip(string.ascii_lowercase, axes if len(axes) > 1 else [], strict=False):
        one.annotate(
            f"({letter})", (0.0, 1.0), (2.5, -2.5), "axes fraction", "offset points",
            ha="left", va="top", zorder=6,
            bbox={"boxstyle": "square,pad=0.1", "facecolor": "white", "edgecolor": "none", "alpha": 0.75},
        )  # fmt: skip


def save(figure: Figure, folder: Path, name: str, formats: Sequence[str] = FORMATS) -> None:
    """Write a figure in the formats, the same bytes every time, and close it."""
    dates = {"pdf": "CreationDate", "svg": "Date"}
    with mpl.rc_context(RC):
        figure.draw_without_rendering()  # lays out, once for all formats
        figure.set_layout_engine("none")
        for suffix in formats:
            metadata = {dates[suffix]: None} if suffix in dates else None
            with atomic_file(folder / f"{name}.{suffix}") as part:
                figure.savefig(part, format=suffix, dpi=300, metadata=metadata)
    plt.close(figure)
