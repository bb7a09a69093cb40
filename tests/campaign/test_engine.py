"""However a campaign is interrupted and whoever flies it, its rows are those of an undisturbed run."""

import os
import re
import signal
import subprocess
import sys
import time
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import pytest

from ftc_jsb.campaign.flights import Item, fly_items
from ftc_jsb.campaign.load import load_campaign
from ftc_jsb.campaign.parquet import merge, read_rows, write_rows
from ftc_jsb.campaign.run import work_of
from tests.campaign.campaign_files import SMALL, campaign_file
from tests.cli.command import assert_refused, run

CASES = 240  # of two flights of 8 s: some seconds of work for two workers
Rows = list[dict[str, Any]]


@pytest.fixture(scope="module")
def file(tmp_path_factory: pytest.TempPathFactory) -> Path:
    return campaign_file(tmp_path_factory.mktemp("campaign"), cases=str(CASES))


@pytest.fixture(scope="module")
def undisturbed(file: Path) -> Rows:
    """Flown here, one after the other, without Dask; by way of a file, as the others are."""
    bases = load_campaign(str(file))
    batch = fly_items(work_of(bases), [Item(number) for number in range(CASES)])
    path = file.with_name("one.parquet")
    write_rows(batch.rows, path)
    merge([path], file.with_name("all.parquet"), CASES)
    return read_rows(file.with_name("all.parquet"))


def started(file: Path, out: Path, *options: str) -> subprocess.Popen[str]:
    command = [sys.executable, "-m", "ftc_jsb", "campaign", str(file), "--out", str(out), *options]
    return subprocess.Popen(
        command, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True, start_new_session=True
    )


def wait_for(condition: Any, seconds: float = 90.0) -> None:
    end = time.monotonic() + seconds
    while not condition():
        assert time.monotonic() < end, "nothing happens"
        time.sleep(0.02)


def batches(out: Path) -> set[str]:
    return {path.name for path in (out / "batches").glob("*.parquet")}


@pytest.fixture
def small_disk(tmp_path: Path) -> Iterator[Path]:
    disk = tmp_path / "disk"
    disk.mkdir()
    command = ["mount", "-t", "tmpfs", "-o", "size=2m", "tmpfs", str(disk)]
    if os.geteuid() != 0 or subprocess.run(command, capture_output=True, check=False).returncode:
        pytest.skip("no tmpfs can be mounted here")
    yield disk
    subprocess.run(["umount", "-l", str(disk)], check=True)


def test_stopped_killed_out_of_disk_then_resumed(
    file: Path, undisturbed: Rows, small_disk: Path
) -> None:
    """Kill -9 of the client, a full disk, Ctrl-C's place: no finished batch is lost or flown again."""
    out = small_disk / "out"
    client = started(file, out, "--workers", "2")
    wait_for(lambda: len(batches(out)) >= 2)
    os.killpg(client.pid, signal.SIGINT)  # as a terminal does: the workers get it, too
    _, said = client.communicate(timeout=60)
    assert client.returncode == 130, said
    assert "--resume" in said
    assert "Traceback" not in said

    client = started(file, out, "--workers", "2", "--resume")
    there = len(batches(out))
    wait_for(lambda: len(batches(out)) >= there + 2)
    client.kill()
    client.communicate()
    before = batches(out)
    assert len(before) >= 3
    assert not (out / "results.parquet").exists()

    (small_disk / "filler").write_bytes(bytes(_free(small_disk) - 4096))
    full = started(file, out, "--workers", "2", "--resume")
    _, said = full.communicate(timeout=120)
    assert full.returncode == 2, said
    assert "cannot be written" in said
    assert "No space left" in said
    assert "Traceback" not in said
    assert before <= batches(out)

    (small_disk / "filler").unlink()
    last = started(file, out, "--workers", "2", "--resume")
    _, said = last.communicate(timeout=120)
    assert last.returncode == 0, said
    found = re.search(r"(\d+) of them flown now", said)
    assert found is not None
    assert int(found[1]) < CASES
    assert read_rows(out / "results.parquet") == undisturbed
    assert not batches(out)


def _free(disk: Path) -> int:
    status = os.statvfs(disk)
    return status.f_bavail * status.f_bsize


@pytest.fixture
def cluster(tmp_path: Path) -> Iterator[tuple[str, list[subprocess.Popen[bytes]]]]:
    """A scheduler and two workers, each started by its own command."""
    place = tmp_path / "scheduler.json"
    quiet = {"stdout": subprocess.DEVNULL, "stderr": subprocess.DEVNULL, "cwd": tmp_path}
    scheduler = subprocess.Popen(
        [
            sys.executable, "-m", "distributed.cli.dask_scheduler", "--host", "127.0.0.1", "--port", "0",
            "--dashboard-address", ":0", "--scheduler-file", str(place),
        ], **quiet,
    )  # fmt: skip
    workers = [
        subprocess.Popen(
            [
                sys.executable, "-m", "distributed.cli.dask_worker", "--scheduler-file", str(place),
                "--nthreads", "1", "--no-nanny", "--no-dashboard", "--local-directory", str(tmp_path),
            ], **quiet,
        )
        for _ in range(2)
    ]  # fmt: skip
    wait_for(place.exists)
    found = re.search(r'"address": "(tcp://[^"]+)"', place.read_text())
    assert found is not None
    yield found[1], workers
    for process in (*workers, scheduler):
        process.kill()
        process.wait()


def test_other_workers_and_a_dead_one_give_the_same_rows(
    file: Path, undisturbed: Rows, tmp_path: Path, cluster: Any
) -> None:
    """Scheduler and workers started separately, and one of them killed on the way."""
    address, workers = cluster
    out = tmp_path / "out"
    client = started(file, out, "--scheduler", address)
    wait_for(lambda: len(batches(out)) >= 2)
    os.kill(workers[0].pid, signal.SIGKILL)
    _, said = client.communicate(timeout=120)
    assert client.returncode == 0, said
    assert "Dashboard: http" in said
    assert read_rows(out / "results.parquet") == undisturbed


def test_no_scheduler_there_is_one_sentence(file: Path, tmp_path: Path) -> None:
    result = run(
        "campaign", str(file), "--out", "o", "--scheduler", "tcp://127.0.0.1:9", cwd=tmp_path
    )
    assert_refused(result, "no Dask scheduler answers")


def test_a_case_that_kills_its_process_is_a_row(tmp_path: Path) -> None:
    """As JSBSim might by a fault of its own: the case says so, the others fly."""
    text = SMALL.split("[[dispersion]]")[0].replace("cases = 12", 'sampling = "grid"')
    text = text.replace('"ftc", "no-ftc"', '"tests.campaign.deadly_loop:DeadlyLoop"').replace(
        "8.0", "1.0"
    )
    text += '[[dispersion]]\nkey = "loop.trim_filter"\ndistribution = "choice"\n'
    text += "values = [40.0, 50.0, 13.0, 60.0]\n"
    file = campaign_file(tmp_path, text)
    client = started(file, tmp_path / "out", "--workers", "1")
    _, said = client.communicate(timeout=200)
    assert client.returncode == 0, said
    errors = {row["case"]: row["error"] for row in read_rows(tmp_path / "out" / "results.parquet")}
    assert errors == {0: None, 1: None, 2: "the process that flew it died", 3: None}
