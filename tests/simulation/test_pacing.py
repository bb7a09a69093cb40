"""Real time never changes a flight."""

import time

import numpy as np
import pytest

from ftc_jsb.recording.columns import ROW
from ftc_jsb.scenario.load import load_scenario
from ftc_jsb.simulation.command_source import CommandQueue
from ftc_jsb.simulation.fly import fly
from ftc_jsb.simulation.pacing import Pacer


@pytest.mark.parametrize("model", ["paper", "jsbsim"])
def test_flat_out_at_one_and_at_five_times_is_bit_identical(model):
    """Two seconds of the paper's flight with its fault in them; and no faster than real time."""
    scenario = load_scenario("paper", [f"model={model}", "duration=2", "fault[0].start=1"])
    flat_out = fly(scenario).record
    for factor in (1.0, 5.0):
        pacer = Pacer(scenario.loop.rate, factor)
        started = time.perf_counter()
        paced = fly(scenario, observers=[pacer], commands=CommandQueue()).record
        assert time.perf_counter() - started >= 2.0 / factor
        assert pacer.error().samples == paced.size
        for name in ROW.names:
            np.testing.assert_array_equal(paced[name], flat_out[name], err_msg=name)


def test_deadlines_are_absolute_and_overruns_are_counted():
    """One sample that takes 50 ms: the next ones catch up, and the flight ends when it should."""

    def slow(record, i):
        if i == 20:
            time.sleep(0.05)

    scenario = load_scenario("nominal", ["duration=1"])
    pacer = Pacer(scenario.loop.rate, 1.0)
    fly(scenario, observers=[slow, pacer])
    error = pacer.error()
    assert error.overruns >= 3  # 50 ms are five samples; the first of them has 10 ms to spare
    assert error.largest >= 0.03


def test_after_a_suspension_time_starts_anew(monkeypatch):
    """50 ms late where 20 ms is too much to be made up for: the flight ends that much later."""
    monkeypatch.setattr("ftc_jsb.simulation.pacing.GIVE_UP", 0.02)

    def slow(record, i):
        if i == 20:
            time.sleep(0.05)

    scenario = load_scenario("nominal", ["duration=0.5"])
    started = time.perf_counter()
    fly(scenario, observers=[slow, Pacer(scenario.loop.rate, 1.0)])
    assert time.perf_counter() - started >= 0.5 + 0.03
