"""`ftc-jsb convert`: a recording for another program."""

from pathlib import Path

import click

from ftc_jsb.cli.options import examples, recording_argument


@examples(
    "ftc-jsb convert flight.nc --to csv",
    "ftc-jsb convert flight.nc --to acmi --out tacview.acmi",
)
@click.command()
@recording_argument
@click.option(
    "--to", "format_", metavar="FORMAT", required=True, help="csv, mat, parquet, acmi or tlog."
)
@click.option(
    "--out", metavar="FILE", type=click.Path(path_type=Path), help="Default: beside the recording."
)
@click.option("--force", is_flag=True, help="Write over FILE.")
def convert(recording: Path, format_: str, out: Path | None, force: bool) -> None:
    """Write a recording in the format of another program."""
    from ftc_jsb.convert import FORMATS
    from ftc_jsb.convert import convert as write
    from ftc_jsb.errors import RecordingError
    from ftc_jsb.recording.netcdf import load

    if format_ not in FORMATS:
        raise RecordingError(f"--to {format_}: no such format; expected {', '.join(FORMATS)}")
    path = out or recording.with_suffix(FORMATS[format_].suffix)
    if path.exists() and not force:
        raise RecordingError(f"{path}: exists; give another file by --out, or --force")
    write(load(recording), format_, path, replace=force)
    click.echo(f"Written: {path}")
