"""The sampled command filter against the continuous one."""

import numpy as np
import pytest
from scipy.linalg import expm
from scipy.signal import lsim

from ftc_jsb.control.command_filter import _exponential, command_filter, reference_step
from ftc_jsb.scenario.load import load_scenario
from ftc_jsb.simulation.assembly import blank_recording


def filtered(scenario):
    record = blank_recording(scenario)
    s = scenario.reference
    names = ("airspeed_cmd_raw", "flight_path_angle_cmd_raw", "heading_cmd_raw")
    first = [record[0][name] for name in names]
    filters = command_filter(s.filter_frequency, s.filter_damping, 1.0 / scenario.loop.rate, first)
    for i in range(record.size):
        reference_step(filters, record, i)
    return record


@pytest.mark.parametrize("damping", [0.5, 1.0, 2.0])
def test_references_are_the_continuous_filter_sampled(damping):
    """SciPy's simulation of F and of s F, which is exact for inputs linear between samples; 1e-10."""
    record = filtered(load_scenario("paper", [f"reference.filter_damping={damping}"]))
    w = 3.0
    both = ([[w**2, 0.0], [0.0, w**2]], [1.0, 2.0 * damping * w, w**2])
    for numerator, suffix in (([w**2], "ref"), ([w**2, 0.0], "ref_rate")):
        for name in ("heading", "flight_path_angle"):
            _, expected, _ = lsim((numerator, both[1]), record[f"{name}_cmd_raw"], record["time"])
            np.testing.assert_allclose(record[f"{name}_{suffix}"], expected, atol=1e-10)


def test_filter_starts_at_rest_on_the_first_command():
    record = filtered(load_scenario("paper"))
    np.testing.assert_allclose(record["airspeed_ref"], 300.0, rtol=1e-14)
    np.testing.assert_allclose(record["airspeed_ref_rate"], 0.0, atol=1e-10)


@pytest.mark.parametrize("damping", [0.1, 1.0, 5.0])
@pytest.mark.parametrize("dt", [1e-3, 0.1, 1.0])
def test_matrix_exponential_is_scipys(damping, dt):
    """The filter's matrices at the corners of what a scenario allows: 1e-10 of the largest element."""
    for frequency in (0.05, 3.0, 50.0):
        a = np.array([[0.0, 1.0], [-(frequency**2), -2.0 * damping * frequency]]) * dt
        expected = expm(a)
        np.testing.assert_allclose(
            _exponential(a), expected, rtol=0.0, atol=1e-10 * np.abs(expected).max()
        )
