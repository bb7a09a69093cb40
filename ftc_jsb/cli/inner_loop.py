"""`ftc-jsb inner-loop`: inner loops designed, flown and judged."""

import click

from ftc_jsb.cli.options import Output, output_options
from ftc_jsb.cli.printing import progress_line


@click.command("inner-loop")
@click.argument("aircraft", metavar="AIRCRAFT...", nargs=-1, required=True)
@click.option("--report", "judge", is_flag=True, help="Fly and judge the steps; design nothing.")
@output_options
def inner_loop(aircraft: tuple[str, ...], judge: bool, output: Output) -> None:
    """Design the inner loop of each AIRCRAFT: write inner_loop.xml, the steps' table and figure.

    One folder for each in DIR; with --report only table and figures, all in DIR.
    """
    from ftc_jsb.aircraft.description import load_aircraft
    from ftc_jsb.report.inner_loop_output import design_and_report, report_steps

    loaded = [load_aircraft(name) for name in aircraft]
    with output.folder("inner-loop") as folder:
        if not judge:
            loaded = design_and_report(loaded, folder, progress_line)
        click.echo(report_steps(loaded, folder))
    click.echo(f"Written: {folder}")
