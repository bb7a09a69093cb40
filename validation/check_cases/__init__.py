"""NASA's atmospheric check cases (NASA/TM-2015-218675), flown by JSBSim through this program's own stepping."""
