"""The vehicle that a ground station sees: MAVLink 2 telemetry, answers, commands and logs."""
