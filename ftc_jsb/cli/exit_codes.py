"""What the shell is told when a command ends."""

DONE, LIMIT_BROKEN, BAD_USAGE, UNEXPECTED, INTERRUPTED = 0, 1, 2, 3, 130
