"""Kernels of the loop of one system, in a folder that is copied for each system.

`system.py` here is the least system there is; `generated.py` writes another in its place, imports the
copy as a package of its own, and so Numba can keep all of it on the disk.
"""
