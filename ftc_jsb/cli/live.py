"""What flies beside a flight: nothing, or real time, a MAVLink vehicle and a telemetry log."""

import sys
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import TYPE_CHECKING, NamedTuple

import click

from ftc_jsb.cli.options import FiniteRange, grouped
from ftc_jsb.cli.printing import message
from ftc_jsb.errors import ScenarioError

if TYPE_CHECKING:
    from ftc_jsb.mavlink.link.vehicle_link import Link
    from ftc_jsb.runs.live import Live
    from ftc_jsb.scenario.schema import Scenario

UNTIL_CTRL_C = 1e9  # [s]


class LiveOptions(NamedTuple):
    """As given on the command line."""

    realtime: float | None  # seconds of flight a second
    endpoint: str | None
    sysid: int
    key: Path | None
    readonly: bool
    tlog: Path | None
    linger: float | None  # [s]


live_options = grouped(
    "live", LiveOptions,
    click.option(
        "--realtime", is_flag=False, flag_value=1.0, metavar="[FACTOR]", default=None,
        type=FiniteRange(0.01, 100.0), help="Hold the flight back to the clock, or FACTOR times it.",
    ),
    click.option(
        "--mavlink", "endpoint", metavar="ENDPOINT",
        help="Be a MAVLink vehicle: udpout:HOST:PORT, udpin:HOST:PORT or tcpin:HOST:PORT.",
    ),
    click.option(
        "--sysid", type=click.IntRange(1, 255), default=1, help="System id of the vehicle."
    ),
    click.option(
        "--mavlink-key", "key", metavar="FILE", type=click.Path(path_type=Path),
        help="Pass phrase: frames are signed, and what is not signed is refused.",
    ),
    click.option("--mavlink-readonly", "readonly", is_flag=True, help="Ignore what the ground says."),
    click.option(
        "--tlog", metavar="FILE", type=click.Path(path_type=Path), help="Write a telemetry log."
    ),
    click.option(
        "--linger", metavar="SECONDS", type=FiniteRange(0.0, UNTIL_CTRL_C), default=None,
        help="Time that the vehicle stays after its flight; on a terminal until Ctrl-C, else 0.",
    ),
)  # fmt: skip


@contextmanager
def flying_beside(scenario: "Scenario", options: LiveOptions) -> "Iterator[Live | None]":
    """What flies beside `scenario`, from now to the end of the block.

    Raises:
        ScenarioError: options that contradict each other, or a log that exists.
        LinkError: the endpoint, the key or the log cannot be used.
    """
    _refuse(options)
    if options.realtime is None and options.endpoint is None and options.tlog is None:
        yield None
        return
    from ftc_jsb.mavlink.live import LogOnly, live_flight

    if options.tlog is not None and options.realtime is None and options.endpoint is None:
        yield LogOnly(options.tlog)
        return
    link = _link(options)
    linger = options.linger
    if linger is None:
        linger = UNTIL_CTRL_C if options.endpoint and sys.stderr.isatty() else 0.0
    with live_flight(scenario, options.realtime, link, options.tlog, linger) as beside:
        if beside.note:
            message(f"note: {beside.note}")
        yield beside


def _refuse(options: LiveOptions) -> None:
    if options.endpoint is None and (options.key is not None or options.readonly):
        name = "--mavlink-key" if options.key is not None else "--mavlink-readonly"
        raise ScenarioError(f"{name}: there is no link without --mavlink ENDPOINT")
    if options.tlog is not None and options.tlog.exists():
        raise ScenarioError(f"--tlog {options.tlog}: exists; give another file")


def _link(options: LiveOptions) -> "Link":
    """The link; says so if others than this machine could command over it."""
    from ftc_jsb.mavlink.link.endpoint import parse_endpoint
    from ftc_jsb.mavlink.link.signing import load_key
    from ftc_jsb.mavlink.link.vehicle_link import Link

    link = Link(
        parse_endpoint(options.endpoint) if options.endpoint else None,
        options.sysid,
        load_key(options.key) if options.key else None,
        options.readonly,
    )
    reachable = link.endpoint and link.endpoint.kind != "udpout" and not link.endpoint.is_local
    if reachable and not options.key:
        message(
            f"note: {link.endpoint} can be reached from other machines; --mavlink-key or "
            "--mavlink-readonly keeps their commands out"
        )
    return link
