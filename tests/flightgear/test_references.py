"""References from scenario and pilot: nothing jumps when one takes over from the other."""

import itertools
import math

import pytest

from ftc_jsb.flightgear.references import RATES, Pilot, References
from ftc_jsb.units import STANDARD_GRAVITY

STEP = 0.04  # [s]
NOBODY = Pilot(False, 0.0, 0.0, 0.0)
PLANNED = (300.0, 0.0, 1.0)


def largest_jump(values):
    return [max(abs(b - a) for a, b in itertools.pairwise(v)) for v in zip(*values, strict=True)]


def test_from_what_is_flown_to_what_is_planned_at_bounded_rates():
    """10 m/s, 2 deg and 1 rad off: never faster than RATES, and there after the slowest of them."""
    references = References()
    flown = (290.0, math.radians(2.0), 0.0)
    references.begin_at(flown, PLANNED)
    made = [flown, *(references.raw(PLANNED, NOBODY, STEP) for _ in range(1000))]
    for jump, rate in zip(largest_jump(made), RATES, strict=True):
        assert jump == pytest.approx(rate * STEP)
    assert made[-1] == pytest.approx(PLANNED)


def test_the_pilot_takes_over_and_gives_back_without_a_jump():
    """A pilot who begins at the references (as the simulator has it) banks 30 deg for 4 s: heading turns
    by g tan(bank) / V; back with the scenario, no step is larger than its rate.
    """
    references = References()
    references.begin_at(PLANNED, PLANNED)
    made = [references.raw(PLANNED, NOBODY, STEP)]
    pilot = Pilot(True, 300.0, 0.0, math.radians(30.0))
    made += [references.raw(PLANNED, pilot, STEP) for _ in range(100)]
    turned = 4.0 * STANDARD_GRAVITY * math.tan(math.radians(30.0)) / 300.0
    assert made[-1] == pytest.approx((300.0, 0.0, 1.0 + turned))
    assert references.piloted
    made += [references.raw(PLANNED, NOBODY, STEP) for _ in range(100)]
    for jump, rate in zip(largest_jump(made), RATES, strict=True):
        assert jump <= rate * STEP * 1.0001
    assert made[-1] == pytest.approx(PLANNED)
