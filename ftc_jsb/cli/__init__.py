"""The command line: parse, call, print. Imports what a command needs only when it runs."""

import json
import shlex
import sys
from collections.abc import Iterator, Sequence
from contextlib import AbstractContextManager, contextmanager, nullcontext
from functools import partial
from pathlib import Path
from typing import TYPE_CHECKING, Any, NoReturn, cast

import click

import ftc_jsb
from ftc_jsb.errors import UserError

if TYPE_CHECKING:
    from ftc_jsb.scenario.schema import Model, Scenario

DONE, LIMIT_BROKEN, BAD_USAGE, INTERRUPTED = 0, 1, 2, 130

_scenario_argument = click.argument("scenario", metavar="SCENARIO")
_set_option = click.option(
    "--set", "overrides", metavar="KEY=VALUE", multiple=True, help="Override a key of the scenario."
)
_out_option = click.option(
    "--out", metavar="DIR", type=click.Path(path_type=Path), help="Folder for the results."
)
_force_option = click.option("--force", is_flag=True, help="Write into DIR though it is not empty.")
_margins_option = click.option(
    "--margins", "margin_files", metavar="FILE", multiple=True, type=click.Path(path_type=Path),
    help="margins.json of `ftc-jsb margins`, shown with the flights that it is of.",
)  # fmt: skip
_json_option = click.option("--json", "as_json", is_flag=True, help="Print JSON for machines.")


_LIVE = (
    click.option(
        "--realtime", is_flag=False, flag_value=1.0, metavar="[FACTOR]", default=None,
        type=click.FloatRange(0.01, 100.0), help="Hold the flight back to the clock, or FACTOR times it.",
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
        "--linger", metavar="SECONDS", type=click.FloatRange(0.0, 1e9), default=None,
        help="Time that the vehicle stays after its flight; on a terminal until Ctrl-C, else 0.",
    ),
)  # fmt: skip


def _live_options(command: Any) -> Any:
    for option in reversed(_LIVE):
        command = option(command)
    return command


class _Commands(click.Group):
    """Turns every `UserError` into one sentence and exit code 2."""

    def invoke(self, ctx: click.Context) -> Any:
        try:
            return super().invoke(ctx)
        except UserError as error:
            click.echo(f"ftc-jsb: {error}", err=True)
            sys.exit(BAD_USAGE)
        except KeyboardInterrupt:
            click.echo("ftc-jsb: interrupted", err=True)
            sys.exit(INTERRUPTED)


@click.group(cls=_Commands, context_settings={"help_option_names": ["-h", "--help"]})
@click.version_option(ftc_jsb.__version__, prog_name="ftc-jsb")
def main() -> None:
    """Fault-tolerant flight control on a point mass and on JSBSim fighters.

    SCENARIO is the path of a .toml file or the name of a shipped one: see `ftc-jsb list`.
    """


@main.command()
@_scenario_argument
@click.option(
    "--model", type=click.Choice(["paper", "identified", "jsbsim"]), help="What is flown."
)
@click.option("--loop", metavar="NAME", help="Outer loop: a name, or package.module:Class.")
@click.option(
    "--flightgear", metavar="HOST:PORT", help="Show the flight in FlightGear, in real time."
)
@_set_option
@_out_option
@_force_option
@_json_option
@_live_options
def fly(
    scenario: str,
    model: str | None,
    loop: str | None,
    flightgear: str | None,
    overrides: tuple[str, ...],
    out: Path | None,
    force: bool,
    as_json: bool,
    **live: Any,
) -> None:
    """Fly SCENARIO once; write flight.nc and metrics.json."""
    from ftc_jsb.runs.flights import fly_and_save
    from ftc_jsb.runs.output_folder import output_folder

    flown = _load(scenario, _with(overrides, model, loop))
    watch = _progress_for(flown, as_json)
    shown: AbstractContextManager[Path | None] = nullcontext()
    if flightgear is not None:
        from ftc_jsb.flightgear.viewer import output_directive, viewer

        shown = output_directive(viewer(flightgear, flown))
        if live["endpoint"] is None and live["realtime"] is None:
            watch = _paced(watch, flown.loop.rate)
        else:
            live["realtime"] = live["realtime"] or 1.0
    with output_folder(out, flown.name, force) as folder:
        _announce(flown)
        with shown as output, _live(flown, **live) as beside:
            result = fly_and_save(flown, folder, watch, beside, output)
    if beside is not None:
        for line in beside.summary():
            click.echo(f"ftc-jsb: {line}", err=True)
    if as_json:
        click.echo(json.dumps(result.document, indent=2))
    else:
        from ftc_jsb.report.terminal.flights import print_flights

        print_flights({result.label: result.metrics})
        click.echo(f"Recording: {folder / 'flight.nc'}")
    _exit_by(result.metrics)


@main.command()
@_scenario_argument
@_set_option
@_out_option
@_force_option
@_json_option
@_margins_option
def compare(
    scenario: str,
    overrides: tuple[str, ...],
    out: Path | None,
    force: bool,
    as_json: bool,
    margin_files: tuple[Path, ...],
) -> None:
    """Fly every model and loop of [compare]; write recordings, metrics.json and report.html."""
    from ftc_jsb.runs.flights import compare_and_save
    from ftc_jsb.runs.output_folder import output_folder

    flown = _load(scenario, overrides)
    margins = _margins(margin_files)
    with output_folder(out, f"compare-{flown.name}", force) as folder:
        _announce(flown)
        flights, interrupted = compare_and_save(flown, folder, _progress_for(flown, as_json))
        _write_report(flights, folder, as_json, margins=margins)
    if interrupted:
        sys.exit(INTERRUPTED)


@main.command()
@click.argument(
    "recordings", metavar="FLIGHT.nc...", nargs=-1, required=True, type=click.Path(path_type=Path)
)
@_out_option
@_force_option
@_json_option
@_margins_option
def report(
    recordings: tuple[Path, ...],
    out: Path | None,
    force: bool,
    as_json: bool,
    margin_files: tuple[Path, ...],
) -> None:
    """Write the report of recordings that exist."""
    from ftc_jsb.runs.flights import labelled_recordings
    from ftc_jsb.runs.output_folder import output_folder

    margins = _margins(margin_files)
    flights, broken = labelled_recordings(recordings)
    for message in broken:
        click.echo(f"ftc-jsb: {message}", err=True)
    with output_folder(out, "report", force) as folder:
        _write_report(flights, folder, as_json, tuple(broken), margins)
    if broken:
        sys.exit(BAD_USAGE)


@main.command()
@click.argument("recording", metavar="FLIGHT.nc", type=click.Path(path_type=Path))
@click.option(
    "--to", "format_", metavar="FORMAT", required=True, help="csv, mat, parquet, acmi or tlog."
)
@click.option(
    "--out", metavar="FILE", type=click.Path(path_type=Path), help="Default: beside the recording."
)
@click.option("--force", is_flag=True, help="Write over FILE.")
def convert(recording: Path, format_: str, out: Path | None, force: bool) -> None:
    """Write a recording in the format of another program."""
    from ftc_jsb.convert import FORMATS
    from ftc_jsb.convert import convert as write
    from ftc_jsb.errors import RecordingError
    from ftc_jsb.recording.netcdf import load

    if format_ not in FORMATS:
        raise RecordingError(f"--to {format_}: no such format; expected {', '.join(FORMATS)}")
    path = out or recording.with_suffix(FORMATS[format_].suffix)
    if path.exists() and not force:
        raise RecordingError(f"{path}: exists; give another file by --out, or --force")
    write(load(recording), format_, path)
    click.echo(f"Written: {path}")


@main.command()
@click.argument(
    "recordings", metavar="FLIGHT.nc...", nargs=-1, required=True, type=click.Path(path_type=Path)
)
@_out_option
@_force_option
def figures(recordings: tuple[Path, ...], out: Path | None, force: bool) -> None:
    """Draw the paper's figures of recordings for print: PDF, SVG and PNG, as wide as a column."""
    from ftc_jsb.report.figures.draw import draw_all
    from ftc_jsb.runs.flights import labelled_recordings
    from ftc_jsb.runs.output_folder import output_folder

    flights, broken = labelled_recordings(recordings)
    for message in broken:
        click.echo(f"ftc-jsb: {message}", err=True)
    with output_folder(out, "figures", force) as folder:
        for name in draw_all(flights, folder):
            click.echo(f"Drawn: {folder / name}.pdf, .svg, .png")
    if broken:
        sys.exit(BAD_USAGE)


@main.command()
@click.argument("recording", metavar="FLIGHT.nc", type=click.Path(path_type=Path))
@_live_options
def replay(recording: Path, **live: Any) -> None:
    """Fly a recording again, its commands included; exit code 1 if not bit for bit the same.

    A ground station may watch; what it says is ignored.
    """
    from ftc_jsb.recording.netcdf import attributes_of, load
    from ftc_jsb.simulation.replay import changed_since, differences
    from ftc_jsb.simulation.replay import replay as fly_again

    flight = load(recording)
    with _live(flight.scenario, **{**live, "readonly": live["endpoint"] is not None}) as beside:
        again = fly_again(flight, beside.observers if beside else ())
        if beside is not None:
            beside.flies_again(again)
    found = differences(flight, again)
    if not found:
        click.echo(
            f"{recording}: the same to the bit: {flight.record.size} samples, "
            f"{len(flight.commands)} commands"
        )
        return
    for change in changed_since(flight, attributes_of(recording)):
        click.echo(f"ftc-jsb: {change}", err=True)
    first = found[0]
    click.echo(
        f"ftc-jsb: {recording}: {len(found)} variables differ, the first is {first.name} from "
        f"{first.time:.2f} s on, by {first.largest:.3g} at most",
        err=True,
    )
    sys.exit(LIMIT_BROKEN)


@main.command()
@click.argument("file", metavar="SCENARIO")
@_set_option
def check(file: str, overrides: tuple[str, ...]) -> None:
    """Read and validate a scenario, its aircraft and its loops, without flying."""
    from ftc_jsb.runs.check import check_scenario

    flown = _load(file, overrides)
    for line in check_scenario(flown):
        click.echo(line)
    _note(flown)


@main.command("list")
@click.argument("kind", required=False, type=click.Choice(["scenarios", "aircraft", "loops"]))
def list_(kind: str | None) -> None:
    """List what is shipped: scenarios, aircraft, loops."""
    from ftc_jsb.runs.check import inventory

    for title, entries in inventory().items():
        if kind in (None, title):
            click.echo(f"{title}:")
            width = max(map(len, entries))
            for name, meaning in entries.items():
                click.echo(f"  {name:<{width}}  {meaning}")


@main.command()
@click.argument("aircraft", metavar="AIRCRAFT")
@_out_option
@_force_option
def identify(aircraft: str, out: Path | None, force: bool) -> None:
    """Fit the point mass of AIRCRAFT to virtual flight tests; write point_mass.toml."""
    from ftc_jsb.aircraft.description import load_aircraft
    from ftc_jsb.identify.identification import identify as run
    from ftc_jsb.identify.identification import write_point_mass
    from ftc_jsb.runs.output_folder import output_folder

    loaded = load_aircraft(aircraft)
    with output_folder(out, f"identify-{loaded.name}", force) as folder:
        contents = run(loaded, lambda line: click.echo(line, err=True))
        write_point_mass(folder / "point_mass.toml", contents)
    for key, value in contents["identification"].items():
        click.echo(f"{key}: {value}")
    click.echo(f"Written: {folder / 'point_mass.toml'}")


@main.command("inner-loop")
@click.argument("aircraft", metavar="AIRCRAFT...", nargs=-1, required=True)
@click.option("--report", "judge", is_flag=True, help="Fly and judge the steps; design nothing.")
@_out_option
@_force_option
def inner_loop(aircraft: tuple[str, ...], judge: bool, out: Path | None, force: bool) -> None:
    """Design the inner loop of each AIRCRAFT: write inner_loop.xml, the steps' table and figure.

    One folder for each in DIR; with --report only table and figures, all in DIR.
    """
    from ftc_jsb.aircraft.description import load_aircraft
    from ftc_jsb.report.inner_loop_output import design_and_report, report_steps
    from ftc_jsb.runs.output_folder import output_folder

    loaded = [load_aircraft(name) for name in aircraft]
    with output_folder(out, "inner-loop", force) as folder:
        if not judge:
            loaded = design_and_report(loaded, folder, lambda line: click.echo(line, err=True))
        click.echo(report_steps(loaded, folder))
    click.echo(f"Written: {folder}")


@main.command()
@click.argument("aircraft", metavar="AIRCRAFT")
@click.argument("folder", metavar="DIR", type=click.Path(path_type=Path))
@click.option("--stock", is_flag=True, help="Without the corrections of its flight control.")
@_force_option
def export(aircraft: str, folder: Path, stock: bool, force: bool) -> None:
    """Write AIRCRAFT with its inner loop to DIR, for plain JSBSim, with a script that flies it."""
    from ftc_jsb.aircraft.description import load_aircraft
    from ftc_jsb.export.aircraft_folder import export as run
    from ftc_jsb.runs.output_folder import output_folder

    loaded = load_aircraft(aircraft)
    with output_folder(folder, loaded.name, force, "DIR"):
        written = run(loaded, not stock, folder)
    click.echo(f"{len(written)} files in {folder}; to fly it, and under whose licence: ")
    click.echo(f"{folder / 'README.txt'}, {folder / 'NOTICE'}")


@main.command()
@click.argument("name", metavar="SCENARIO|AIRCRAFT")
@click.option(
    "--model",
    type=click.Choice(["paper", "identified", "jsbsim"]),
    default="jsbsim",
    show_default=True,
    help="What is flown.",
)
@click.option("--airspeed", metavar="M/S", type=float, help="In place of the scenario's.")
@click.option("--altitude", metavar="M", type=float, help="In place of the scenario's.")
@click.option(
    "--amplitude",
    metavar="FACTOR",
    type=click.FloatRange(1e-3, 1e3),
    default=1.0,
    show_default=True,
    help="Of the signals that are injected: 20 N, 0.005 g, 0.005 rad times this.",
)
@_out_option
@_force_option
@_json_option
def margins(
    name: str,
    model: str,
    airspeed: float | None,
    altitude: float | None,
    amplitude: float,
    out: Path | None,
    force: bool,
    as_json: bool,
) -> None:
    """Measure gain, phase and delay margins in level flight; write margins.json and bode.png."""
    from ftc_jsb.margins.condition import level_scenario
    from ftc_jsb.margins.document import document
    from ftc_jsb.margins.measure import CHANNELS, channel_margins
    from ftc_jsb.runs.flights import write_metrics
    from ftc_jsb.runs.output_folder import output_folder

    flown = level_scenario(name, cast("Model", model), airspeed, altitude)
    with output_folder(out, f"margins-{Path(name).stem}", force) as folder:
        _announce(flown)
        tell, found = partial(click.echo, err=True), []
        for channel in CHANNELS:  # written as it goes: an interruption loses nothing finished
            found.append(channel_margins(flown, channel, tell, amplitude))
            write_metrics(folder / "margins.json", document(flown, found))
        from ftc_jsb.report.figures.bode import bode_figure
        from ftc_jsb.report.terminal.margins import print_margins

        what = flown.aircraft.name if model != "paper" else "paper"
        at = f"{flown.initial.airspeed:g} m/s, {flown.initial.altitude:g} m"
        title = f"{what} ({model}), loop {flown.loop.name}, {at}"
        bode_figure(title, found).savefig(folder / "bode.png", dpi=150)
    if as_json:
        click.echo(json.dumps(document(flown, found), indent=2))
    else:
        print_margins(title, found)
        click.echo(f"Written: {folder / 'margins.json'}, {folder / 'bode.png'}")


@main.command()
@_json_option
def bench(as_json: bool) -> None:
    """Measure what steps, flights and commands cost, in about two minutes."""
    from ftc_jsb.bench.summary import lines, measure_all

    found = measure_all(lambda line: click.echo(line, err=True))
    if as_json:
        click.echo(json.dumps(found, indent=2))
    else:
        click.echo("\n".join(lines(found)))


# --- what the commands share ------------------------------------------------------------------


def _load(name: str, overrides: Sequence[str]) -> "Scenario":
    from ftc_jsb.scenario.load import load_scenario

    return load_scenario(name, overrides)


def _with(overrides: tuple[str, ...], model: str | None, loop: str | None) -> list[str]:
    extra = [f'model="{model}"'] if model else []
    extra += [f"loop.name={json.dumps(loop)}"] if loop else []
    return [*overrides, *extra]


def _note(scenario: "Scenario") -> None:
    from ftc_jsb.scenario.notes import notes

    for note in notes(scenario):
        click.echo(f"ftc-jsb: note: {note}", err=True)


def _announce(scenario: "Scenario") -> None:
    _note(scenario)
    from ftc_jsb.compiled import is_first_run

    if is_first_run("ftc_jsb.simulation.sample"):
        click.echo(
            "Compiling the numerical kernels (first run only, about half a minute) ...", err=True
        )


def _progress_for(scenario: "Scenario", quiet: bool) -> Any:
    from ftc_jsb.cli.progress import Progress

    return Progress(scenario, enabled=sys.stderr.isatty() and not quiet)


@contextmanager
def _live(
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
    from ftc_jsb.mavlink.link.link import Link
    from ftc_jsb.mavlink.link.signing import load_key
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
        yield beside


def _paced(watch: Any, rate: float) -> Any:
    """The same observers, and one that holds the flight back to real time."""
    from ftc_jsb.simulation.pacing import Pacer

    @contextmanager
    def paced(label: str) -> Iterator[list[Any]]:
        with watch(label) as observers:
            yield [*observers, Pacer(rate, 1.0)]

    return paced


def _margins(files: Sequence[Path]) -> list[Any]:
    from ftc_jsb.report.measured_margins import read_margins

    return [read_margins(path) for path in files]


def _write_report(
    flights: dict[str, Any],
    folder: Path,
    as_json: bool,
    unread: tuple[str, ...] = (),
    margins: Sequence[Any] = (),
) -> None:
    from ftc_jsb.report.page.write import write_report
    from ftc_jsb.report.terminal.flights import print_flights

    command = shlex.join(["ftc-jsb", *sys.argv[1:]])
    document = write_report(flights, folder, command, unread, margins)
    if as_json:
        click.echo(json.dumps(document, indent=2))
    else:
        print_flights(document["flights"])
        click.echo(f"Report: {folder / 'report.html'}")


def _exit_by(metrics: dict[str, Any]) -> NoReturn:
    from ftc_jsb.analysis.metrics import passed

    for limit in metrics["limits_broken"]:
        click.echo(
            f"ftc-jsb: limit broken: {limit['name']} first at {limit['time']:.2f} s, "
            f"worst {limit['value']:.4g} against {limit['limit']:g}",
            err=True,
        )
    if metrics["status"] == "interrupted":
        click.echo(f"ftc-jsb: interrupted at {metrics['end_time_s']:.2f} s; saved", err=True)
        sys.exit(INTERRUPTED)
    if metrics["status"] == "failed":
        click.echo(f"ftc-jsb: {metrics['reason']}; what was flown is saved", err=True)
        sys.exit(BAD_USAGE)
    if metrics["status"] == "departed":
        click.echo(
            f"ftc-jsb: departed at {metrics['end_time_s']:.2f} s: {metrics['reason']}", err=True
        )
    sys.exit(DONE if passed(metrics) else LIMIT_BROKEN)
