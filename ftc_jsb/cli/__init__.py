"""The command line, one verb a file."""

from ftc_jsb.cli.main import main

__all__ = ["main"]
