"""Arguments and options that several commands have."""

import functools
import math
from collections.abc import Callable
from contextlib import AbstractContextManager
from pathlib import Path
from typing import Any, NamedTuple, TypeVar

import click

from ftc_jsb.cli import completed_names, printing

AnyCommand = TypeVar("AnyCommand", bound=click.Command)
Callback = Callable[..., Any]
Decorator = Callable[[Callback], Callback]

MODELS = click.Choice(["paper", "identified", "jsbsim"])

scenario_argument = click.argument(
    "scenario", metavar="SCENARIO", shell_complete=completed_names.scenarios
)
aircraft_argument = click.argument(
    "aircraft", metavar="AIRCRAFT", shell_complete=completed_names.aircraft
)
recording_argument = click.argument(
    "recording", metavar="FLIGHT.nc", type=click.Path(path_type=Path)
)
recordings_argument = click.argument(
    "recordings", metavar="FLIGHT.nc...", nargs=-1, required=True, type=click.Path(path_type=Path)
)
set_option = click.option(
    "--set",
    "overrides",
    metavar="KEY=VALUE",
    multiple=True,
    help="Override a key of the scenario.",
    shell_complete=completed_names.keys,
)
code_option = click.option(
    "--allow-code", is_flag=True, help="Import and run the Python loops that the file names."
)
force_option = click.option("--force", is_flag=True, help="Write into DIR though it is not empty.")
json_option = click.option("--json", "as_json", is_flag=True, help="Print JSON for machines.")


class FiniteRange(click.FloatRange):
    """A number in a range, of which nan and infinity are no part."""

    def convert(
        self, value: Any, param: click.Parameter | None, ctx: click.Context | None
    ) -> float:
        """As `click.FloatRange`, which takes nan for every bound."""
        number = super().convert(value, param, ctx)
        if not math.isfinite(number):
            self.fail(f"{number} is not in the range {self._describe_range()}.", param, ctx)
        return float(number)


def _hush(ctx: click.Context, _: click.Parameter, quiet: bool) -> None:
    if quiet:
        ctx.with_resource(printing.hushed())


quiet_option = click.option(
    "--quiet", "-q", is_flag=True, expose_value=False, is_eager=True, callback=_hush,
    help="Print nothing but what went wrong, and what --json asks for.",
)  # fmt: skip
margins_option = click.option(
    "--margins", "margin_files", metavar="FILE", multiple=True, type=click.Path(path_type=Path),
    help="margins.json of `ftc-jsb margins`, shown with the flights that it is of.",
)  # fmt: skip


def examples(*lines: str) -> Callable[[AnyCommand], AnyCommand]:
    """Commands as they may be typed, at the end of --help."""

    def decorate(command: AnyCommand) -> AnyCommand:
        command.epilog = "\b\nExamples:\n" + "\n".join(f"  {line}" for line in lines)
        return command

    return decorate


def grouped(name: str, group: type[Any], *options: Decorator) -> Decorator:
    """Options that a command gets as one argument.

    Args:
        name: of the argument.
        group: a NamedTuple whose fields are the names of the options.
        options: in the order in which --help shows them.
    """

    def decorate(command: Callback) -> Callback:
        @functools.wraps(command)
        def called(**given: Any) -> Any:
            values = {field: given.pop(field) for field in group._fields}
            return command(**given, **{name: group(**values)})

        decorated: Callback = called
        for option in reversed(options):
            decorated = option(decorated)
        return decorated

    return decorate


class Output(NamedTuple):
    """Where the results of a command go."""

    out: Path | None
    force: bool

    def folder(self, name: str) -> AbstractContextManager[Path]:
        """The folder, seen to be writable; by default ./out/<name>-<date-time>.

        Raises:
            RecordingError: it is not empty, or cannot be made or written.
        """
        from ftc_jsb.runs.output_folder import output_folder

        return output_folder(self.out, name, self.force)


output_options = grouped(
    "output",
    Output,
    click.option(
        "--out", metavar="DIR", type=click.Path(path_type=Path), help="Folder for the results."
    ),
    force_option,
    quiet_option,
)
