"""JSBSim: weaving, trim, plant."""
