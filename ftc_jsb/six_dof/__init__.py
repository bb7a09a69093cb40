"""JSBSim: woven aircraft, trim, the plant of the outer loop, flights by commands alone."""
