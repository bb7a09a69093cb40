"""`ftc-jsb theory`: the paper's theory for a system of one's own."""

from pathlib import Path

import click

from ftc_jsb.cli.exit_codes import DONE, LIMIT_BROKEN
from ftc_jsb.cli.options import Output, examples, json_option, output_options
from ftc_jsb.cli.printing import print_json, progress_line


@examples("ftc-jsb theory levitator", "ftc-jsb theory my_system.py --out mine")
@click.command()
@click.argument("name", metavar="NAME|FILE.py")
@click.option("--seed", type=int, default=0, show_default=True, help="Of the noise.")
@click.option("--print", "for_print", is_flag=True, help="Draw the figure as PDF and SVG, too.")
@output_options
@json_option
@click.pass_context
def theory(
    context: click.Context, name: str, seed: int, for_print: bool, output: Output, as_json: bool
) -> None:
    """Analyse a system, fly it with and without FTC, write theory.json, a figure and recordings.

    NAME is fighter, levitator, reactor, textbook or vessel; FILE.py defines CASE (docs/theory.md).
    """
    from ftc_jsb.compiled import is_first_run
    from ftc_jsb.runs.metrics_file import write_metrics
    from ftc_jsb.runs.theory import (
        LOOPS,
        TheoryFlight,
        analyse,
        document,
        fly_case,
        foresee,
        load_case,
        write_history,
    )

    case = load_case(name)
    flights: dict[str, TheoryFlight] = {}
    with output.folder(f"theory-{Path(name).stem}") as folder:
        progress_line(f"{case.title}: analysing")
        analysis = analyse(case)
        first = is_first_run(f"{analysis.loop.kernels.package}.closed_loop")
        progress_line(
            "flying" + ("; a new system is compiled first, some ten seconds" if first else "")
        )
        expected = foresee(analysis)
        for loop in LOOPS:  # written as it goes: an interruption loses nothing finished
            flights[loop] = flight = fly_case(analysis, loop, seed, expected)
            write_history(case, flight.history, folder / f"{loop}.nc")
            write_metrics(folder / "theory.json", document(analysis, flights))
        if not as_json:
            from ftc_jsb.report.terminal.theory import theory_lines

            for line in theory_lines(analysis, flights):
                click.echo(line)
        from ftc_jsb.report.figures.style import FORMATS, save
        from ftc_jsb.report.figures.theory import theory_figure

        formats = FORMATS if for_print else ("png",)
        save(theory_figure(analysis, flights), folder, "theory", formats)
    if as_json:
        print_json(document(analysis, flights))
    else:
        click.echo(f"Written: {folder / 'theory.json'}, {folder / 'theory.png'}, a recording each")
    context.exit(DONE if flights["ftc"].whole else LIMIT_BROKEN)
