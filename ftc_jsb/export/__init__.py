"""`ftc-jsb export`: the woven aircraft for plain JSBSim."""
