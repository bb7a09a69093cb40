"""Two futures from one moment: what lies before is the same to the bit, and so is what nothing changes."""

import numpy as np
import pytest

import ftc_jsb as ftc
from ftc_jsb.simulation.replay import differences, replay

AT = 6.0  # [s]


def _flown(model):
    """Real instruments and gusts on the models that have them; the fault sets in before the moment."""
    values = {"duration": 10.0, "fault[0].start": 3.0}
    if model != "paper":
        values |= {"sensors.profile": "tactical", "wind.turbulence": "moderate"}
    return ftc.fly("paper", model=model, loop="robust", set=values)


@pytest.mark.parametrize("model", ["paper", "identified", "jsbsim"])
def test_the_past_is_the_same_to_the_bit_and_the_future_is_not(model):
    flight = _flown(model)
    branch = flight.at(AT).branch(set={"fault[0].effectiveness": 0.4, "loop.gains[0]": 2.0})
    row = round(AT * 100)
    past = [f.record[:row].tobytes() for f in (flight, branch)]
    assert past[0] == past[1]
    assert flight.record["effectiveness_thrust"][row] == 0.6
    assert np.all(branch.record["effectiveness_thrust"][row:] == 0.4)
    assert np.any(branch.record["airspeed"][row:] != flight.record["airspeed"][row:])


@pytest.mark.parametrize("model", ["paper", "jsbsim"])
def test_where_nothing_is_changed_all_of_it_is_the_same(model):
    flight = _flown(model)
    assert flight.at(AT).branch().record.tobytes() == flight.record.tobytes()


def test_a_branch_of_the_references_is_saved_and_replayed(tmp_path):
    flight = _flown("paper")
    branch = flight.at(AT).branch(set={"reference.heading_deg": [[0, 0], [6, 0], [9, 30]]})
    assert np.degrees(branch.record["heading_cmd_raw"][-1]) == pytest.approx(30.0)
    saved = ftc.load(branch.save(tmp_path / "branch.nc"))
    assert not differences(saved.recorded, replay(saved.recorded))


def test_a_branch_of_a_branch_keeps_both():
    first = _flown("paper").at(4.0).branch(set={"fault[0].effectiveness": 0.5})
    second = first.at(AT).branch(set={"fault[0].effectiveness": 0.8})
    truth = second.record["effectiveness_thrust"]
    assert [truth[350], truth[450], truth[700]] == [0.6, 0.5, 0.8]


@pytest.mark.parametrize(
    ("values", "says"),
    [
        ({"model": "jsbsim"}, "model: cannot change in flight"),
        ({"loop.name": "no-ftc"}, "loop.name: cannot change in flight"),
        ({"reference.filter_damping": 0.5}, "reference: cannot change in flight"),
        ({"seed": 3}, "seed: cannot change"),
        ({"fault[0].target": "elevator"}, "fault\\[0\\].target"),
        ({"fault[0].effectivness": 0.5}, "did you mean 'effectiveness'"),
    ],
)
def test_what_cannot_change_in_flight_is_refused(values, says):
    with pytest.raises(ftc.UserError, match=says):
        _flown("paper").at(AT).branch(set=values)


def test_isolation_cannot_begin_in_flight():
    """It learns from the first sample on; begun later, it used to do nothing."""
    flight = ftc.fly("paper", loop="ftc", set={"duration": 2.0})
    with pytest.raises(ftc.UserError, match=r"loop\.isolation\.enabled: cannot be switched on"):
        flight.at(1.0).branch(set={"loop.isolation.enabled": True})


@pytest.mark.parametrize("time", [0.0, -1.0, 10.0, 50.0])
def test_a_moment_lies_inside_the_flight(time):
    with pytest.raises(ftc.UserError, match="not inside the flight"):
        _flown("paper").at(time)


def test_a_moment_tells_its_state():
    flight = _flown("paper")
    assert flight.at(AT).state["airspeed"] == flight.record["airspeed"][600]
