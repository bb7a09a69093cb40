"""Lines of the exchange: what is right is read to the bit, all else is refused."""

import math

import pytest
from hypothesis import given
from hypothesis import strategies as st

from ftc_jsb.flightgear.lines import LONGEST, line_of, numbers_of

NUMBERS = st.lists(
    st.floats(min_value=-1e8, max_value=1e8, allow_nan=False), min_size=1, max_size=70
)


@given(NUMBERS)
def test_a_line_is_read_to_the_bit(numbers):
    assert numbers_of(line_of(numbers), len(numbers)) == tuple(numbers)


@given(st.binary(max_size=300))
def test_what_is_no_line_is_refused_without_a_word(data):
    """Whatever bytes come: None, or numbers whose sum happens to be right; never an exception."""
    found = numbers_of(data, 3)
    assert found is None or len(found) == 3


@given(NUMBERS, st.data())
def test_a_digit_that_changed_is_noticed(numbers, data):
    """A digit before the point changes its term of the sum by its place at least; any tolerance is below."""
    line = line_of(numbers).decode()
    places = [k for k, letter in enumerate(line.partition(".")[0]) if letter.isdigit()]
    if "e" in line.partition(",")[0]:
        return
    k = data.draw(st.sampled_from(places))
    other = data.draw(st.sampled_from([d for d in "0123456789" if d != line[k]]))
    assert numbers_of((line[:k] + other + line[k + 1 :]).encode(), len(numbers)) is None


@pytest.mark.parametrize(
    "line",
    [b"", b"\n", b"1,2", b"1,2,3,14", b"1,2,nan,14", b"1,2,inf,inf", b"1,2,x,14", b"1 2 3 14",
     b"2,1,3,14", b"1,2,3,14,0", b"\xff,2,3,14", b"1,2,3,1" + b"4" * LONGEST],
)  # fmt: skip
def test_lines_of_three_numbers(line):
    """1, 2, 3 with the check 14 alone is right."""
    right = line == b"1,2,3,14"
    assert numbers_of(line, 3) == ((1.0, 2.0, 3.0) if right else None)


def test_what_is_not_finite_is_not_sent():
    with pytest.raises(ValueError, match="finite"):
        line_of([1.0, math.nan])
