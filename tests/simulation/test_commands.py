"""Commands in flight: what each does, that a recording flies the same again, and what is refused."""

import threading
from unittest import mock

import numpy as np
import pytest
from pydantic import ValidationError

from ftc_jsb.analysis.metrics import flight_metrics
from ftc_jsb.analysis.verdict import passed
from ftc_jsb.errors import RecordingError, ScenarioError
from ftc_jsb.recording import commands as c
from ftc_jsb.recording.columns import ROW
from ftc_jsb.recording.dataset import to_dataset
from ftc_jsb.recording.netcdf import load, save
from ftc_jsb.scenario.faults import Fault
from ftc_jsb.scenario.load import load_scenario
from ftc_jsb.scenario.loop import Loop
from ftc_jsb.simulation import rows_ahead
from ftc_jsb.simulation.command_source import CommandQueue, RecordedCommands
from ftc_jsb.simulation.fly import fly
from ftc_jsb.simulation.replay import differences, replay
from ftc_jsb.simulation.steering import changed_loop

FAULT = Fault(effectiveness=0.7, start=0.0)
DEGREE = np.pi / 180.0


def flown_with(*applied, scenario="nominal", overrides=()):
    """A flight with commands given before rows."""
    source = RecordedCommands([c.Applied(row, command) for row, command in applied])
    return fly(load_scenario(scenario, overrides), commands=source)


def level(duration, *overrides):
    quiet = ("reference.heading_deg=[[0,0]]", "reference.flight_path_deg=[[0,0]]")
    return [f"duration={duration}", *quiet, *overrides]


def assert_same(one, other):
    assert one.record.size == other.record.size
    for name in ROW.names:
        np.testing.assert_array_equal(one.record[name], other.record[name], err_msg=name)


@pytest.mark.parametrize("model", ["paper", "jsbsim"])
def test_set_points_are_flown(model):
    """310 m/s, 2 deg and 40 deg, each at its rate: within 0.2 m/s and 0.1 deg 10 s later."""
    flight = flown_with(
        (100, c.SetAirspeed(value=310.0, rate=2.0)),
        (100, c.SetFlightPath(value=2.0 * DEGREE, rate=1.0 * DEGREE)),
        (100, c.SetHeading(value=40.0 * DEGREE, rate=4.0 * DEGREE)),
        overrides=level(25, f"model={model}"),
    )
    last = flight.record[-1]
    assert last["airspeed"] == pytest.approx(310.0, abs=0.2)
    assert np.degrees(last["flight_path_angle"]) == pytest.approx(2.0, abs=0.1)
    assert np.degrees(last["heading"]) == pytest.approx(40.0, abs=0.1)
    rate = np.diff(flight.record["heading_cmd_raw"]) * 100.0
    assert rate.max() == pytest.approx(4.0 * DEGREE)


def test_heading_turns_the_shorter_way():
    flight = flown_with((10, c.SetHeading(value=350.0 * DEGREE, rate=0.1)), overrides=level(20))
    assert np.degrees(flight.record["heading"][-1]) == pytest.approx(-10.0, abs=0.01)


@pytest.mark.parametrize("height", [5.0, 200.0, -400.0])
@pytest.mark.parametrize("model", ["paper", "jsbsim"])
def test_altitude_is_reached_and_held(height, model):
    """Closed on the measured altitude: within 0.3 m, and never steeper than asked for by more than 0.3 deg."""
    flight = flown_with(
        (100, c.SetAltitude(value=3048.0 + height, flight_path=4.0 * DEGREE, rate=1.0 * DEGREE)),
        overrides=level(45, f"model={model}"),
    )
    late = flight.record[flight.record["time"] > 42.0]
    assert late["altitude"] == pytest.approx(np.full(late.size, 3048.0 + height), abs=0.3)
    assert np.degrees(np.abs(flight.record["flight_path_angle"])).max() < 4.3


def test_altitude_in_a_climb_counts_what_the_climb_still_gains():
    """From 5 deg up to a level 50 m above: past it no more than levelling off at once would be."""
    climbing = "reference.flight_path_deg=[[0,0],[4,4],[60,4]]"
    altitude = c.SetAltitude(value=3600.0, flight_path=5.0 * DEGREE, rate=1.0 * DEGREE)
    flight = flown_with((1500, altitude), overrides=[*level(70), climbing])
    assert flight.record["altitude"][-1] == pytest.approx(3600.0, abs=1.0)


@pytest.mark.parametrize("model", ["paper", "identified", "jsbsim"])
def test_injected_fault_is_the_scheduled_one(model):
    """0.6 injected before row 2000 of a healthy flight is the paper's fault at 20 s, to the bit."""
    fault = Fault(effectiveness=0.6, start=0.0)
    overrides = [f"model={model}", "duration=30"]
    injected = flown_with(
        (2000, c.SetFaults(targets=("thrust",), faults=(fault,))),
        scenario="nominal",
        overrides=overrides,
    )
    assert_same(injected, fly(load_scenario("paper", overrides)))


def test_injection_is_idempotent_and_healing_ends_scheduled_faults_too():
    flight = flown_with(
        (100, c.SetFaults(targets=("thrust",), faults=(FAULT,))),
        (150, c.SetFaults(targets=("thrust",), faults=(FAULT,))),
        (2500, c.SetFaults(targets=("thrust",))),
        scenario="paper",
    )
    truth = flight.record["effectiveness_thrust"]
    assert set(truth[100:2500]) == {0.7}  # in place of the scenario's, not times it
    assert set(truth[2500:]) == {1.0}


def test_setting_of_the_loop_acts_from_its_row_on():
    """Double gain from 5 s, under an initial error: same before, other after, and as from the start."""
    off = ["duration=10", "initial.airspeed=295"]
    plain = fly(load_scenario("nominal", off))
    changed = flown_with((500, c.SetLoop(key="gains[0]", value=2.0)), overrides=off)
    np.testing.assert_array_equal(plain.record["airspeed"][:501], changed.record["airspeed"][:501])
    assert changed.record["thrust_cmd"][500] > plain.record["thrust_cmd"][500]
    early = flown_with((1, c.SetLoop(key="gains[0]", value=2.0)), overrides=off)
    whole = fly(load_scenario("nominal", [*off, "loop.gains=[2,1,1]"]))
    assert early.record["airspeed"][-1] == pytest.approx(whole.record["airspeed"][-1], abs=0.03)


@pytest.mark.parametrize(
    ("key", "value"),
    [("gains[3]", 1.0), ("gains", 1.0), ("gains[0]", -1.0), ("wings", 1.0), ("name", 1.0),
     ("detector.margin", 2.0), ("estimator.channels[0]", 1.0), ("estimator.gate_patience", 2.0),
     ("", 1.0), ("gains[0][0]", 1.0), ("detector", 1.0)],
)  # fmt: skip
def test_setting_that_is_none_or_out_of_range_is_refused(key, value):
    with pytest.raises((ScenarioError, ValidationError), match=r"loop|key"):
        changed_loop(Loop(), c.SetLoop(key=key, value=value))


def test_recording_keeps_commands_and_replays_to_the_bit(tmp_path):
    """Every kind of command, saved, read back, flown again on each plant."""
    for model in ("paper", "jsbsim"):
        flight = flown_with(
            (50, c.SetAirspeed(value=305.0, rate=1.0)),
            (60, c.SetHeading(value=0.3, rate=0.05)),
            (70, c.SetAltitude(value=3100.0, flight_path=0.05, rate=0.01)),
            (80, c.SetLoop(key="trim_filter", value=20.0)),
            (90, c.SetFaults(targets=("thrust",), faults=(FAULT,))),
            (200, c.Pause()),
            (200, c.Resume()),
            (300, c.SetFaults(targets=("thrust",))),
            (400, c.SetFlightPath(value=0.02, rate=0.02)),
            (777, c.End()),
            overrides=[f"model={model}"],
        )
        assert flight.outcome.status == "ended"
        assert flight.record.size == 777
        assert passed(flight_metrics(flight))
        path = tmp_path / f"{model}.nc"
        save(flight, path)
        loaded = load(path)
        assert loaded.commands == flight.commands
        assert differences(loaded, replay(loaded)) == []


def test_interrupted_flight_replays_up_to_the_interruption():
    def interrupt(record, i):
        if i == 321:
            raise KeyboardInterrupt

    flight = fly(load_scenario("paper"), observers=[interrupt])
    again = replay(flight)
    assert again.record.size == 322
    assert differences(flight, again) == []


def test_difference_is_found_where_there_is_one():
    flight = flown_with((100, c.SetAirspeed(value=305.0, rate=1.0)), overrides=["duration=3"])
    without = fly(flight.scenario)
    found = differences(flight, without)
    assert found[0].name == "airspeed_cmd_raw"
    assert found[0].time == pytest.approx(1.0)
    assert found[0].largest == pytest.approx(2.01)


def test_queue_holds_the_flight_while_it_is_paused():
    """Paused before row 100; a set-point and the end of the pause come from another thread."""
    queue = CommandQueue()
    later = [c.SetAirspeed(value=310.0, rate=5.0), c.Resume()]

    def pause(record, i):
        if i == 99:
            queue.put(c.Pause())
            for index, command in enumerate(later):
                threading.Timer(0.1 * (index + 1), queue.put, [command]).start()

    flight = fly(load_scenario("nominal", ["duration=4"]), observers=[pause], commands=queue)
    assert [row for row, _ in flight.commands] == [100, 100, 100]
    assert 0.19 < queue.held < 5.0
    assert differences(flight, replay(flight)) == []
    assert flight.record["airspeed_cmd_raw"][-1] == pytest.approx(310.0)


def test_queue_that_nothing_comes_through_changes_nothing(flown):
    flight = fly(load_scenario("paper"), commands=CommandQueue())
    assert_same(flight, flown("paper"))
    assert flight.commands == ()


def test_recording_with_bad_commands_is_refused(tmp_path, flown):
    path = tmp_path / "flight.nc"
    dataset = to_dataset(flown("paper"))
    for bad in ('[{"row": 5, "command": {"kind": "explode"}}]', "no", '[{"row": 0}]'):
        dataset.attrs["commands"] = bad
        dataset.to_netcdf(path, engine="netcdf4")
        with pytest.raises(RecordingError, match="commands"):
            load(path)


@pytest.mark.parametrize(
    ("loop", "key", "value"),
    [
        ("ftc", "estimator.process_noise[3]", 1e-6),
        ("ftc", "estimator.measurement_noise[0]", 1e-6),
        ("robust", "estimator.response_time", 3.0),
        ("ftc", "trim_filter", 10.0),
    ],
)
def test_setting_of_the_filter_acts_in_flight(loop, key, value):
    """Set at 5 s, the estimate's standard deviation or the commands are others soon after."""
    overrides = [f"loop.name={loop}", "duration=8", "sensors.profile=tactical"]
    plain = fly(load_scenario("paper", overrides)).record
    changed = flown_with(
        (500, c.SetLoop(key=key, value=value)), scenario="paper", overrides=overrides
    ).record
    names = ("effectiveness_thrust_std", "thrust_cmd")
    assert all(np.array_equal(plain[n][:500], changed[n][:500]) for n in names)
    assert any(not np.array_equal(plain[n][510:], changed[n][510:]) for n in names)


@pytest.mark.parametrize("cut", [None, 700])
def test_thinned_recording_is_replayed(tmp_path, cut):
    """Every tenth sample saved, of a whole flight and of one that was ended: the same again to the bit."""
    overrides = ["duration=12", "simulation.record_every=10"]
    given = () if cut is None else ((cut, c.End()),)
    flight = flown_with(*given, scenario="paper", overrides=overrides)
    save(flight, tmp_path / "flight.nc")
    loaded = load(tmp_path / "flight.nc")
    assert loaded.record.size < flight.record.size / 9
    assert loaded.row_period == pytest.approx(0.1)
    assert differences(loaded, replay(loaded)) == []


def test_set_point_costs_the_same_however_much_of_the_flight_is_left():
    """20 set-points a second: as many rows are written on a flight of 11 h as on one of a minute."""

    def written(rows):
        ranges = []
        ahead = rows_ahead.RowsAhead(rows)
        for row in range(1, 2001, 5):
            ahead.rewrite("airspeed", row, lambda first, beyond: ranges.append((first, beyond)))
            ahead.reach(row + 5)
        return ranges

    assert written(6_000) == written(4_000_000)
    assert max(beyond - first for first, beyond in written(6_000)) <= rows_ahead.LENGTH


def test_rows_written_ahead_are_those_that_were_rewritten_to_the_end():
    """Ramps, steps, faults and references, each read long after the stretch that its command wrote."""
    altitude = c.SetAltitude(value=3300.0, flight_path=5.0 * DEGREE, rate=1.0 * DEGREE)
    fault = Fault(effectiveness=0.5, start=0.0, shape="ramp", rise=10.0)
    commands = [
        c.Applied(100, c.SetAirspeed(value=320.0, rate=1.0)),
        c.Applied(130, c.SetHeading(value=1.0, rate=0.05)),
        c.Applied(300, altitude),
        c.Applied(1400, c.SetFaults(targets=("thrust",), faults=(fault,))),
        c.Applied(2000, c.SetFlightPath(value=0.02, rate=0.01)),
    ]
    short = fly(load_scenario("nominal", level(40)), commands=RecordedCommands(commands))
    with mock.patch.object(rows_ahead, "LENGTH", 10_000_000):
        at_once = fly(load_scenario("nominal", level(40)), commands=RecordedCommands(commands))
    assert_same(short, at_once)
    assert short.record["airspeed_cmd_raw"][-1] == 320.0
    assert short.record["heading_cmd_raw"][-1] == 1.0
