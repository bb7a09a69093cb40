"""The raw commands of `paper.toml` are (44)."""

import numpy as np

from ftc_jsb.scenario.load import load_scenario
from ftc_jsb.scenario.reference import raw_commands


def test_breakpoints_are_equation_44():
    """Every piece of (44), evaluated as printed at 0.01 s steps, to rounding (1e-12 deg)."""
    t = np.arange(0.0, 60.001, 0.01)
    heading = np.select(
        [t < 5, t <= 10, t <= 20, t <= 30, t <= 40, t <= 45],
        [0 * t, 6 * (t - 5), 30 + 0 * t, 30 * (5 - 0.2 * t), -30 + 0 * t, -30 * (9 - 0.2 * t)],
        0.0,
    )
    path = np.select(
        [t <= 15, t <= 25, t <= 35, t <= 45],
        [0 * t, 0.5 * (t - 15), 5 + 0 * t, 0.5 * (45 - t)],
        0.0,
    )
    commands = raw_commands(load_scenario("paper").reference, t)
    np.testing.assert_allclose(commands[:, 0], 300.0)
    np.testing.assert_allclose(np.degrees(commands[:, 1]), path, atol=1e-12)
    np.testing.assert_allclose(np.degrees(commands[:, 2]), heading, atol=1e-12)
