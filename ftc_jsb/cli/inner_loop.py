"""`ftc-jsb inner-loop`: inner loops designed and judged."""

from pathlib import Path

import click

from ftc_jsb.cli.options import force_option, out_option


@click.command("inner-loop")
@click.argument("aircraft", metavar="AIRCRAFT...", nargs=-1, required=True)
@click.option("--report", "judge", is_flag=True, help="Fly and judge the steps; design nothing.")
@out_option
@force_option
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
