"""Kernels compiled before they are needed: what a flight needs and no more, in two processes at once."""

from ftc_jsb.warm.compiling import is_cold, warm
from ftc_jsb.warm.needs import EVERYTHING, Flown, needs

__all__ = ["EVERYTHING", "Flown", "is_cold", "needs", "warm"]
