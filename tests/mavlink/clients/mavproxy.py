"""MAVProxy on a pseudo-terminal, as a user at a keyboard has it."""

import os
import pty
import re
import select
import subprocess
import sys
import time
from pathlib import Path


class MavProxy:
    """A running MAVProxy; `output` is all it has shown."""

    def __init__(self, port: int, folder: Path) -> None:
        ours, theirs = pty.openpty()
        self._terminal = ours
        program = Path(sys.executable).parent / "mavproxy.py"
        self._process = subprocess.Popen(
            [sys.executable, "-W", "ignore", program, f"--master=udpin:127.0.0.1:{port}",
             f"--state-basedir={folder}", "--logfile=flight.tlog"],
            stdin=theirs, stdout=theirs, stderr=theirs, cwd=folder, close_fds=True,
            env={**os.environ, "HOME": str(folder), "TERM": "dumb"},
        )  # fmt: skip
        os.close(theirs)
        self.output = ""

    def read(self, seconds: float) -> None:
        """Listen for so long."""
        until = time.monotonic() + seconds
        while (left := until - time.monotonic()) > 0.0:
            if select.select([self._terminal], [], [], left)[0]:
                try:
                    self.output += os.read(self._terminal, 4096).decode(errors="replace")
                except OSError:
                    return

    def wait_for(self, pattern: str, within: float) -> float:
        """Time [s] until `pattern` was shown.

        Raises:
            AssertionError: it was not.
        """
        started = time.monotonic()
        while not re.search(pattern, self.output):
            if time.monotonic() - started > within:
                raise AssertionError(f"MAVProxy did not show {pattern!r}:\n{self.output}")
            self.read(0.05)
        return time.monotonic() - started

    def type(self, line: str) -> None:
        """Enter a line."""
        os.write(self._terminal, f"{line}\n".encode())

    def close(self) -> None:
        """End the program and wait for it."""
        self._process.kill()  # it asks whether it is meant otherwise
        self._process.wait()
        os.close(self._terminal)
