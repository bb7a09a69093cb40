"""Options that several verbs share."""

from pathlib import Path
from typing import Any

import click

scenario_argument = click.argument("scenario", metavar="SCENARIO")
set_option = click.option(
    "--set", "overrides", metavar="KEY=VALUE", multiple=True, help="Override a key of the scenario."
)
out_option = click.option(
    "--out", metavar="DIR", type=click.Path(path_type=Path), help="Folder for the results."
)
force_option = click.option("--force", is_flag=True, help="Write into DIR though it is not empty.")
margins_option = click.option(
    "--margins", "margin_files", metavar="FILE", multiple=True, type=click.Path(path_type=Path),
    help="margins.json of `ftc-jsb margins`, shown with the flights that it is of.",
)  # fmt: skip
json_option = click.option("--json", "as_json", is_flag=True, help="Print JSON for machines.")


LIVE = (
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


def live_options(command: Any) -> Any:
    """Give a verb the options of real time and MAVLink; they reach it as keywords."""
    for option in reversed(LIVE):
        command = option(command)
    return command
