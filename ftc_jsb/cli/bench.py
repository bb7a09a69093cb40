"""`ftc-jsb bench`: what steps, flights and commands cost."""

import click

from ftc_jsb.cli.options import examples, json_option
from ftc_jsb.cli.printing import print_json, progress_line


@examples(
    "ftc-jsb bench --json",
)
@click.command()
@json_option
def bench(as_json: bool) -> None:
    """Measure what steps, flights and commands cost, in about two minutes."""
    from ftc_jsb.bench.summary import lines, measure_all

    found = measure_all(progress_line)
    if as_json:
        print_json(found)
    else:
        click.echo("\n".join(lines(found)))
