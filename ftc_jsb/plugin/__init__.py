"""The outer loop on a JSBSim instance of the user's own: see docs/plugin.md."""

from ftc_jsb.plugin.outer_loop import OuterLoop
from ftc_jsb.plugin.woven import load_woven, woven_root

__all__ = ["OuterLoop", "load_woven", "woven_root"]
