"""Virtual flight tests that fit a point mass to a JSBSim aircraft."""
