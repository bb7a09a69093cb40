"""The command line as a user runs it, and as it refuses."""

import subprocess
import sys
from pathlib import Path


def run(*arguments: str, cwd: Path) -> subprocess.CompletedProcess[str]:
    return subprocess.run(
        [sys.executable, "-m", "ftc_jsb", *arguments],
        cwd=cwd, capture_output=True, text=True, timeout=120, check=False,
    )  # fmt: skip


def assert_refused(result: subprocess.CompletedProcess[str], *says: str) -> None:
    """Exit code 2, one sentence on stderr, no traceback."""
    assert result.returncode == 2, result.stderr
    assert "Traceback" not in result.stderr
    for text in says:
        assert text in result.stderr
