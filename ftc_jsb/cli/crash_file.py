"""What is kept of an error that nobody expected: enough to mend it."""

import datetime
import os
import platform
import shlex
import sys
import tempfile
import traceback

import ftc_jsb


def reported(error: Exception) -> str:
    """Write a crash file into the temporary folder; a sentence that says where it is and whom to send it."""
    command = shlex.join(["ftc-jsb", *sys.argv[1:]])
    text = "\n".join(
        (
            f"{datetime.datetime.now().astimezone().isoformat(timespec='seconds')}",
            f"ftc-jsb {ftc_jsb.__version__}, Python {platform.python_version()}, {platform.platform()}",
            command,
            "",
            "".join(traceback.format_exception(error)),
        )
    )
    what = f"{type(error).__name__}: {error}".splitlines()[0][:200]
    try:
        handle, path = tempfile.mkstemp(prefix="ftc-jsb-crash-", suffix=".txt")
        with os.fdopen(handle, "w", encoding="utf-8", errors="replace") as file:
            file.write(text)
    except OSError as unwritten:
        return f"internal error: {what}; no crash file can be written: {unwritten}\n{text}"
    return f"internal error: {what}; please report it with {path} and the files of the command"
