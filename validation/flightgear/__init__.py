"""The real FlightGear flies the fighter, and the outer loop flies FlightGear: `make validate-flightgear`."""
