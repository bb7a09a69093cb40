"""The folder of a campaign: finished batches as Parquet, written atomically, taken up again after anything."""

import fcntl
import json
import os
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import Any

from ftc_jsb.campaign.case import Bases
from ftc_jsb.campaign.flights import Batch, Row
from ftc_jsb.campaign.load import FILE, load_campaign, values_of, write_campaign
from ftc_jsb.campaign.parquet import merge, read_rows, write_rows, writing
from ftc_jsb.errors import RecordingError

RESULTS, BATCHES, RECORDINGS, PROVENANCE = "results.parquet", "batches", "recordings", "made.json"
SEARCH, SUBSET = "search.json", "subset.json"
_OLD = (RESULTS, SEARCH, SUBSET)  # of another campaign that was there


class Store:
    """Results of a campaign in a folder that nobody else writes."""

    def __init__(self, folder: Path) -> None:
        """Args: of `opened`."""
        self.folder = folder

    def batches(self) -> list[Path]:
        """Finished batches."""
        return sorted((self.folder / BATCHES).glob("*.parquet"))

    def finished(self) -> set[int]:
        """Numbers of the cases that need not be flown again."""
        return {row["case"] for path in self.batches() for row in read_rows(path, ["case"])}

    def rows(self, columns: list[str] | None = None) -> list[Row]:
        """Rows of every finished batch, or some columns of them."""
        return [row for path in self.batches() for row in read_rows(path, columns)]

    def add(self, batch: Batch) -> None:
        """Write a batch: its recordings, and then its rows, which say that it is finished.

        Raises:
            RecordingError: the disk is full, or cannot be written; the batch is not finished then.
        """
        for (number, label), contents in batch.recordings.items():
            self.keep(number, label, contents)
        numbers = [row["case"] for row in batch.rows]
        name = f"{min(numbers):08d}-{len(set(numbers))}.parquet"
        write_rows(batch.rows, self.folder / BATCHES / name)

    def kept(self, number: int) -> bool:
        """Whether there are recordings of a case."""
        return self._place(number).is_dir()

    def _place(self, number: int) -> Path:
        return self.folder / RECORDINGS / f"case-{number:08d}"

    def keep(self, number: int, label: str, contents: bytes) -> None:
        """Write a recording of a case."""
        path = self._place(number) / f"{label.replace(os.sep, '.')}.nc"
        with writing(path) as part:
            part.write_bytes(contents)

    def finish(self, end: int) -> None:
        """Write `results.parquet` of the cases below `end`; batches are then of no more use.

        Raises:
            RecordingError: it cannot be written; the batches stay.
        """
        merge(self.batches(), self.folder / RESULTS, end)
        for path in self.batches():
            path.unlink()

    def cases(self) -> int:
        """Cases in `results.parquet`."""
        return len({row["case"] for row in read_rows(self.folder / RESULTS, ["case"])})

    @property
    def complete(self) -> bool:
        """Whether all of the campaign is flown."""
        return (self.folder / RESULTS).is_file()


@contextmanager
def opened(folder: Path, bases: Bases, made: dict[str, Any], resume: bool) -> Iterator[Store]:
    """A campaign's folder, locked as long as it is open; a killed process leaves no lock.

    Args:
        folder: exists.
        bases: the campaign that is to be there.
        made: with what it is flown.
        resume: go on with what is there.

    Raises:
        RecordingError: another process writes it, it holds another campaign, or it cannot be written.
    """
    try:
        with (folder / "lock").open("w") as lock:
            try:
                fcntl.flock(lock, fcntl.LOCK_EX | fcntl.LOCK_NB)
            except BlockingIOError:
                raise RecordingError(f"{folder}: another process flies a campaign there") from None
            if (folder / FILE).is_file() and resume:
                _check_same(folder, bases, made)
            else:
                for path in (
                    *(folder / name for name in _OLD),
                    *(folder / BATCHES).glob("*.parquet"),
                ):
                    path.unlink(missing_ok=True)
                with writing(folder / PROVENANCE) as part:
                    part.write_text(json.dumps(made, indent=2) + "\n", encoding="utf-8")
                write_campaign(bases, folder)
            (folder / BATCHES).mkdir(exist_ok=True)
            for part in folder.rglob("*.part"):
                part.unlink()
            yield Store(folder)
            if not any((folder / BATCHES).glob("*")):
                (folder / BATCHES).rmdir()
    except OSError as error:
        raise RecordingError(f"{folder}: cannot be written: {error.strerror}") from None


def _check_same(folder: Path, bases: Bases, made: dict[str, Any]) -> None:
    """See that a folder's campaign is this one, flown with the same program."""
    before, now = values_of(load_campaign(str(folder / FILE))), values_of(bases)
    before["campaign"]["scenarios"] = now["campaign"]["scenarios"]  # there they have other paths
    for part in ("campaign", "scenarios"):
        if before[part] != now[part]:
            raise RecordingError(
                f"{folder}: holds another campaign ({part} differ); give another --out"
            )
    try:
        there = json.loads((folder / PROVENANCE).read_text(encoding="utf-8"))
    except (OSError, ValueError) as error:
        raise RecordingError(f"{folder / PROVENANCE}: cannot be read: {error}") from None
    if there.get("purpose") != made["purpose"]:
        raise RecordingError(
            f"{folder}: was begun as {there.get('purpose')}, not {made['purpose']}; give another --out"
        )
    if there.get("code") != made["code"]:
        raise RecordingError(
            f"{folder}: was begun with another version of ftc-jsb, of a package or of an aircraft; "
            "its rows and new ones would not be of one campaign"
        )
