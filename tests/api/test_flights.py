"""Flights from Python: the same as from the command line, as numbers, tables, figures, files and reports."""

import numpy as np
import pytest

import ftc_jsb as ftc
from tests.api import own_loop

SHORT = {"duration": 12.0, "fault[0].start": 6.0}


@pytest.fixture(scope="module")
def flight():
    return ftc.fly("paper", set={**SHORT, "fault[0].effectiveness": np.float64(0.5)})


def test_a_flight_is_what_was_asked_for(flight):
    assert flight.scenario["fault[0].effectiveness"] == 0.5
    assert flight.record["effectiveness_thrust"][-1] == 0.5
    assert flight.metrics["verdict"] == flight.verdict == "inside limits"
    assert flight.passed


def test_it_shows_itself_in_a_line_and_in_a_table(flight):
    assert repr(flight) == "<Flight 'paper' paper-ftc: 12 s, inside limits>"
    html = flight._repr_html_()
    assert "<table" in html
    assert "inside limits" in html


def test_tables_hold_the_recording(flight):
    frame, dataset = flight.to_pandas(), flight.to_xarray()
    assert np.array_equal(frame["airspeed"], flight.record["airspeed"])
    assert frame.attrs["units"]["airspeed"] == dataset["airspeed"].attrs["units"] == "m/s"
    assert frame.index.name == "time"


def test_it_is_read_back_as_it_was_saved(flight, tmp_path):
    path = flight.save(tmp_path / "flight.nc")
    again = ftc.load(path)
    assert again.record.tobytes() == flight.record.tobytes()
    assert again.scenario == flight.scenario
    with pytest.raises(ftc.UserError, match="exists"):
        flight.save(path)


@pytest.mark.parametrize("what", ["states", "controls", "errors", "trajectory", "effectiveness"])
def test_it_is_drawn(flight, what):
    import matplotlib.pyplot as plt

    before = plt.get_fignums()
    assert flight.plot(what).axes
    assert plt.get_fignums() == before  # a notebook would show it twice


def test_what_is_no_figure_is_refused(flight):
    with pytest.raises(ValueError, match="expected one of states"):
        flight.plot("lift")


def test_its_report_is_written_once(flight, tmp_path):
    page = flight.report(tmp_path / "report")
    assert "paper-ftc" in page.read_text(encoding="utf-8")
    with pytest.raises(ftc.UserError, match="not empty"):
        flight.report(tmp_path / "report")


def test_a_class_is_a_loop():
    flown = ftc.fly("paper", loop=own_loop.Hold, set={"duration": 1.0})
    assert np.all(flown.record["load_factor_cmd"] == 1.0)
    assert flown.scenario.loop.name == "tests.api.own_loop:Hold"


def test_a_class_that_a_recording_cannot_name_is_refused():
    class Local(own_loop.Hold):
        pass

    with pytest.raises(ftc.UserError, match="top of a module"):
        ftc.fly("paper", loop=Local)


@pytest.mark.parametrize(
    ("values", "says"),
    [
        ({"fault[0].effectiveness": 2.0}, "fault\\[0\\].effectiveness"),
        ({"wings": 2}, "unknown key 'wings'"),
        ({"model": "glider"}, "model"),
    ],
)
def test_what_cannot_be_flown_is_said_in_words_of_python(values, says):
    with pytest.raises(ftc.UserError, match=says) as refused:
        ftc.fly("paper", set=values)
    assert "--set" not in str(refused.value)


def test_a_scenario_is_edited_by_making_another(tmp_path):
    paper = ftc.scenario("paper")
    edited = paper.edit({"fault[0].effectiveness": 0.3, "reference.airspeed": [[0, 250], [9, 260]]})
    assert paper.fault[0].effectiveness == 0.6
    assert edited.reference.airspeed == ((0.0, 250.0), (9.0, 260.0))
    edited.to_toml(tmp_path / "mine.toml")
    assert ftc.scenario(tmp_path / "mine.toml") == edited
    with pytest.raises(KeyError):
        edited["fault[4].start"]


def test_a_comparison_says_whether_ftc_helped():
    flown = ftc.compare("paper", models=["paper"], set=SHORT, progress=False)
    assert list(flown) == ["paper-ftc", "paper-no-ftc"]
    assert flown.ftc_helped[0]["answer"] == "helped"
    assert flown.to_pandas().loc["paper-ftc", "verdict"] == "inside limits"
    assert "paper-no-ftc" in flown._repr_html_()


def test_a_sweep_is_a_table_whose_rows_fly_again():
    values = {"fault[0].effectiveness": [0.5, 0.8]}
    swept = ftc.sweep("paper", values, loops=["ftc", "no-ftc"], set=SHORT, progress=False)
    table = swept.to_pandas()
    assert list(table["fault[0].effectiveness"]) == [0.5, 0.5, 0.8, 0.8]
    assert list(table["loop"]) == ["ftc", "no-ftc"] * 2
    again = swept.flight(1).metrics
    assert table["rmse_airspeed_mps"][1] == again["rmse_airspeed_mps"]
