"""Failures that are the user's to mend: one clear sentence, exit code 2, no traceback."""


class UserError(Exception):
    """Bad usage, a bad file or a trim failure. The message names the file, the key or property,
    the value and what was expected.
    """


class ScenarioError(UserError):
    """A scenario file or an override of it cannot be used."""


class AircraftError(UserError):
    """An aircraft folder cannot be used: missing, invalid, or not what JSBSim accepts."""


class TrimError(UserError):
    """JSBSim found no trim at the initial condition, or the trim does not hold."""


class LoopError(UserError):
    """An outer loop cannot be found, built or used."""


class RecordingError(UserError):
    """A recording cannot be read, or a folder for one cannot be written."""


class WriteError(RecordingError):
    """A file cannot be written: the disk is full, the folder is read-only, the file is there already."""

    def __init__(self, path: object, reason: str) -> None:
        """Args: of what file; why."""
        super().__init__(f"{path}: cannot be written: {reason}")
        self.path = path
        self.reason = reason


class FigureError(UserError):
    """A figure cannot be drawn as asked for."""


class TheoryError(UserError):
    """A system that the theory does not cover; says which output, input or matrix, and where."""


class LinkError(UserError):
    """An endpoint, a key or a log of the MAVLink vehicle cannot be used."""
