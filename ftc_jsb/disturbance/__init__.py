"""What a flight is disturbed by: faults, sensors, wind."""
