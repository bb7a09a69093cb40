"""`ftc-jsb plugin`: the outer loop on an aircraft that another program flies."""

import tempfile
from collections.abc import Iterator
from contextlib import ExitStack, contextmanager
from pathlib import Path
from typing import TYPE_CHECKING, NamedTuple

import click

from ftc_jsb.cli.announcement import announce
from ftc_jsb.cli.fly import exit_by, overrides_of
from ftc_jsb.cli.live import LiveOptions, flying_beside, live_options
from ftc_jsb.cli.options import (
    Output,
    code_option,
    examples,
    grouped,
    json_option,
    output_options,
    scenario_argument,
    set_option,
)
from ftc_jsb.cli.printing import message, print_json
from ftc_jsb.errors import ScenarioError

if TYPE_CHECKING:
    from collections.abc import Callable, Sequence

    from ftc_jsb.flightgear.exchange import Exchange
    from ftc_jsb.flightgear.flight import OutsideFlight
    from ftc_jsb.recording.flight import Flight
    from ftc_jsb.runs.single import Result
    from ftc_jsb.scenario.schema import Scenario
    from ftc_jsb.simulation.command_source import CommandSource
    from ftc_jsb.simulation.fly import Observer

PORTS = (5601, 5602)  # of the loop, and of the simulator
PATIENCE = 300.0  # [s]: FlightGear's first start builds a cache


class SimulatorOptions(NamedTuple):
    """As given on the command line."""

    flightgear: bool
    program: str | None
    attach: str | None
    listen: int
    fgfs_options: tuple[str, ...]


simulator_options = grouped(
    "simulator", SimulatorOptions,
    click.option("--flightgear", is_flag=True, help="Start FlightGear with the aircraft, and fly it."),
    click.option("--fgfs", "program", metavar="PROGRAM", help="FlightGear, where it is not found."),
    click.option(
        "--attach", metavar="HOST:PORT",
        help="Fly a simulator that runs, and takes commands there.",
    ),
    click.option(
        "--listen", metavar="PORT", type=click.IntRange(0, 65535), default=PORTS[0], show_default=True,
        help="UDP port that the simulator's lines come to.",
    ),
    click.option(
        "--fgfs-option", "fgfs_options", metavar="OPTION", multiple=True,
        help="Option that FlightGear is started with besides, such as --geometry=1024x768.",
    ),
)  # fmt: skip


@examples(
    "ftc-jsb plugin paper --flightgear",
    "ftc-jsb plugin paper --attach 127.0.0.1:5602",
)
@click.command()
@scenario_argument
@click.option("--loop", metavar="NAME", help="Outer loop: a name, or package.module:Class.")
@simulator_options
@set_option
@code_option
@output_options
@json_option
@live_options
def plugin(
    scenario: str,
    loop: str | None,
    simulator: SimulatorOptions,
    overrides: tuple[str, ...],
    allow_code: bool,
    output: Output,
    as_json: bool,
    live: LiveOptions,
) -> None:
    """Fly SCENARIO's references on an aircraft that FlightGear, or another simulator, flies."""
    from ftc_jsb.loops.code import refuse_code
    from ftc_jsb.scenario.load import load_scenario

    if not simulator.flightgear and simulator.attach is None:
        raise ScenarioError("plugin: expected --flightgear, or --attach HOST:PORT")
    if live.realtime is not None:
        raise ScenarioError("--realtime: the simulator has its own time")
    flown = load_scenario(scenario, [*overrides, *overrides_of("flightgear", loop)])
    if not allow_code:
        refuse_code([flown.loop.name], scenario, [*overrides, loop or ""])
    with output.folder(f"{flown.name}-flightgear") as folder:
        announce(flown, overrides)
        result = _fly(flown, simulator, live, folder, as_json)
    if as_json:
        print_json({**result.document, "recording": str(folder / "flight.nc")})
    else:
        from ftc_jsb.report.terminal.flights import print_flights

        print_flights({result.label: result.metrics})
        click.echo(f"Recording: {folder / 'flight.nc'}")
    exit_by(result.metrics)


def _fly(
    scenario: "Scenario", options: SimulatorOptions, live: LiveOptions, folder: Path, quiet: bool
) -> "Result":
    """Fly in the simulator; says what went over the link."""
    from ftc_jsb.cli.progress import progress_for
    from ftc_jsb.flightgear.flight import OutsideFlight
    from ftc_jsb.flightgear.outside_aircraft import started_where_it_is
    from ftc_jsb.runs.single import fly_and_save

    with _simulator(scenario, options, folder) as exchange:
        origin = exchange.wait_in_the_air(PATIENCE)
        flown = started_where_it_is(scenario, exchange.fields, origin)
        flights: list[OutsideFlight] = []
        with flying_beside(flown, live) as beside:

            def notify(text: str) -> None:
                message(text)
                if beside is not None:
                    beside.announce(text)

            def fly(
                scenario: "Scenario",
                observers: "Sequence[Observer]" = (),
                commands: "CommandSource | None" = None,
            ) -> "Flight":
                flights.append(OutsideFlight(scenario, exchange, origin, notify))
                return flights[-1].fly(observers, commands)

            result = fly_and_save(flown, folder, progress_for(flown, quiet), beside, flown_by=fly)
        for line in [*(beside.summary() if beside else ()), *_of_link(exchange, flights[-1])]:
            message(line)
    return result


def _of_link(exchange: "Exchange", flight: "OutsideFlight") -> list[str]:
    """What went over the link, for the user."""
    lines = [f"lines: {exchange.counts}"]
    delays = flight.delays
    if delays is not None:
        lines.append(
            f"delay from frame to command: {1e3 * delays.median:.0f} ms in the median, "
            f"{1e3 * delays.p99:.0f} ms at 99 %, {1e3 * delays.most:.0f} ms at most"
        )
    return lines


@contextmanager
def _simulator(
    scenario: "Scenario", options: SimulatorOptions, folder: Path
) -> "Iterator[Exchange]":
    """The exchange with a simulator that runs, or that is started and ends with the block."""
    from ftc_jsb.flightgear.exchange import Exchange
    from ftc_jsb.flightgear.link import SimulatorLink
    from ftc_jsb.flightgear.outside_aircraft import LineFields
    from ftc_jsb.flightgear.program import find_program

    there = _address(options.attach) if options.attach else ("127.0.0.1", PORTS[1])
    program = "" if options.attach else find_program(options.program)
    with ExitStack() as stack:
        link = SimulatorLink(("127.0.0.1" if _local(there) else "", options.listen), there)
        stack.callback(link.close)
        gone: Callable[[], str] = _there
        if options.attach is None:
            gone = stack.enter_context(
                _started(scenario, program, options.fgfs_options, folder, (link.port, there[1]))
            )
        yield Exchange(link, LineFields(scenario.aircraft), gone)


@contextmanager
def _started(
    scenario: "Scenario",
    program: str,
    given: "Sequence[str]",
    folder: Path,
    ports: tuple[int, int],
) -> "Iterator[Callable[[], str]]":
    """FlightGear with the exported aircraft; gives why it is gone, "" while it runs."""
    from ftc_jsb.aircraft.description import load_aircraft
    from ftc_jsb.export.flightgear.aircraft_folder import aircraft_name, export_flightgear
    from ftc_jsb.flightgear.program import data_folder, running, start_options

    root = data_folder(program)
    aircraft = load_aircraft(scenario.aircraft.name)
    with tempfile.TemporaryDirectory(prefix="ftc-jsb-flightgear-") as temporary:
        place = Path(temporary)
        export_flightgear(aircraft, scenario.aircraft, place)
        arguments = start_options(place, aircraft_name(aircraft), scenario.initial, root, ports)
        log = folder / "fgfs.log"
        with running(program, [*arguments, *given], log) as process:
            yield lambda: "" if process.poll() is None else f"FlightGear has ended; see {log}"


def _there() -> str:
    """Why a simulator that was not started here is gone: nobody can tell."""
    return ""


def _address(text: str) -> tuple[str, int]:
    host, colon, port = text.rpartition(":")
    if not (colon and host and port.isascii() and port.isdigit() and 0 < int(port) < 65536):
        raise ScenarioError(f"--attach {text!r}: expected HOST:PORT, such as 127.0.0.1:{PORTS[1]}")
    return host, int(port)


def _local(address: tuple[str, int]) -> bool:
    return address[0] in ("127.0.0.1", "localhost")
