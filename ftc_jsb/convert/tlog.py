"""A MAVLink telemetry log: mavlogdump, MAVExplorer, Mission Planner, QGroundControl."""

from pathlib import Path

from ftc_jsb.recording.flight import Flight


def write(flight: Flight, path: Path) -> None:
    """Write the telemetry that `flight` would have sent."""
    from ftc_jsb.mavlink.telemetry.recording_to_tlog import write_tlog

    write_tlog(flight, path)
