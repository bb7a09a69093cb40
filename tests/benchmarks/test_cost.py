"""What `ftc-jsb bench` measures, by pytest-benchmark: `make bench`.

In the test suite each runs once, to see that it works; nothing passes or fails on a time.
"""

import numpy as np
import pytest

from ftc_jsb.bench.numpy_form import fly_in_numpy
from ftc_jsb.bench.point_mass import dispersed
from ftc_jsb.bench.six_dof import BareLoop, six_dof_scenario
from ftc_jsb.bench.summary import FIGURES, lines, measure_mavlink_share, met_or_missed
from ftc_jsb.scenario.load import load_scenario
from ftc_jsb.simulation.assembly import point_mass_of
from ftc_jsb.simulation.batch import fly_batch
from ftc_jsb.simulation.fly import fly


def test_a_minute_of_point_mass_flight(benchmark):
    scenario = load_scenario("paper")
    assert benchmark(fly, scenario).outcome.status == "complete"


def test_a_second_of_jsbsim_flight(benchmark):
    scenario = six_dof_scenario(1.0)
    assert benchmark(fly, scenario).outcome.status == "complete"


def test_dispersed_flights_in_one_call(benchmark):
    result = benchmark(fly_batch, dispersed(3))
    assert np.all(result["reason"] == 0)
    assert len(set(result["rmse_airspeed"])) == 3  # they are not the same flight


def test_the_numpy_form_flies_the_same_flight(benchmark):
    """What the compiled loop is compared with must be the same loop: 1e-9 through the fault."""
    scenario = load_scenario("paper", ["loop.priority='none'", "fault[0].start=1.0"])
    record = fly(scenario).record
    model = point_mass_of(scenario).record(0.0)[0]
    trim = float(record["trim_input_thrust"][0])
    flown = benchmark(fly_in_numpy, scenario, model, trim, 300)
    names = ("airspeed", "flight_path_angle", "heading", "altitude", "effectiveness_thrust_est")
    for column, name in enumerate(names):
        np.testing.assert_allclose(flown[:, column], record[name][:300], rtol=1e-9, atol=1e-9)


def test_bare_loop_takes_turns_with_the_flight_and_leaves_it_alone(flown):
    scenario = load_scenario("paper", ["model='jsbsim'"]).model_copy(update={"duration": 3.0})
    bare = BareLoop(scenario)
    record = fly(scenario, (bare,)).record
    assert len(bare.flown) == len(bare.bare) == 7
    whole = flown("paper", "model='jsbsim'").record
    np.testing.assert_array_equal(record["airspeed"], whole["airspeed"][: record.size])


def test_what_is_not_installed_is_said_and_not_judged():
    found = dict.fromkeys((figure.key for figure in FIGURES), 1.0) | measure_mavlink_share()
    found["ukf_vs_filterpy"] = None
    text = "\n".join(lines(found))
    assert "FilterPy's UKF step / ours" in text
    assert "not installed" in text
    assert len(text.splitlines()) == len(FIGURES)


@pytest.mark.parametrize(
    ("value", "most", "least", "said"),
    [(1.4, 1.5, None, "met"), (1.6, 1.5, None, "missed"), (99.0, None, 100.0, "missed"),
     (None, 1.5, None, ""), (3.0, None, None, "")],
)  # fmt: skip
def test_met_or_missed(value, most, least, said):
    assert met_or_missed(value, most, least) == said
