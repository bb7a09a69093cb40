"""Aircraft of the installed jsbsim package: drafted if they can be woven, else refused in a sentence."""

import pytest

from ftc_jsb.aircraft.description import load_aircraft
from ftc_jsb.draft.aircraft_file import draft
from ftc_jsb.draft.envelope import load_factor_range
from ftc_jsb.errors import AircraftError
from ftc_jsb.six_dof.weaving.installed import installed, installed_names


def silent(line: str) -> None:
    """Progress that nobody reads."""


@pytest.mark.parametrize("name", installed_names())
def test_every_installed_aircraft_can_be_woven_or_says_what_is_missing(name):
    """Rotorcraft, rockets, balloons, gliders, propellers: one sentence, and no other failure."""
    try:
        source = installed(name)
    except AircraftError as refusal:
        assert name in str(refusal)
        assert "turbine" in str(refusal) or "aerodynamics" in str(refusal)
    else:
        assert 1 <= len(source.engines) <= 4


@pytest.mark.parametrize(
    ("name", "says"),
    [
        ("f22", "answers fcs/aileron-cmd-norm"),  # its ailerons stand still at this command alone
        ("f104", "systems/radar/range"),  # a property that FlightGear has
        ("OV10", "no level flight at 3048 m"),
    ],
)
def test_what_cannot_be_drafted_says_why(name, says, tmp_path):
    with pytest.raises(AircraftError, match=says):
        draft(name, tmp_path / name, silent)
    assert not (tmp_path / name).exists()


def test_draft_finds_again_what_the_shipped_file_says(tmp_path):
    """F-4N: positions, travel, throttle and drag rise as in the hand-made file; lift and speeds near it.

    C_Lmax to 0.05. Lowest speed below the shipped one, which keeps clear of what thrust at height
    cannot pay; highest within 10 m/s.
    """
    found = load_aircraft(str(draft("F4N", tmp_path / "F4N", silent).parent))
    shipped = load_aircraft("F4N")
    assert found.throttle == shipped.throttle
    assert found.positions == shipped.positions
    assert found.fuel_tanks == shipped.fuel_tanks
    assert found.setup == shipped.setup
    for name in ("elevator", "aileron", "rudder"):
        (own,), (theirs,) = getattr(found.surfaces, name), getattr(shipped.surfaces, name)
        assert own.property == theirs.property
        assert own.travel == pytest.approx(theirs.travel, abs=1e-3)
    test, known = found.flight_test, shipped.flight_test
    assert test.mach_breaks == known.mach_breaks
    assert test.altitude == known.altitude
    assert test.lift_coefficient_max == pytest.approx(known.lift_coefficient_max, abs=0.05)
    assert 60.0 < test.airspeed[0] <= known.airspeed[0]
    assert test.airspeed[1] == pytest.approx(known.airspeed[1], abs=10.0)
    assert found.airplane_class == "IV"


def test_a_throttle_that_an_autopilot_passes_on_is_commanded_before_it(tmp_path, monkeypatch):
    """Global 5000: its autopilot's file writes the throttle's position from the command.

    And JSBSim's own output of that aircraft, a log, is not left in the working folder.
    """
    monkeypatch.chdir(tmp_path)
    found = load_aircraft(str(draft("global5000", tmp_path / "g", silent).parent))
    assert found.throttle.property == "fcs/throttle-cmd-norm"
    assert found.throttle.military == 1.0
    assert found.airplane_class == "II"
    assert [path.name for path in tmp_path.iterdir()] == ["g"]


@pytest.mark.parametrize(
    ("mass", "thrust_to_weight", "load_factor"),
    [(50e3, 0.36, (0.0, 2.5)), (2.3e3, 0.4, (-1.76, 4.4)), (9e3, 0.9, (-2.0, 6.0)), (2e5, 0.9, (0.0, 2.5))],
    ids=["transport", "trainer", "fighter", "heavy with reheat"],
)  # fmt: skip
def test_load_factors_go_by_mass_and_thrust(mass, thrust_to_weight, load_factor):
    assert load_factor_range(mass, thrust_to_weight) == load_factor
