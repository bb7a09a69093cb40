"""`ftc-jsb list`: what is shipped."""

import click


@click.command("list")
@click.argument("kind", required=False, type=click.Choice(["scenarios", "aircraft", "loops"]))
def list_(kind: str | None) -> None:
    """List what is shipped: scenarios, aircraft, loops."""
    from ftc_jsb.runs.inventory import inventory

    for title, entries in inventory().items():
        if kind in (None, title):
            click.echo(f"{title}:")
            width = max(map(len, entries))
            for name, meaning in entries.items():
                click.echo(f"  {name:<{width}}  {meaning}")
