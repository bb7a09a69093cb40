"""What a woven aircraft exchanges with an outer loop outside: fields of a line, and the JSBSim system."""
