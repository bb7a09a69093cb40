"""Reference page of the columns of a recording, made from where they are defined."""

from mkdocs.config.defaults import MkDocsConfig
from mkdocs.structure.files import File, Files

from ftc_jsb.recording.columns import VARIABLES

TEXT = """# Columns of a recording

Every variable of `flight.nc`, along `time`: name, unit, meaning. `flight.to_xarray()` has them with their
attributes, `flight.to_pandas()` as columns; what a flight does not have is nan. What a recording holds besides
is in [scenarios](../scenarios.md#recording).

| column | unit | |
|---|---|---|
"""


def on_files(files: Files, config: MkDocsConfig) -> Files:
    """MkDocs' hook: the page joins the files of the site."""
    rows = (f"| `{column.name}` | {column.unit} | {column.meaning} |\n" for column in VARIABLES)
    page = TEXT + "".join(rows).replace("[", "\\[")
    files.append(File.generated(config, "reference/columns.md", content=page))
    return files
