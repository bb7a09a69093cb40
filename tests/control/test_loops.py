"""The registry, the built-in loops against each other, and loops of a user's own."""

from pathlib import Path

import numpy as np
import pytest
from scipy.signal import cont2discrete

from ftc_jsb.analysis.metrics import flight_metrics
from ftc_jsb.errors import LoopError
from ftc_jsb.loops.registry import loop_names
from ftc_jsb.scenario.load import load_scenario
from ftc_jsb.simulation.fly import fly

HERE = "tests.control.my_loop"


def rmse_airspeed(flight):
    return flight_metrics(flight)["rmse_airspeed_mps"]


def test_knowing_more_tracks_better(flown):
    """Truth better than estimate, estimate better than integral action, that better than nothing."""
    rmse = [
        rmse_airspeed(flown("paper", f"loop.name={loop}"))
        for loop in ("oracle", "ftc", "integral", "no-ftc")
    ]
    assert rmse == sorted(rmse)


def test_ekf_and_ukf_agree_where_the_model_is_nearly_linear_over_a_sample(flown):
    """At 100 Hz both estimates differ by less than 1e-6, far below either one's error."""
    ukf, ekf = flown("paper").record, flown("paper", "loop.name=ekf").record
    np.testing.assert_allclose(
        ekf["effectiveness_thrust_est"], ukf["effectiveness_thrust_est"], atol=1e-6
    )


def test_integral_loop_estimates_nothing_and_removes_the_offset(flown):
    """No effectiveness in the recording, and the airspeed error at 60 s is below 0.1 m/s."""
    record = flown("paper", "loop.name=integral").record
    assert np.isnan(record["effectiveness_thrust_est"]).all()
    assert abs(record["airspeed"][-1] - 300.0) < 0.1


def test_sign_of_the_error_feedback_is_the_stabilising_one(flown):
    """From an offset of 5 m/s the error decays as exp(-K t), (18), and does not grow as (17) reads."""
    offset = ("fault=[]", "duration=4", "reference.airspeed=[[0, 305], [0.01, 305]]")
    record = flown("nominal", *offset, "reference.heading_deg=[[0, 0]]").record
    error = record["airspeed"] - 305.0
    np.testing.assert_allclose(error[::50], -5.0 * np.exp(-record["time"][::50]), atol=0.05)


@pytest.mark.parametrize("model", ["paper", "jsbsim"])
def test_own_loop_flies(model):
    """The template of docs/loops.md keeps the healthy manoeuvre within 10 m/s and 3 deg."""
    flight = fly(load_scenario("nominal", [f"loop.name='{HERE}:MyLoop'", f"model={model}"]))
    metrics = flight_metrics(flight)
    assert metrics["status"] == "complete"
    assert metrics["peak_error_airspeed_mps"] < 10.0
    assert metrics["peak_error_heading_deg"] < 3.0
    assert metrics["effectiveness_thrust_error_rms"] is None


@pytest.mark.parametrize(
    ("name", "says"),
    [
        ("ftv", "expected one of ftc, no-ftc, law, law-no-ftc, oracle"),
        ("no.such.module:Loop", "cannot import 'no.such.module'"),
        (f"{HERE}:NoLoop", "has no 'NoLoop'"),
        (":Loop", "expected one of ftc"),
        ("tests.control.not_python:Loop", "SyntaxError"),
        ("math:sqrt", "cannot be built"),
    ],
)
def test_loop_that_is_none_is_refused(name, says):
    with pytest.raises(LoopError) as refusal:
        fly(load_scenario("nominal", [f"loop.name='{name}'"]))
    assert says in str(refusal.value)


@pytest.mark.parametrize(
    ("name", "says"),
    [
        ("BrokenLoop", "step at 0.51 s: ZeroDivisionError: division by zero"),
        ("WrongLoop", "expected a Command"),
        ("TextLoop", "thrust is 'lots', expected a finite number"),
        ("NanLoop", "bank_angle is nan, expected a finite number"),
        ("WrongEstimateLoop", "estimates['airspeed']: expected one of"),
    ],
)
def test_loop_that_fails_in_flight_keeps_what_was_flown(name, says):
    flight = fly(load_scenario("nominal", [f"loop.name='{HERE}:{name}'"]))
    assert flight.outcome.status == "failed"
    assert says in flight.outcome.reason
    assert flight.record["time"][-1] == pytest.approx(flight.outcome.time)


def test_template_of_the_docs_is_the_loop_that_is_tested():
    docs = (Path(__file__).parents[2] / "docs" / "loops.md").read_text()
    template = docs.split("```python")[1].split("```")[0]
    source = (Path(__file__).parent / "my_loop.py").read_text()
    assert template.split("class MyLoop:")[1].strip() in source


def test_installed_package_names_its_loop_by_entry_point(tmp_path, monkeypatch):
    """A distribution on the path with an entry point in `ftc_jsb.loops`: listed and flown by its name."""
    source = (Path(__file__).parent / "my_loop.py").read_text()
    (tmp_path / "their_package.py").write_text(source)
    metadata = tmp_path / "their_package-1.0.dist-info"
    metadata.mkdir()
    (metadata / "METADATA").write_text("Metadata-Version: 2.1\nName: their-package\nVersion: 1.0\n")
    (metadata / "entry_points.txt").write_text("[ftc_jsb.loops]\ntheirs = their_package:MyLoop\n")
    monkeypatch.syspath_prepend(tmp_path)
    assert "theirs" in loop_names()
    flight = fly(load_scenario("nominal", ["loop.name=theirs", "duration=2"]))
    assert flight.outcome.status == "complete"


def test_trim_filter_is_the_sampled_filter_10(flown):
    """u_n of the recording against SciPy's zero-order hold of zeta / (s + zeta), driven by the limited u."""
    record = flown("paper").record
    system = [np.array([[value]]) for value in (-50.0, 50.0, 1.0, 0.0)]
    a, b = (float(matrix[0, 0]) for matrix in cont2discrete(system, 0.01, method="zoh")[:2])
    for trim, demand in (
        ("trim_input_thrust", "thrust_cmd"),
        ("trim_input_load_factor", "load_factor_demand"),
        ("trim_input_bank_angle", "bank_angle_demand"),
    ):
        expected = a * record[trim][:-2] + b * record[demand][:-2]
        scale = np.abs(record[trim][:-1]).max()
        np.testing.assert_allclose(record[trim][1:-1], expected, rtol=0.0, atol=1e-12 * scale)
