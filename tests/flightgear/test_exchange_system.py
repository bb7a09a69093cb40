"""The simulator's part of the exchange, in plain JSBSim: what it takes, who flies, what a pilot moves."""

import math

import pytest

from ftc_jsb.flightgear.lines import check_of, line_of
from tests.flightgear.simulated import command, loaded, properties, put

HOLD, OUTER_LOOP = 2.0, 1.0


@pytest.fixture
def fdm(exported):
    """In the air for 1 s, the inner loop alone flies."""
    fdm = loaded(exported)
    fly(fdm, 1.0)
    assert fdm["ftc/flying"] == HOLD
    return fdm


def fly(fdm, seconds):
    until = fdm.get_sim_time() + seconds
    while fdm.get_sim_time() < until - 1e-6:
        fdm.run()


def test_the_check_is_that_of_the_line(fdm, exported):
    """JSBSim's own sum of a frame is the sum of what FlightGear prints: to 1e-6 of 1e9, at any frame."""
    *names, check = properties(exported, "ftc-out.xml")
    for _ in range(20):
        fdm.run()
        assert check_of([fdm[name] for name in names]) == pytest.approx(fdm[check], abs=1e-6)


def test_a_command_is_taken_once_and_in_order(fdm):
    """Of lines that are right, doubled, out of order, from the future or garbled the first alone flies."""
    put(fdm, command(fdm, load_factor_cmd=1.1))
    fdm.run()
    assert fdm["ftc/flying"] == OUTER_LOOP
    assert fdm["ftc/command/load-factor"] == 1.1
    assert fdm["ftc/received/refused"] == 0
    fdm.run()
    now = fdm["simulation/frame"]
    garbled = line_of([1.0] * 27).replace(b"1.0", b"1.5", 1)
    lines = (
        command(fdm, sequence=2, load_factor_cmd=1.2, frame=now - 2),  # the frame that was answered
        command(fdm, sequence=3, load_factor_cmd=1.3, frame=now - 50),
        command(fdm, sequence=4, load_factor_cmd=1.4, frame=now + 1000),
        garbled,
    )
    for refused, line in enumerate(lines, 1):
        put(fdm, line)
        fdm.run()
        assert fdm["ftc/command/load-factor"] == 1.1
        assert fdm["ftc/received/refused"] == refused
    put(fdm, command(fdm, sequence=5, load_factor_cmd=1.5))
    fdm.run()
    assert fdm["ftc/command/load-factor"] == 1.5


@pytest.mark.parametrize("bank", [75.0, -60.0])
def test_without_commands_the_inner_loop_holds(fdm, bank):
    """0.5 s after the last command in a turn at 4 g: wings level in 4 s (0.5 deg), path level in 12 s
    (0.2 deg) from what the roll out left of it, airspeed of the hand-over within 3 m/s and back at it
    (0.5 m/s) after 30 s; with 40 % of thrust lost as well.
    """
    for number in range(1, 60):
        given = {
            "load_factor_cmd": 3.8,
            "bank_angle_cmd": math.radians(bank),
            "thrust_cmd": 70000.0,
        }
        put(fdm, command(fdm, sequence=number, **given))
        fly(fdm, 5 / 120)
    fly(fdm, 0.4)
    assert fdm["ftc/flying"] == OUTER_LOOP
    fly(fdm, 0.2)
    assert fdm["ftc/flying"] == HOLD
    airspeed = fdm["ftc/hold/airspeed-fps"]
    fdm["ftc/dialog/engine-0-effectiveness"] = 0.6
    fly(fdm, 4.0)
    assert fdm["ftc/bank/actual"] == pytest.approx(0.0, abs=math.radians(0.5))
    worst = 0.0
    for _ in range(260):
        fly(fdm, 0.1)
        worst = max(worst, abs(fdm["velocities/vt-fps"] - airspeed))
        if fdm.get_sim_time() > 20.0:
            assert fdm["ftc/hold/path-rad"] == pytest.approx(0.0, abs=math.radians(0.2))
    assert worst * 0.3048 < 3.0
    assert (fdm["velocities/vt-fps"] - airspeed) * 0.3048 == pytest.approx(0.0, abs=0.5)


def test_the_stick_that_a_simulator_writes_does_not_reach_the_surfaces(exported):
    """FlightGear writes its stick over the commands of the surfaces each picture. In the hold the flight
    is the same to the bit with and without.
    """
    flights = []
    for stick in (None, 0.3):
        fdm = loaded(exported)
        fly(fdm, 1.0)
        for number in range(60):
            put(fdm, command(fdm, sequence=number + 1, bank_angle_cmd=0.5, load_factor_cmd=1.2))
            for _ in range(5):
                if stick is not None:
                    for name in ("elevator", "aileron", "rudder"):
                        fdm[f"fcs/{name}-cmd-norm"] = stick
                fdm.run()
        flights.append([fdm["attitude/phi-rad"], fdm["velocities/vt-fps"], fdm["aero/alpha-rad"]])
    assert flights[0] == flights[1]


def test_a_pilot_moves_references_by_rates_inside_limits(fdm):
    """Before, they follow what is flown; with the stick over, bank goes by 30 deg/s up to 60 deg."""
    put(fdm, command(fdm, airspeed_ref=290.0))
    fly(fdm, 0.1)
    assert fdm["ftc/pilot/airspeed-mps"] == 290.0
    assert fdm["ftc/pilot/bank-rad"] == pytest.approx(fdm["ftc/bank/actual"], abs=1e-3)
    fdm["ftc/pilot/wanted"] = 1
    fdm["ftc/pilot/roll"], fdm["ftc/pilot/pitch"], fdm["ftc/pilot/lever"] = 1.0, 0.5, -1.0
    fly(fdm, 1.0)
    assert fdm["ftc/pilot/has"] == 1
    assert fdm["ftc/pilot/bank-rad"] == pytest.approx(0.52, abs=0.01)
    assert fdm["ftc/pilot/path-rad"] == pytest.approx(0.035, abs=0.002)
    assert fdm["ftc/pilot/airspeed-mps"] == pytest.approx(285.0, abs=0.1)
    fly(fdm, 40.0)
    assert fdm["ftc/pilot/bank-rad"] == pytest.approx(math.radians(60.0), abs=0.001)
    assert fdm["ftc/pilot/airspeed-mps"] == 130.0  # slowest that it was tested at


def test_faults_of_the_link_and_of_the_dialog_add_up(fdm):
    put(fdm, command(fdm, engine_0_effectiveness=0.8, elevator_state=2))
    fdm["ftc/dialog/engine-0-effectiveness"] = 0.5
    fdm["ftc/dialog/rudder-state"] = 2
    fdm.run()
    assert fdm["ftc/effectiveness/engine[0]"] == pytest.approx(0.4)
    assert (fdm["ftc/fault/elevator-state"], fdm["ftc/fault/rudder-state"]) == (2, 2)
