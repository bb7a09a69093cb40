"""Whose fault it may be: what the isolation decides among, by number."""

from ftc_jsb.vocabulary.signals import SENSED

NOBODY, THRUST_LOSS = 0, 1
FIRST_INSTRUMENT = 2
HYPOTHESES: tuple[str, ...] = ("healthy", "thrust", *SENSED, "unknown")
UNKNOWN = len(HYPOTHESES) - 1
