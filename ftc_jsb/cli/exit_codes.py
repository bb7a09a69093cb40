"""What the shell is told when a command ends."""

DONE, LIMIT_BROKEN, BAD_USAGE, INTERRUPTED = 0, 1, 2, 130
