"""Telemetry logs: each frame after its time as 8 bytes, microseconds since 1970, big-endian."""

import struct
from pathlib import Path
from types import TracebackType
from typing import Self

from ftc_jsb.errors import WriteError


class TelemetryLog:
    """A log that is being written. A disk that fails is noted, not raised in flight."""

    def __init__(self, path: Path) -> None:
        """Open `path` anew; raises OSError if it cannot be written."""
        self.path = path
        self.error = ""  # why frames are lost; empty while none is
        self._file = path.open("wb")

    def write(self, frame: bytes, unix: float) -> None:
        """Append a frame that was sent or received at `unix` [s]."""
        try:
            self._file.write(struct.pack(">Q", max(round(1e6 * unix), 0)) + frame)
        except OSError as error:
            self.error = error.strerror or str(error)

    def close(self) -> None:
        """Finish the file; once it is, `check` knows whether it is whole."""
        try:
            self._file.close()
        except OSError as error:
            self.error = error.strerror or str(error)

    def check(self) -> None:
        """See that nothing is lost.

        Raises:
            WriteError: a frame could not be written.
        """
        if self.error:
            raise WriteError(self.path, f"{self.error}; the log is not complete")

    def __enter__(self) -> Self:
        """The log."""
        return self

    def __exit__(
        self,
        kind: type[BaseException] | None,
        error: BaseException | None,
        trace: TracebackType | None,
    ) -> None:
        """Finish the file; raises WriteError if it is not whole."""
        self.close()
        if error is None:
            self.check()
