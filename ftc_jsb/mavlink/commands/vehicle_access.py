"""What the handlers of a ground station's messages need of the vehicle."""

from collections.abc import Mapping
from typing import Any, Protocol

from ftc_jsb.mavlink.commands.parameters import Parameters
from ftc_jsb.mavlink.telemetry.message_streams import Station, StreamSchedule
from ftc_jsb.mavlink.telemetry.snapshot import Snapshot
from ftc_jsb.recording.commands import Command
from ftc_jsb.scenario.schema import Scenario


class VehicleAccess(Protocol):
    """The vehicle as its message handlers see it. Everything happens in the vehicle's own thread."""

    scenario: Scenario
    parameters: Parameters
    schedule: StreamSchedule
    station: Station  # whose message is being acted on
    leaves_after_flight: bool  # whether the link closes when the flight is over

    def snapshot(self) -> Snapshot:
        """The vehicle now."""

    def send(self, message: type[Any], fields: Mapping[str, Any]) -> None:
        """Send a message."""

    def send_text(self, severity: int, text: str) -> None:
        """Send a STATUSTEXT."""

    def queue_command(self, command: Command) -> None:
        """Have a command applied at the next step boundary."""
