"""What flies beside a flight: real time, a MAVLink vehicle, a telemetry log."""

import sys
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import TYPE_CHECKING, Any

import click

if TYPE_CHECKING:
    from ftc_jsb.scenario.schema import Scenario


@contextmanager
def beside_flight(
    scenario: "Scenario",
    realtime: float | None,
    endpoint: str | None,
    sysid: int,
    key: Path | None,
    readonly: bool,
    tlog: Path | None,
    linger: float | None,
) -> Iterator[Any]:
    """What flies beside: nothing, or real time, a vehicle and a log."""
    from ftc_jsb.errors import ScenarioError

    if endpoint is None and (key is not None or readonly):
        name = "--mavlink-key" if key is not None else "--mavlink-readonly"
        raise ScenarioError(f"{name}: there is no link without --mavlink ENDPOINT")
    if tlog is not None and tlog.exists():
        raise ScenarioError(f"--tlog {tlog}: exists; give another file")
    if realtime is None and endpoint is None and tlog is None:
        yield None
        return
    from ftc_jsb.mavlink.link.endpoint import parse_endpoint
    from ftc_jsb.mavlink.link.signing import load_key
    from ftc_jsb.mavlink.link.vehicle_link import Link
    from ftc_jsb.mavlink.live import LogOnly, live_flight

    if tlog is not None and realtime is None and endpoint is None:
        yield LogOnly(tlog)
        return
    link = Link(
        parse_endpoint(endpoint) if endpoint else None,
        sysid,
        load_key(key) if key else None,
        readonly,
    )
    if link.endpoint and link.endpoint.kind != "udpout" and not link.endpoint.is_local and not key:
        click.echo(
            f"ftc-jsb: note: {link.endpoint} can be reached from other machines; --mavlink-key or "
            "--mavlink-readonly keeps their commands out",
            err=True,
        )
    if linger is None:
        linger = 1e9 if endpoint and sys.stderr.isatty() else 0.0
    with live_flight(scenario, realtime, link, tlog, linger) as beside:
        if beside.note:
            click.echo(f"ftc-jsb: note: {beside.note}", err=True)
        yield beside


def paced(watch: Any, rate: float) -> Any:
    """The same observers, and one that holds the flight back to real time."""
    from ftc_jsb.simulation.pacing import Pacer

    @contextmanager
    def paced_observers(label: str) -> Iterator[list[Any]]:
        with watch(label) as observers:
            yield [*observers, Pacer(rate, 1.0)]

    return paced_observers
