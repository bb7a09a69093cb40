"""`ftc-jsb campaign`: many dispersed flights, one of them again, and their summary."""

import sys
from pathlib import Path
from typing import Any

import click

from ftc_jsb.cli.completed_names import campaigns
from ftc_jsb.cli.options import examples, force_option
from ftc_jsb.cli.printing import message


class _FileOrVerb(click.Group):
    """What is no verb is the file of a campaign."""

    def resolve_command(
        self, ctx: click.Context, args: list[str]
    ) -> tuple[str | None, click.Command | None, list[str]]:
        if args and args[0] in self.commands:
            return super().resolve_command(ctx, args)
        return "fly", self.commands["fly"], args

    def parse_args(self, ctx: click.Context, args: list[str]) -> list[str]:
        if args and args[0] not in ("-h", "--help", *self.commands):
            args = ["fly", *args]
        return super().parse_args(ctx, args)


@examples(
    "ftc-jsb campaign smoke --dry-run",
    "ftc-jsb campaign robustness --out robust --workers 8",
    "ftc-jsb campaign robustness --out robust --resume",
    "ftc-jsb campaign rerun robust --case 17",
)
@click.group(cls=_FileOrVerb, subcommand_metavar="FILE [OPTIONS] | rerun DIR | report DIR")
def campaign() -> None:
    """Fly the campaign FILE; or `rerun` one case of DIR, or make the `report` of DIR again.

    FILE is the path of a .toml file or the name of a shipped campaign.
    """


@campaign.command(hidden=True)
@click.argument("file", metavar="FILE", shell_complete=campaigns)
@click.option(
    "--out", metavar="DIR", type=click.Path(path_type=Path), help="Folder for the results."
)
@force_option
@click.option(
    "--workers",
    metavar="N",
    type=click.IntRange(1, 1024),
    help="Of the local cluster; default: one a core.",
)
@click.option(
    "--scheduler", metavar="ADDRESS", help="Of a Dask scheduler, such as tcp://host:8786."
)
@click.option("--resume", is_flag=True, help="Go on in DIR with what is not flown yet.")
@click.option("--search", is_flag=True, help="Look for the worst case in place of sampling.")
@click.option(
    "--dry-run", is_flag=True, help="Say how many flights and about how long, and fly none of them."
)
def fly(file: str, **options: Any) -> None:
    """Fly the campaign FILE; write results.parquet, summary.json and report.html."""
    from ftc_jsb.campaign.load import load_campaign
    from ftc_jsb.cli.campaign_run import Options, dry_run, run

    chosen = Options(**options)
    if chosen.resume and chosen.out is None:
        raise click.UsageError("--resume needs --out DIR: the folder of the campaign to go on with")
    bases = load_campaign(file)
    if chosen.dry_run:
        dry_run(bases, chosen)
        return
    run(bases, chosen)


@campaign.command()
@click.argument("folder", metavar="DIR", type=click.Path(path_type=Path))
@click.option(
    "--case",
    "number",
    metavar="N",
    type=click.IntRange(0),
    required=True,
    help="Number of the case.",
)
@click.option("--out", metavar="DIR", type=click.Path(path_type=Path), help="Default: DIR/case-N.")
@force_option
def rerun(folder: Path, number: int, out: Path | None, force: bool) -> None:
    """Fly one case of the campaign in DIR again, the same to the bit, with recordings and report."""
    from ftc_jsb.campaign.run import rerun as fly_again
    from ftc_jsb.cli.campaign_run import write_case
    from ftc_jsb.runs.output_folder import output_folder

    rows, changed, recordings = fly_again(folder, number)
    with output_folder(out or folder / f"case-{number}", "case", force) as place:
        write_case(folder, number, rows, recordings, place)
    if changed:
        message(f"case {number} is not what it was: {', '.join(changed[:8])} differ")
        sys.exit(1)


@campaign.command()
@click.argument("folder", metavar="DIR", type=click.Path(path_type=Path))
def report(folder: Path) -> None:
    """Write summary.json and report.html of the campaign in DIR again."""
    from ftc_jsb.cli.campaign_run import summarize

    summarize(folder)
