"""What `ftc-jsb inner-loop` writes: the numbers designed, the steps' table and figures."""

import shutil
from collections.abc import Callable
from pathlib import Path

import matplotlib.pyplot as plt

from ftc_jsb.aircraft.description import Aircraft, load_aircraft
from ftc_jsb.aircraft.test_range import step_airspeeds
from ftc_jsb.atomic_file import atomic_file, write_text
from ftc_jsb.draft.aircraft_file import draft
from ftc_jsb.inner_loop_design.criteria import criteria_missed
from ftc_jsb.inner_loop_design.design import design, write_design
from ftc_jsb.inner_loop_design.handling import CLASSES, class_of
from ftc_jsb.inner_loop_design.published_steps import fly_steps
from ftc_jsb.inner_loop_design.steps_table import COLUMNS, table_row
from ftc_jsb.report.figures.steps import steps_figure
from ftc_jsb.resources import is_folder
from ftc_jsb.six_dof.weaving.installed import installed_names

DPI = 110


def loaded_or_drafted(name: str, folder: Path, progress: Callable[[str], None]) -> Aircraft:
    """An aircraft: a shipped one or a folder; or an installed one of JSBSim, drafted into `folder/NAME/`.

    Raises:
        AircraftError: there is none, or it cannot be drafted.
    """
    if is_folder(name) or name not in installed_names():
        return load_aircraft(name)
    return load_aircraft(str(draft(name, folder / name, progress).parent))


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
        result = design(one, progress)
        own = folder / one.name
        own.mkdir(exist_ok=True)
        if one.folder != own.resolve():
            shutil.copyfile(one.folder / "aircraft.toml", own / "aircraft.toml")
        write_design(own / "inner_loop.xml", one, result)
        designed.append(load_aircraft(str(own)))
    return designed


def report_steps(aircraft: list[Aircraft], folder: Path) -> tuple[str, list[str]]:
    """Fly the steps of each aircraft; write `steps.md` and `steps-NAME.png`.

    Returns:
        The table, and a sentence for each criterion that is not kept.
    """
    rows = [list(COLUMNS), ["---"] * len(COLUMNS)]
    missed = []
    for one in aircraft:
        handling = CLASSES[class_of(one)]
        flown = fly_steps(one)
        untrimmed = set(step_airspeeds(one)) - {steps.airspeed for steps in flown}
        missed += [f"{one.name}: no trim at {airspeed:g} m/s" for airspeed in sorted(untrimmed)]
        for steps in flown:
            rows.append(table_row(one.name, steps, handling))
            unmet = criteria_missed(steps, handling)
            missed += [f"{one.name} at {steps.airspeed:g} m/s: {what}" for what in unmet]
        if flown:
            figure = steps_figure(one.title, flown)
            with atomic_file(folder / f"steps-{one.name}.png") as part:
                figure.savefig(part, format="png", dpi=DPI)
            plt.close(figure)
    table = "\n".join(f"| {' | '.join(row)} |" for row in rows)
    write_text(folder / "steps.md", table + "\n")
    return table, missed
