"""`ftc-jsb list`: what is shipped."""

import click

from ftc_jsb.cli.options import examples, json_option
from ftc_jsb.cli.printing import print_json


@examples(
    "ftc-jsb list",
    "ftc-jsb list loops --json",
)
@click.command("list")
@click.argument("kind", required=False, type=click.Choice(["scenarios", "aircraft", "loops"]))
@json_option
def list_(kind: str | None, as_json: bool) -> None:
    """List what is shipped: scenarios, aircraft, loops."""
    from ftc_jsb.runs.inventory import inventory

    found = {title: entries for title, entries in inventory().items() if kind in (None, title)}
    if as_json:
        print_json(found)
        return
    for title, entries in found.items():
        click.echo(f"{title}:")
        width = max(map(len, entries))
        for name, meaning in entries.items():
            click.echo(f"  {name:<{width}}  {meaning}")
