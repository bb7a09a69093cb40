"""`ftc-jsb export --flightgear`: the woven aircraft as one that FlightGear flies."""
