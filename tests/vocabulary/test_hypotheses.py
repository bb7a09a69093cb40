"""Numbers of the column `suspect`, which a file may hold any of."""

import math

import pytest

from ftc_jsb.vocabulary.hypotheses import HYPOTHESES, hypothesis


def test_every_hypothesis_has_its_number():
    assert [hypothesis(number) for number in range(len(HYPOTHESES))] == list(HYPOTHESES)


@pytest.mark.parametrize("number", [len(HYPOTHESES), -1, 1e300, math.inf, math.nan])
def test_a_number_that_is_none_is_unknown(number):
    assert hypothesis(number) == "unknown"
