"""References from scenario and pilot: nothing jumps when one takes over from the other."""

import itertools
import math

import numpy as np
import pytest

from ftc_jsb.flightgear.references import BENDS, RATES, Pilot, References
from ftc_jsb.units import STANDARD_GRAVITY

STEP = 0.04  # [s]
NOBODY = Pilot(False, 0.0, 0.0, 0.0)
PLANNED = (300.0, 0.0, 1.0)


def largest_jump(values):
    return [max(abs(b - a) for a, b in itertools.pairwise(v)) for v in zip(*values, strict=True)]


def fastest_bend(values):
    """Largest change of the rate, a second."""
    rates = np.diff(np.array(values), axis=0) / STEP
    return np.abs(np.diff(rates, axis=0)).max(axis=0) / STEP


def test_from_what_is_flown_to_what_is_planned_at_bounded_rates():
    """10 m/s, 2 deg and 1 rad off: never faster than RATES, nor bent more than BENDS but for the last
    steps, where it stops from four steps of them; and there in the end, to the bit.
    """
    references = References()
    flown = (290.0, math.radians(2.0), 0.0)
    references.begin_at(flown, PLANNED)
    made = [flown, *(references.raw(PLANNED, NOBODY, STEP) for _ in range(1500))]
    for jump, rate in zip(largest_jump(made), RATES, strict=True):
        assert jump <= rate * STEP * 1.0001
    assert (fastest_bend(made) <= 5.0 * np.array(BENDS)).all()
    assert made[-1] == PLANNED
    overshoot = np.array(made) - PLANNED
    assert (np.abs(overshoot[-1000:]).max(axis=0) <= np.abs(overshoot[0])).all()


def test_the_pilot_takes_over_and_gives_back_without_a_jump():
    """A pilot who begins at the references (as the simulator has it) rolls into 30 deg of bank, turns 4 s:
    heading turns by g tan(bank) / V. Given back in the turn, the heading's rate goes on from the turn's.
    """
    references = References()
    references.begin_at(PLANNED, PLANNED)
    made = [references.raw(PLANNED, NOBODY, STEP)]
    for k in range(125):
        bank = math.radians(30.0) * min(k / 25, 1.0)
        made.append(references.raw(PLANNED, Pilot(True, 300.0, 0.0, bank), STEP))
    turn = STANDARD_GRAVITY * math.tan(math.radians(30.0)) / 300.0  # [rad/s]
    assert (made[-1][2] - made[-101][2]) / (100 * STEP) == pytest.approx(turn)
    assert references.piloted
    made += [references.raw(PLANNED, NOBODY, STEP) for _ in range(800)]
    assert fastest_bend(made[100:])[2] <= 5.0 * BENDS[2]
    assert (made[127][2] - made[126][2]) / STEP == pytest.approx(turn, abs=2.0 * BENDS[2] * STEP)
    assert made[-1] == PLANNED
