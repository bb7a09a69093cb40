"""The command line: parse, call, print. Imports what a command needs only when it runs."""

from ftc_jsb.cli.main import main

__all__ = ["main"]
