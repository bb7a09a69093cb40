"""Loss of effectiveness over time: each shape, recovery, several at once."""

import numpy as np
from hypothesis import given
from hypothesis import strategies as st

from ftc_jsb.analysis.fault_steps import fault_steps
from ftc_jsb.disturbance.faults import fault_records, schedule
from ftc_jsb.recording.columns import ROW
from ftc_jsb.scenario.faults import Fault
from ftc_jsb.scenario.load import load_scenario
from ftc_jsb.scenario.schema import Scenario

TIME = np.arange(6001) / 100.0


def scheduled(*faults: Fault, engines: int = 1) -> np.ndarray:
    record = np.zeros(TIME.size, ROW)
    record["time"] = TIME
    schedule(fault_records(faults), engines, record)
    return record


def thrust(*faults: Fault) -> np.ndarray:
    return scheduled(*faults)["effectiveness_thrust"]


def scenario(*faults: Fault) -> Scenario:
    return load_scenario("nominal").model_copy(update={"fault": faults})


def test_steps_beside_a_steep_ramp_are_told_from_it():
    """A ramp of 0.4 s moves 0.01 a sample and is no step at 100 Hz, nor at 200; one of 0.02 is."""
    ramp = Fault(effectiveness=0.6, start=10.0, shape="ramp", rise=0.4)
    small = Fault(effectiveness=0.98, start=30.0)
    steps = fault_steps(thrust(ramp, small), scenario(ramp, small))
    assert list(steps) == [3000]


def test_step_acts_from_its_sample_on_and_recovers_at_its_end():
    k = thrust(Fault(effectiveness=0.6, start=20.0, end=40.0))
    assert set(np.unique(k)) == {0.6, 1.0}
    assert k[1999] == 1.0
    assert k[2000] == 0.6
    assert k[3999] == 0.6
    assert k[4000] == 1.0
    assert list(fault_steps(k, scenario())) == [2000, 4000]


def test_step_between_samples_acts_from_the_next_sample():
    k = thrust(Fault(effectiveness=0.6, start=20.004))
    assert k[2000] == 1.0
    assert k[2001] == 0.6


def test_ramp_is_linear_and_has_no_step():
    ramp = Fault(effectiveness=0.5, start=15.0, shape="ramp", rise=10.0)
    k = thrust(ramp)
    np.testing.assert_allclose(k[1500:2501], np.linspace(1.0, 0.5, 1001), atol=1e-9)
    assert np.all(k[2500:] == 0.5)
    assert fault_steps(k, scenario(ramp)).size == 0


def test_intermittent_is_faulty_for_its_duty():
    k = thrust(Fault(effectiveness=0.6, start=10.0, shape="intermittent", period=10.0, duty=0.5))
    seconds = np.floor(TIME)
    expected = np.where((TIME >= 10.0) & (seconds % 10 < 5), 0.6, 1.0)
    np.testing.assert_array_equal(k, expected)


def test_faults_of_one_channel_multiply_and_others_stay_healthy():
    record = scheduled(
        Fault(effectiveness=0.8, start=10.0),
        Fault(effectiveness=0.5, start=20.0),
        Fault(target="bank_angle", effectiveness=0.7, start=0.0),
    )
    assert record["effectiveness_thrust"][2500] == 0.4
    assert np.all(record["effectiveness_load_factor"] == 1.0)
    assert np.all(record["effectiveness_bank_angle"] == 0.7)


@given(
    effectiveness_=st.floats(0.0, 1.0),
    start=st.floats(0.0, 70.0),
    shape=st.sampled_from(["step", "ramp", "intermittent"]),
)
def test_effectiveness_stays_between_its_value_and_one(effectiveness_, start, shape):
    extra = {"step": {}, "ramp": {"rise": 3.0}, "intermittent": {"period": 2.0, "duty": 0.3}}[shape]
    k = thrust(Fault(effectiveness=effectiveness_, start=start, shape=shape, **extra))
    assert np.all(k[start - TIME > 1e-6] == 1.0)
    assert np.all((k >= effectiveness_ - 1e-12) & (k <= 1.0))
