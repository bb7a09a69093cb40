"""`campaign`: many dispersed flights in parallel, into a folder."""

from os import PathLike, fspath
from pathlib import Path
from typing import TYPE_CHECKING, Any

from ftc_jsb.api.announcement import Bar, compiling

if TYPE_CHECKING:
    import pandas


class Campaign:
    """The folder of a campaign that was flown."""

    def __init__(self, folder: Path, summary: dict[str, Any]) -> None:
        """Args: the folder; the contents of its summary.json."""
        self.folder = folder
        self.summary = summary

    @property
    def report(self) -> Path:
        """Path of the report."""
        return self.folder / "report.html"

    def to_pandas(self) -> "pandas.DataFrame":
        """A row a case, model and loop: `results.parquet`."""
        import pandas

        return pandas.read_parquet(self.folder / "results.parquet")

    def __repr__(self) -> str:
        """One line."""
        return f"<Campaign in {self.folder}: {'; '.join(self.summary['lines'][:1])}>"

    def _repr_html_(self) -> str:
        """For notebooks."""
        from html import escape

        return "<br>".join(escape(line) for line in self.summary["lines"])


def campaign(
    file: str | PathLike[str],
    folder: str | PathLike[str],
    *,
    workers: int | None = None,
    scheduler: str | None = None,
    resume: bool = False,
    search: bool = False,
    progress: bool | None = None,
) -> Campaign:
    """Fly a campaign into a folder, as `ftc-jsb campaign` does.

    A program that calls this with local workers needs `if __name__ == "__main__":` around it: they
    are processes that import it.

    Args:
        file: path of a .toml file, or the name of a shipped campaign.
        folder: for the results; empty, or to be resumed.
        workers: of the local cluster; default: one a core.
        scheduler: address of a Dask scheduler in place of a local cluster.
        resume: go on with what is not flown yet.
        search: look for the worst case in place of sampling.
        progress: whether to show a bar; by default on a terminal and in a notebook.

    Raises:
        UserError: a file, a folder, a scheduler or a worker that cannot be used.
    """
    from ftc_jsb.campaign.adaptive import search_campaign, subset_campaign
    from ftc_jsb.campaign.cluster import connected
    from ftc_jsb.campaign.load import load_campaign
    from ftc_jsb.campaign.report import write_campaign_report
    from ftc_jsb.campaign.run import fly_campaign
    from ftc_jsb.runs.output_folder import output_folder

    bases = load_campaign(fspath(file))
    run = fly_campaign if bases.campaign.subset is None else subset_campaign
    if search:
        run = search_campaign
    with output_folder(Path(folder), bases.campaign.name, resume, "campaign folder") as place:
        compiling()
        bar = Bar("Campaign", shown=progress)
        try:
            with connected(scheduler, workers) as client:
                run(
                    bases,
                    place,
                    client,
                    resume,
                    lambda done, total, _: bar.step(f"{done}/{total} cases"),
                )
        finally:
            bar.close()
        return Campaign(place, write_campaign_report(place))
