"""The outer loop flies what another program flies: good lines and bad, and time that is not even."""

import json
import math
import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest

from ftc_jsb.analysis.metrics import flight_metrics
from ftc_jsb.errors import LinkError, ScenarioError
from ftc_jsb.flightgear.exchange import Exchange
from ftc_jsb.flightgear.flight import OutsideFlight
from ftc_jsb.flightgear.outside_aircraft import LineFields, started_where_it_is
from ftc_jsb.recording.netcdf import load
from ftc_jsb.scenario.load import load_scenario
from ftc_jsb.vocabulary.hypotheses import HYPOTHESES
from tests.cli.command import assert_refused, run
from tests.flightgear.simulated import SimulatedLink, drawn

EXAMPLE = Path(__file__).parents[2] / "docs" / "examples" / "simulator.py"


def begin(link, *overrides):
    """A flight over a link, and what it said."""
    scenario = load_scenario("paper", ['model="flightgear"', *overrides])
    exchange = Exchange(link, LineFields(scenario.aircraft))
    origin = exchange.wait_in_the_air(10.0)
    said = []
    flown = started_where_it_is(scenario, exchange.fields, origin)
    return OutsideFlight(flown, exchange, origin, said.append), exchange, said


def estimate_error(flight):
    """Largest error of the estimate, from 3 s after each change of the truth on."""
    time, truth = flight.record["time"], flight.record["effectiveness_thrust"]
    error = np.abs(flight.record["effectiveness_thrust_est"] - truth)
    for changed in time[1:][np.abs(np.diff(truth)) > 0.01]:
        error[(time >= changed) & (time < changed + 3.0)] = 0.0
    return float(np.nanmax(error))


def frames_at(low, high, seed=3):
    """Frames of pictures, drawn: 20 to 60 Hz and worse."""
    drawn_frames = np.random.default_rng(seed).integers(low, high + 1, 100_000)
    return lambda picture: int(drawn_frames[picture])


def test_the_paper_at_uneven_frames(exported):
    """20 to 60 pictures a second, drawn: the figures that are asked of FlightGear, with its delay."""
    flight, exchange, said = begin(SimulatedLink(exported, frames_at(2, 6)))
    flown = flight.fly()
    metrics = flight_metrics(flown)
    assert flown.outcome.status == "complete"
    assert metrics["verdict"] == "inside limits"
    assert metrics["rmse_airspeed_mps"] < 0.5
    assert metrics["rmse_flight_path_deg"] < 0.15
    assert metrics["rmse_heading_deg"] < 0.4
    assert estimate_error(flown) < 0.05
    assert said == ["the outer loop flies"]
    assert exchange.counts.malformed == exchange.counts.disordered == 0
    steps = np.diff(flown.record["time"])
    assert steps.min() > 0.0099
    assert steps.max() == pytest.approx(6 / 120)
    assert flight.delays.median == pytest.approx(5 / 120, abs=1 / 120)  # a picture, and a frame


def test_a_bad_line_harms_nothing(exported):
    """A tenth of the lines dropped each way, others doubled, swapped and garbled: counted, and the same
    figures are met that are asked of FlightGear.
    """
    link = SimulatedLink(exported, frames_at(4, 6))
    shares = {"dropped": 0.1, "doubled": 0.05, "swapped": 0.05, "garbled": 0.05}
    link.lines, link.answers = drawn(shares, 1), drawn(shares, 2)
    flight, exchange, _ = begin(link)
    flown = flight.fly()
    metrics = flight_metrics(flown)
    assert flown.outcome.status == "complete"
    assert metrics["rmse_airspeed_mps"] < 0.5
    assert metrics["rmse_flight_path_deg"] < 0.15
    assert metrics["rmse_heading_deg"] < 0.4
    assert estimate_error(flown) < 0.05
    counts = exchange.counts
    assert min(counts.malformed, counts.disordered, counts.repeated) > 20
    assert link.fdm["ftc/received/refused"] > 20


def test_the_dialog_is_told_whom_the_isolation_suspects(exported):
    """Loop `robust`, thrust lost at 5 s: the simulator has the number and the probability of the recording."""
    link = SimulatedLink(exported)
    told = []
    link.before = lambda link: told.append(
        (link.fdm["ftc/received/suspect"], link.fdm["ftc/received/suspect-probability"])
    )
    flight, _, _ = begin(link, "loop.name=robust", "duration=12", "fault[0].start=5")
    record = flight.fly().record
    given = set(zip(record["suspect"], record["suspect_probability"], strict=True))
    assert set(told) - {(0.0, 0.0)} <= given
    thrust = [sure for number, sure in told if HYPOTHESES[int(number)] == "thrust"]
    assert max(thrust) > 0.9
    assert np.all(record["suspect"][record["time"] < 5.0] == 0.0)


@pytest.mark.parametrize("frames", [(4, 6), (5, 10), (8, 16)], ids=str)
def test_robust_flies_the_paper_at_uneven_frames(exported, frames):
    """Loop `robust` at 30 to 8 pictures a second: a brisk roll between two is no instrument's fault."""
    flight, _, _ = begin(SimulatedLink(exported, frames_at(*frames)), "loop.name=robust")
    flown = flight.fly()
    metrics = flight_metrics(flown)
    assert metrics["verdict"] == "inside limits"
    assert metrics["rmse_airspeed_mps"] < 0.5
    assert metrics["rmse_flight_path_deg"] < 0.15
    assert estimate_error(flown) < 0.05
    record = flown.record
    assert np.all(record["suspect"][record["time"] < 20.0] == 0.0)
    assert HYPOTHESES[int(record["suspect"][record["time"] > 21.0][0])] == "thrust"


def test_a_pause_changes_nothing(exported):
    """While the simulator stands still its lines repeat: the samples are at the same times, and what is flown
    differs by a command that is in force a picture sooner after the pause (0.01 m/s seen of airspeed).
    """
    records = []
    for paused in (False, True):
        still = range(100, 250) if paused else range(0)
        link = SimulatedLink(exported, lambda picture, still=still: 0 if picture in still else 5)
        flight, exchange, _ = begin(link, "duration=10")
        records.append(flight.fly().record)
        assert (exchange.counts.repeated > 100) == paused
    assert (records[0]["time"] == records[1]["time"]).all()
    for name, most in (("airspeed", 0.05), ("heading", 0.002), ("effectiveness_thrust_est", 0.002)):
        assert np.abs(records[0][name] - records[1][name]).max() < most


def test_a_stall_hands_over_and_back(exported):
    """No command for 3 s of simulation time in the turn: the inner loop levels the wings, the loop takes
    over again from where it finds the aircraft; said, and no limit of the paper's is broken by more than
    what was missed.
    """
    link = SimulatedLink(exported)
    link.answers = lambda line: [] if 200 <= link.pictures < 275 else [line]
    flight, _, said = begin(link, "duration=40")
    flown = flight.fly()
    record = flown.record
    assert flown.outcome.status == "complete"
    assert said == [
        "the outer loop flies",
        "inner loop alone: wings level, speed held",
        "the outer loop flies",
    ]
    during = (record["time"] > 10.5) & (record["time"] < 11.0)
    assert np.abs(np.degrees(record["bank_angle"][during])).max() < 1.0
    assert estimate_error(flown) < 0.05
    for name in ("airspeed", "flight_path_angle", "heading"):  # references go on from what is flown
        assert np.abs(np.diff(record[f"{name}_ref"])).max() < 0.5
    after = record["time"] > 30.0
    assert np.abs(np.degrees(record["heading"] - record["heading_ref"])[after]).max() < 1.0


def test_a_reset_ends_the_flight(exported):
    link = SimulatedLink(exported)

    def reset(link):
        if link.pictures == 100:
            link.fdm.reset_to_initial_conditions(0)

    link.before = reset
    flight, _, _ = begin(link, "duration=10")
    flown = flight.fly()
    assert (flown.outcome.status, flown.outcome.reason) == ("ended", "the simulator was reset")
    assert 3.0 < flown.outcome.time < 4.5


def test_the_pilot_flies_by_references(exported):
    """Stick to the left for 2 s from 3 s on: the aircraft banks as asked, without a jump; given back at
    8 s, it is on the scenario's heading again at the end.
    """
    link = SimulatedLink(exported)

    def pilot(link):
        time = link.fdm.get_sim_time()
        link.fdm["ftc/pilot/wanted"] = float(3.0 < time < 8.0)
        link.fdm["ftc/pilot/roll"] = -0.5 if 3.0 < time < 5.0 else 0.0

    link.before = pilot
    level = ["reference.heading_deg=[[0,0]]", "reference.flight_path_deg=[[0,0]]", "fault=[]"]
    flight, _, said = begin(link, "duration=40", *level)
    record = flight.fly().record
    banked = (record["time"] > 6.0) & (record["time"] < 7.0)
    assert np.degrees(record["bank_angle"][banked]).mean() == pytest.approx(-30.0, abs=3.0)
    assert said == [
        "the outer loop flies",
        "the pilot moves the references",
        "references of the scenario again",
    ]
    assert math.degrees(record["heading"][-1]) == pytest.approx(0.0, abs=0.2)
    assert np.abs(record["airspeed"] - 300.0).max() < 1.0


def test_the_example_client(exported, tmp_path):
    """docs/examples/simulator.py flies, `ftc-jsb plugin --attach` flies it: thrust lost at 5 s is found."""
    simulator = subprocess.Popen(
        [sys.executable, str(EXAMPLE), str(exported), "127.0.0.1:5711", "5712", "60"],
        stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL,
    )  # fmt: skip
    try:
        result = run(
            "plugin", "paper", "--attach", "127.0.0.1:5712", "--listen", "5711", "--out", "o",
            "--mavlink", "udpout:127.0.0.1:14599", "--tlog", "t.tlog",
            "--set", "duration=12", "--set", "fault[0].start=5", cwd=tmp_path,
        )  # fmt: skip
    finally:
        simulator.terminate()
        simulator.wait()
    assert result.returncode == 0, result.stderr
    assert "the outer loop flies" in result.stderr
    assert b"the outer loop flies" in (tmp_path / "t.tlog").read_bytes()  # a STATUSTEXT
    flight = load(tmp_path / "o" / "flight.nc")
    assert flight.label == "flightgear-ftc"
    assert flight.outcome.status == "complete"
    assert estimate_error(flight) < 0.05
    assert flight.scenario.initial.latitude_deg == pytest.approx(47.0, abs=0.1)
    beside = run(
        "compare", "paper", "--set", "duration=12", "--set", 'compare.models=["paper"]', "--out", "c",
        "--beside", "o/flight.nc", cwd=tmp_path,
    )  # fmt: skip
    assert beside.returncode == 0, beside.stderr
    numbers = json.loads((tmp_path / "c" / "metrics.json").read_text(encoding="utf-8"))["flights"]
    assert {"paper-ftc", "flightgear-ftc"} <= set(numbers)
    assert "flightgear" in (tmp_path / "c" / "report.html").read_text(encoding="utf-8")
    assert len(EXAMPLE.read_text(encoding="utf-8").splitlines()) <= 60


def test_what_the_simulator_decides_is_refused(exported):
    fault = "fault=[{target='airspeed', kind='bias', size=3, start=1}]"
    for override in ("wind.turbulence='light'", "sensors.profile='tactical'", fault):
        with pytest.raises(ScenarioError, match=r"^(wind|sensors|fault)\b"):
            begin(SimulatedLink(exported), override)


def test_nobody_there():
    class Silence(SimulatedLink):
        def __init__(self):
            pass

        def receive(self, timeout):
            return []

    scenario = load_scenario("paper", ['model="flightgear"'])
    with pytest.raises(LinkError, match="no line came to port 0"):
        Exchange(Silence(), LineFields(scenario.aircraft)).wait_in_the_air(0.01)


def test_options_that_do_not_go_together(tmp_path):
    assert_refused(run("plugin", "paper", cwd=tmp_path), "--flightgear", "--attach HOST:PORT")
    assert_refused(
        run("plugin", "paper", "--attach", "here", cwd=tmp_path), "--attach 'here'", "HOST:PORT"
    )
    assert_refused(
        run("plugin", "paper", "--flightgear", "--fgfs", "no-such-program", cwd=tmp_path),
        "--fgfs no-such-program",
    )
    assert_refused(
        run("fly", "paper", "--set", 'model="flightgear"', cwd=tmp_path), "ftc-jsb plugin"
    )
