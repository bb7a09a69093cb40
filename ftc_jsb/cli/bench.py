"""`ftc-jsb bench`: what steps, flights and commands cost."""

import json

import click

from ftc_jsb.cli.options import json_option


@click.command()
@json_option
def bench(as_json: bool) -> None:
    """Measure what steps, flights and commands cost, in about two minutes."""
    from ftc_jsb.bench.summary import lines, measure_all

    found = measure_all(lambda line: click.echo(line, err=True))
    if as_json:
        click.echo(json.dumps(found, indent=2))
    else:
        click.echo("\n".join(lines(found)))
