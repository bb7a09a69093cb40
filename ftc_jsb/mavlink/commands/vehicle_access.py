"""What the answers to a ground station need of the vehicle."""

from collections.abc import Mapping
from typing import Any, Protocol

from ftc_jsb.mavlink.commands.parameters import Parameters
from ftc_jsb.mavlink.telemetry.snapshot import Snapshot
from ftc_jsb.mavlink.telemetry.streams import Timetable
from ftc_jsb.recording.commands import Command
from ftc_jsb.scenario.schema import Scenario


class Desk(Protocol):
    """The vehicle as its answers see it. Everything happens in the vehicle's own thread."""

    scenario: Scenario
    parameters: Parameters
    timetable: Timetable
    leaves: bool  # the link closes when the flight is over

    def snapshot(self) -> Snapshot:
        """The vehicle now."""

    def send(self, message: type[Any], fields: Mapping[str, Any]) -> None:
        """Send a message."""

    def say(self, severity: int, text: str) -> None:
        """Send a STATUSTEXT."""

    def give(self, command: Command) -> None:
        """Have a command applied at the next step boundary."""
