"""What `ftc-jsb inner-loop` writes: the numbers designed, the steps' table and figures."""

import shutil
from collections.abc import Callable
from pathlib import Path

import matplotlib.pyplot as plt

from ftc_jsb.aircraft.description import Aircraft, load_aircraft
from ftc_jsb.atomic_file import atomic_file, write_text
from ftc_jsb.inner_loop_design.design import design, write_design
from ftc_jsb.inner_loop_design.published_steps import fly_steps
from ftc_jsb.inner_loop_design.steps_table import COLUMNS, table_row
from ftc_jsb.report.figures.steps import steps_figure

DPI = 110


def design_and_report(
    aircraft: list[Aircraft], folder: Path, progress: Callable[[str], None]
) -> list[Aircraft]:
    """Design each inner loop into `folder/NAME/`; the aircraft as they are with it.

    Args:
        aircraft: as loaded; their own folders are left alone.
        folder: that exists.
        progress: told what is being done, a line at a time.
    """
    designed = []
    for one in aircraft:
        progress(f"{one.name}:")
        airframe, references = design(one, progress)
        own = folder / one.name
        shutil.copytree(one.folder, own, dirs_exist_ok=True)
        write_design(own / "inner_loop.xml", one, airframe, references)
        designed.append(load_aircraft(str(own)))
    return designed


def report_steps(aircraft: list[Aircraft], folder: Path) -> str:
    """Fly the steps of each aircraft; write `steps.md` and `steps-NAME.png`. Returns the table."""
    rows = [list(COLUMNS), ["---"] * len(COLUMNS)]
    for one in aircraft:
        flown = fly_steps(one)
        rows += [table_row(one.name, steps) for steps in flown]
        figure = steps_figure(one.title, flown)
        with atomic_file(folder / f"steps-{one.name}.png") as part:
            figure.savefig(part, format="png", dpi=DPI)
        plt.close(figure)
    table = "\n".join(f"| {' | '.join(row)} |" for row in rows)
    write_text(folder / "steps.md", table + "\n")
    return table
