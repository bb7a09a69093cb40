"""`ftc-jsb schema`: JSON Schema of scenario and campaign files, for editors."""

import json

import click

from ftc_jsb.cli.options import examples

KINDS = ("scenario", "campaign")


@examples("ftc-jsb schema scenario > scenario.json")
@click.command()
@click.argument("kind", type=click.Choice(KINDS))
def schema(kind: str) -> None:
    """Print the JSON Schema of scenario or campaign files.

    Shipped files name theirs in the first line, as taplo and Even Better TOML read it. For files of your own,
    write it to a file, say scenario.json, and make `#:schema ./scenario.json` the first line of yours.
    """
    from ftc_jsb.file_schema import json_schema

    if kind == "scenario":
        from ftc_jsb.scenario.schema import Scenario

        found = json_schema(Scenario, "Scenario of ftc-jsb")
    else:
        from ftc_jsb.campaign.schema import Campaign

        found = json_schema(Campaign, "Campaign of ftc-jsb")
    click.echo(json.dumps(found, indent=2, ensure_ascii=False))
