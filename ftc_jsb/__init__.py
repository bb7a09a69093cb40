"""Fault-tolerant flight control of Zhou et al. (2014) on a point mass and on JSBSim fighters."""

__version__ = "0.1.0"
