"""Whose fault it may be: what the isolation decides among, by number."""

from ftc_jsb.vocabulary.channels import SURFACES
from ftc_jsb.vocabulary.signals import SENSED

NOBODY, THRUST_LOSS = 0, 1
FIRST_INSTRUMENT = 2
FIRST_SURFACE = FIRST_INSTRUMENT + len(SENSED)
HYPOTHESES: tuple[str, ...] = ("healthy", "thrust", *SENSED, *SURFACES, "unknown")
UNKNOWN = len(HYPOTHESES) - 1


def hypothesis(number: float) -> str:
    """Name of a number of the column `suspect`; "unknown" of one that is none, as a file may hold."""
    known = 0 <= number < len(HYPOTHESES)
    return HYPOTHESES[int(number)] if known else HYPOTHESES[UNKNOWN]
