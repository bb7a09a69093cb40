"""A key that no flight reads is said, one that any reads is not."""

import pytest

from ftc_jsb.runs.unused_keys import unused_keys
from ftc_jsb.scenario.loop import Loop

FTC, INTEGRAL, ROBUST, LAW = (Loop(name=name) for name in ("ftc", "integral", "robust", "law"))


@pytest.mark.parametrize(
    ("key", "models", "loop"),
    [
        ("aircraft.name=f15", ["paper"], FTC),
        ("aircraft.flight_control=stock", ["identified"], FTC),
        ("simulation.jsbsim_steps=3", ["paper", "identified"], FTC),
        ("sensors.inner_loop=true", ["paper"], FTC),
        ("loop.integral_gains=[1,1,1]", ["paper"], FTC),
        ("loop.estimator.spread=2", ["paper"], INTEGRAL),
        ("loop.estimator.measurement_noise=[1,1,1]", ["paper"], ROBUST),
        ("loop.priority=none", ["jsbsim"], LAW),
        ("loop.response_lead=true", ["jsbsim"], ROBUST),
        ("loop.estimator.measurement_noise=[1,1,1]", ["paper"], INTEGRAL),
    ],
)
def test_unread_key_is_said_by_name(key, models, loop):
    (sentence,) = unused_keys([key], models, [loop])
    assert key.partition("=")[0] in sentence


@pytest.mark.parametrize(
    ("key", "models", "loops"),
    [
        ("aircraft.name=f15", ["paper", "jsbsim"], [FTC]),
        ("loop.integral_gains[0]=1", ["paper"], [FTC, INTEGRAL]),
        ("loop.gains=[1,1,1]", ["paper"], [FTC]),
        ("loop.integral_gains=[1,1,1]", ["paper"], [Loop(name="mine:Loop")]),
        ("seed=3", ["paper"], [FTC]),
    ],
)
def test_read_key_is_not(key, models, loops):
    assert unused_keys([key], models, loops) == []
