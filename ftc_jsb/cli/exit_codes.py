"""Exit codes of the program, and which one a flight ends with."""

import sys
from typing import Any, NoReturn

import click

DONE, LIMIT_BROKEN, BAD_USAGE, INTERRUPTED = 0, 1, 2, 130


def exit_by(metrics: dict[str, Any]) -> NoReturn:
    """Say what was broken, lost or interrupted in a flight, and leave with the code for it."""
    from ftc_jsb.analysis.verdict import passed

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
    if metrics["loss_of_control"] is not None:
        click.echo(
            f"ftc-jsb: control lost at {metrics['loss_of_control_time_s']:.2f} s: "
            f"{metrics['loss_of_control']}",
            err=True,
        )
    if metrics["status"] == "departed":
        click.echo(
            f"ftc-jsb: departed at {metrics['end_time_s']:.2f} s: {metrics['reason']}", err=True
        )
    sys.exit(DONE if passed(metrics) else LIMIT_BROKEN)
