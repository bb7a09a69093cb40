"""What `ftc-jsb campaign` does between its options and its files: progress, messages, exit codes."""

import sys
import time
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import TYPE_CHECKING, Any, NamedTuple

import click

from ftc_jsb.cli.exit_codes import INTERRUPTED
from ftc_jsb.cli.printing import message, progress_line

if TYPE_CHECKING:
    from ftc_jsb.campaign.case import Bases

EVERY = 10.0  # [s] between two lines of progress


class Options(NamedTuple):
    """Of the command."""

    out: Path | None
    force: bool
    workers: int | None
    scheduler: str | None
    resume: bool
    search: bool
    dry_run: bool


class Rate:
    """Says how far a campaign is, how fast, and how long it will take, as lines on the standard error."""

    def __init__(self) -> None:
        """Starts the clock."""
        self._started = self._said = time.monotonic()
        self._first: int | None = None

    def __call__(self, done: int, total: int, seconds: float) -> None:
        """Args: cases done and in all; seconds of the last batch."""
        now = time.monotonic()
        if self._first is None:
            self._first, self._began = done, now
        if now - self._said < EVERY and done < total:
            return
        self._said = now
        if done > self._first:
            rate = (done - self._first) / (now - self._began)
            left = (total - done) / rate
            progress_line(f"{done} of {total} cases, {rate:.3g} cases/s, {duration(left)} left")
        else:
            progress_line(f"{done} of {total} cases")


def duration(seconds: float) -> str:
    """A time in the unit that suits it."""
    for unit, length in (("h", 3600.0), ("min", 60.0)):
        if seconds >= 2 * length:
            return f"{seconds / length:.1f} {unit}"
    return f"{seconds:.0f} s"


def run(bases: "Bases", options: Options) -> None:
    """Fly a campaign or search it, and write its report."""
    from ftc_jsb.campaign.adaptive import search_campaign, subset_campaign
    from ftc_jsb.campaign.run import fly_campaign
    from ftc_jsb.cli.announcement import compiling
    from ftc_jsb.runs.output_folder import output_folder

    fly = fly_campaign
    if options.search:
        fly = search_campaign
    elif bases.campaign.subset is not None:
        fly = subset_campaign
    accepted = options.force or options.resume
    with output_folder(options.out, bases.campaign.name, accepted) as folder:
        compiling()
        try:
            with _cluster(options) as client:
                flown = fly(bases, folder, client, options.resume, Rate())
        except KeyboardInterrupt:
            message(f"interrupted; what was flown is saved: go on with --resume --out {folder}")
            sys.exit(INTERRUPTED)
        why = ", stopped by its rule" if flown.stopped else ""
        progress_line(f"{flown.cases} cases{why}; {flown.flown_now} of them flown now")
        summarize(folder)


def dry_run(bases: "Bases", options: Options) -> None:
    """Say how many flights a campaign has, and about how long they take."""
    import os

    from ftc_jsb.campaign.case import flights_of
    from ftc_jsb.campaign.run import seconds_a_case
    from ftc_jsb.cli.announcement import compiling

    campaign = bases.campaign
    each, cases = len(flights_of(bases)), campaign.count
    if options.search:
        each, cases = 1, campaign.search.flights * (2 if campaign.search.baseline else 1)
    elif campaign.subset is not None:
        each, cases = 1, campaign.subset.samples * campaign.subset.levels
    click.echo(f"{cases} cases of {each} flights: {cases * each} flights")
    if campaign.stop is not None:
        click.echo("at most: the rule of [stop] may end it before")
    if options.scheduler is not None:
        return
    compiling()
    workers = options.workers or os.cpu_count() or 1
    seconds = seconds_a_case(bases)
    click.echo(
        f"about {duration(cases * seconds / workers)} on {workers} workers "
        f"(case 0 took {seconds:.2f} s here)"
    )


def summarize(folder: Path) -> None:
    """Write and print the summary of a campaign's folder."""
    from ftc_jsb.campaign.report import write_campaign_report

    document = write_campaign_report(folder)
    for line in document["lines"]:
        click.echo(line)
    click.echo(f"Report: {folder / 'report.html'}")


def write_case(
    folder: Path, number: int, rows: list[dict[str, Any]], recordings: dict[str, bytes], place: Path
) -> None:
    """Write the recordings of a case, and their report."""
    from ftc_jsb.cli.written_report import write_and_print
    from ftc_jsb.runs.recordings import labelled_recordings

    paths = []
    for label, contents in recordings.items():
        path = place / f"{label}.nc"
        path.write_bytes(contents)
        paths.append(path)
    for row in rows:
        if row["error"] is not None:
            message(f"case {number}, {row['model']}, {row['loop']}: {row['error']}")
    if paths:
        flights, _, files = labelled_recordings(paths)
        write_and_print(flights, place, as_json=False, recordings=files)


@contextmanager
def _cluster(options: Options) -> "Iterator[Any]":
    from ftc_jsb.campaign.cluster import connected

    with connected(options.scheduler, options.workers) as client:
        progress_line(f"Dashboard: {client.dashboard_link}")
        yield client
