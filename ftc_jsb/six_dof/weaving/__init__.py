"""Weaving: the installed JSBSim aircraft with inner loop, engine deck, faults and corrections put in."""
