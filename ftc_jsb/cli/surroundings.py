"""What a command needs of its surroundings, seen before anything is imported: readable arguments, memory."""

import resource
from collections.abc import Sequence

from ftc_jsb.errors import UserError

# Of address space: with less, libraries of linear algebra do not fail but wait for ever, and reports
# have been seen to need 1.2 GB.
LEAST_MEMORY = 1_500_000_000  # bytes
FRUGAL = ("check", "completion", "list", "schema")  # commands that need a third of it


def check_arguments(arguments: Sequence[str]) -> None:
    """See that every argument is a text that can be printed and written.

    Raises:
        UserError: one is not UTF-8.
    """
    for argument in arguments:
        try:
            argument.encode()
        except UnicodeEncodeError:
            shown = argument.encode("utf-8", "backslashreplace").decode()[:80]
            raise UserError(f"argument {shown!r}: expected UTF-8") from None


def check_memory(command: str) -> None:
    """See that the process may have as much memory as a command needs.

    Raises:
        UserError: its limit is lower.
    """
    limit, _ = resource.getrlimit(resource.RLIMIT_AS)
    if limit == resource.RLIM_INFINITY or limit >= LEAST_MEMORY or command in FRUGAL:
        return
    raise UserError(
        f"there is not enough memory for this: address space is limited to {limit / 1e9:.2g} GB "
        f"(ulimit -v); expected {LEAST_MEMORY / 1e9:g} GB or more"
    )
