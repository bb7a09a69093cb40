"""Mutation testing: a change made to one operator or number at a time, and whether a test notices.

`python -m validation.mutants [--sample N]`, with `pip install -e ".[mutants]"`. Law, filter, detector,
verdict and link parser are changed in a copy of the project, and run without the compiler, since a changed
kernel would be compiled anew each time. Written to the terminal: killed and survived by module, and each
survivor's change.
"""

import argparse
import os
import random
import shutil
import subprocess
import sys
import tempfile
from pathlib import Path
from typing import NamedTuple

ROOT = Path(__file__).parents[1]
PATIENCE = 120.0  # [s] of one mutant: a loop that does not end is noticed, too


class Target(NamedTuple):
    """A module, and the tests that are to notice changes of it."""

    module: str
    tests: str


TARGETS = (
    Target("control/law.py", "tests/control/test_law.py"),
    Target("estimation/update.py", "tests/estimation/test_update.py"),
    Target("estimation/detector.py", "tests/estimation/test_detector.py"),
    Target("analysis/verdict.py", "tests/analysis/test_metrics.py tests/analysis/test_limits.py"),
    Target(
        "mavlink/link/receiver.py",
        "tests/mavlink/link/test_signing.py tests/reliability/test_fuzz.py::test_mavlink",
    ),
)
CONFIG = """[cosmic-ray]
module-path = "ftc_jsb/{module}"
timeout = {patience}
excluded-modules = []
test-command = "{python} -m pytest -n 0 -x -q -p no:cacheprovider {tests}"

[cosmic-ray.distributor]
name = "local"
"""


class Score(NamedTuple):
    """What became of the mutants of a module."""

    made: int
    killed: int
    survivors: tuple[str, ...]  # as differences


def score(target: Target, sample: int, folder: Path) -> Score:
    """Try the mutants of a module.

    Args:
        target: the module and its tests.
        sample: how many mutants at most, drawn at random; 0 for all.
        folder: copy of the project.
    """
    from cosmic_ray.work_db import WorkDB, use_db
    from cosmic_ray.work_item import TestOutcome, WorkerOutcome, WorkResult

    config, session = folder / "mutants.toml", folder / "mutants.sqlite"
    session.unlink(missing_ok=True)
    config.write_text(
        CONFIG.format(
            module=target.module, patience=PATIENCE, python=sys.executable, tests=target.tests
        )
    )
    _cosmic_ray(folder, "init", config, session)
    with use_db(session, WorkDB.Mode.open) as found:
        jobs = [item.job_id for item in found.work_items]
        drawn = random.Random(0).sample(jobs, min(sample or len(jobs), len(jobs)))
        for job in set(jobs) - set(drawn):
            found.set_result(job, WorkResult(worker_outcome=WorkerOutcome.SKIPPED))
    _cosmic_ray(folder, "exec", config, session)
    with use_db(session, WorkDB.Mode.open) as found:
        tried = [r for _, r in found.results if r.worker_outcome is not WorkerOutcome.SKIPPED]
    survived = [r for r in tried if r.test_outcome is TestOutcome.SURVIVED]
    return Score(len(tried), len(tried) - len(survived), tuple(str(r.diff) for r in survived))


def _cosmic_ray(folder: Path, *arguments: object) -> None:
    command = [sys.executable, "-m", "cosmic_ray.cli", *map(str, arguments)]
    places = {"NUMBA_DISABLE_JIT": "1", "PYTHONPATH": str(folder)}
    subprocess.run(command, cwd=folder, env={**os.environ, **places}, check=True)


def main() -> None:
    """Every module, in a copy of the project."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--sample", type=int, default=0, help="mutants of a module; 0: all")
    parser.add_argument("--only", default="", help="modules whose path has this in it")
    options = parser.parse_args()
    with tempfile.TemporaryDirectory(prefix="ftc-jsb-mutants-") as scratch:
        folder = Path(scratch) / "project"
        left_out = shutil.ignore_patterns(".*", "__pycache__", "out")
        shutil.copytree(ROOT, folder, ignore=left_out)
        for target in TARGETS:
            if options.only not in target.module:
                continue
            found = score(target, options.sample, folder)
            for difference in found.survivors:
                print(difference, flush=True)
            share = found.killed / max(found.made, 1)
            print(
                f"{target.module}: {found.killed} of {found.made} killed, {share:.0%}", flush=True
            )


if __name__ == "__main__":
    main()
