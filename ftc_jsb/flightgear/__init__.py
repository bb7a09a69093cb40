"""FlightGear as a viewer."""
