"""The vehicle that a ground station sees: MAVLink 2 telemetry, commands and their acknowledgements, logs."""
