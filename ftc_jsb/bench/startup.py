"""What a command costs from the shell: time to start, memory, and the first run of all."""

import os
import statistics
import subprocess
import sys
import tempfile
import time
from collections.abc import Mapping
from pathlib import Path

COMMANDS = {
    "help_s": ("--help",),
    "list_s": ("list",),
    "check_paper_s": ("check", "paper", "--set", 'compare.models=["paper"]'),
}
ROUNDS = 5


def run(
    arguments: tuple[str, ...], environment: Mapping[str, str] | None = None
) -> tuple[float, float]:
    """Wall time [s] and peak memory [MB] of one command."""
    started = time.perf_counter()
    process = subprocess.Popen(
        [sys.executable, "-m", "ftc_jsb", *arguments],
        env=environment,
        stdout=subprocess.DEVNULL,
        stderr=subprocess.DEVNULL,
    )
    _, status, usage = os.wait4(process.pid, 0)
    process.returncode = os.waitstatus_to_exitcode(status)
    if process.returncode != 0:
        raise RuntimeError(f"ftc-jsb {' '.join(arguments)} ended with {process.returncode}")
    return time.perf_counter() - started, usage.ru_maxrss / 1024.0  # ru_maxrss is in KiB


def measure_startup() -> dict[str, float]:
    """Median times of commands, of `fly paper`, and the memory that it takes."""
    with tempfile.TemporaryDirectory() as folder:
        flight = ("fly", "paper", "--force", "--out", str(Path(folder) / "flight"))
        run(flight)
        times: dict[str, list[float]] = {name: [] for name in (*COMMANDS, "fly_paper_s")}
        memory = 0.0
        for _ in range(ROUNDS):
            for name, arguments in COMMANDS.items():
                times[name].append(run(arguments)[0])
            wall, peak = run(flight)
            times["fly_paper_s"].append(wall)
            memory = max(memory, peak)
    return {name: statistics.median(found) for name, found in times.items()} | {
        "peak_rss_mb": memory
    }


def measure_first_run() -> dict[str, float]:
    """`fly paper` where no kernel has been compiled: an empty cache folder."""
    with tempfile.TemporaryDirectory() as folder:
        fresh = {**os.environ, "XDG_CACHE_HOME": folder}
        flight = ("fly", "paper", "--out", str(Path(folder) / "flight"))
        return {"first_run_s": run(flight, fresh)[0]}
