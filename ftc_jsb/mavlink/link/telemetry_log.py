"""Telemetry logs: each frame after its time as 8 bytes, microseconds since 1970, big-endian."""

import struct
from pathlib import Path
from types import TracebackType
from typing import Self


class TelemetryLog:
    """A log that is being written. A disk that fails is counted, not raised in flight."""

    def __init__(self, path: Path) -> None:
        """Open `path` anew; raises OSError if it cannot be written."""
        self.lost = 0  # frames
        self._file = path.open("wb")

    def write(self, frame: bytes, unix: float) -> None:
        """Append a frame that was sent or received at `unix` [s]."""
        try:
            self._file.write(struct.pack(">Q", max(round(1e6 * unix), 0)) + frame)
        except OSError:
            self.lost += 1

    def close(self) -> None:
        """Finish the file."""
        try:
            self._file.close()
        except OSError:
            self.lost += 1

    def __enter__(self) -> Self:
        """The log."""
        return self

    def __exit__(
        self,
        kind: type[BaseException] | None,
        error: BaseException | None,
        trace: TracebackType | None,
    ) -> None:
        """Finish the file."""
        self.close()
