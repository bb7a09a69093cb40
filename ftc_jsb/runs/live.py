"""Real time and ground stations, as a flight sees them."""

from collections.abc import Sequence
from typing import Protocol

from ftc_jsb.recording.flight import Flight
from ftc_jsb.simulation.command_source import CommandSource
from ftc_jsb.simulation.fly import Observer


class Live(Protocol):
    """Real time and ground stations, as a flight sees them."""

    @property
    def observers(self) -> Sequence[Observer]:
        """They watch the flight, or hold it back to the clock."""

    @property
    def commands(self) -> CommandSource | None:
        """From ground stations; None if there is no link."""

    def flies_again(self, flight: Flight) -> bool:
        """A flight is over and saved; whether another of the same scenario is wanted."""

    def announce(self, text: str) -> None:
        """Tell ground stations something that stands in no row."""

    def summary(self) -> list[str]:
        """What went over the link, and how well time was kept; for the user."""
