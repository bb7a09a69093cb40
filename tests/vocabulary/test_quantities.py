"""What is shown of a variable agrees with what the recording holds."""

import math

import pytest

from ftc_jsb.recording.columns import VARIABLES
from ftc_jsb.vocabulary.quantities import QUANTITIES

RECORDED = {variable.name: variable.unit for variable in VARIABLES}
FACTORS = {  # recorded unit, shown unit: the one factor between them
    ("m/s", "m/s"): 1.0,
    ("1", ""): 1.0,
    ("rad", "deg"): math.degrees(1.0),
    ("rad/s", "deg/s"): math.degrees(1.0),
    ("N", "kN"): 1e-3,
    ("m", "km"): 1e-3,
}


@pytest.mark.parametrize("name", sorted(QUANTITIES.keys() & RECORDED.keys()))
def test_factor_is_the_one_between_the_recorded_and_the_shown_unit(name):
    quantity = QUANTITIES[name]
    assert quantity.factor == FACTORS[RECORDED[name], quantity.unit]


def test_keys_of_metrics_json_are_different():
    keys = [quantity.key for quantity in QUANTITIES.values() if quantity.key]
    assert len(keys) == len(set(keys))
