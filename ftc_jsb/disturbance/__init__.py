"""What goes wrong in a flight: faults."""
