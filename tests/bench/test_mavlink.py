"""The measurement measures: every number is there and of its kind. How large they are is no test."""

import math

from ftc_jsb.bench.mavlink import measure_mavlink


def test_cost_of_a_short_flight_is_measured():
    cost = measure_mavlink("paper", 1.0)
    assert all(math.isfinite(value) for value in cost)
    assert cost.samples == 101
    assert 0.0 < cost.core_share < 1.0
    assert cost.messages_per_s > 50.0
    assert cost.pacing_error_median_ms <= cost.pacing_error_p99_ms <= cost.pacing_error_max_ms
