"""The woven F-16: effectiveness at the engine's tables, named corrections, no silent property."""

import shutil
from pathlib import Path

import pytest

from ftc_jsb.aircraft.description import Correction, Edit, load_aircraft
from ftc_jsb.errors import AircraftError
from ftc_jsb.scenario.load import load_scenario
from ftc_jsb.scenario.schema import Initial
from ftc_jsb.simulation.fly import fly
from ftc_jsb.six_dof.loading import load
from ftc_jsb.six_dof.properties import node, write_checked
from ftc_jsb.six_dof.trim import trimmed
from ftc_jsb.six_dof.weaving.engine_deck import EFFECTIVENESS
from ftc_jsb.six_dof.weaving.woven_aircraft import woven_aircraft
from ftc_jsb.units import POUND_FORCE

F16 = load_aircraft("f16")


def thrust_before_and_after(throttle: float, effectiveness: float) -> tuple[float, float]:
    """Settled healthy thrust [N] at a throttle, and that of the next frames with the fault."""
    fdm = trimmed(F16, woven_aircraft(F16, True), 0.005, Initial(), 0.43)
    fdm["fcs/throttle-cmd-norm"] = throttle
    while fdm.get_sim_time() < 3.0:
        fdm.run()
    healthy = fdm["propulsion/engine/thrust-lbs"] * POUND_FORCE
    fdm[f"{EFFECTIVENESS}[0]"] = effectiveness
    fdm.run()
    fdm.run()
    return healthy, fdm["propulsion/engine/thrust-lbs"] * POUND_FORCE


@pytest.mark.parametrize("throttle", [0.0, 0.2, 0.39, 0.5, 0.75, 1.0], ids="throttle {}".format)
@pytest.mark.parametrize("k", [0.6, 0.3, 0.0], ids="k {}".format)
def test_thrust_is_k_times_the_healthy_thrust(throttle, k):
    """From idle to full reheat, idle thrust being negative at M 0.91.

    20 N, 0.02 % of maximum thrust: what two frames of changing speed make of the engine's tables.
    """
    healthy, faulty = thrust_before_and_after(throttle, k)
    assert faulty == pytest.approx(k * healthy, abs=20.0)


def test_healthy_woven_engine_delivers_what_is_commanded():
    """Throttle by inversion of the engine's tables: delivered within 0.2 % of maximum thrust."""
    fdm = trimmed(F16, woven_aircraft(F16, True), 0.005, Initial(), 0.43)
    fdm["ftc/command/thrust-n"] = fdm["propulsion/engine/thrust-lbs"] * POUND_FORCE
    fdm["ftc/engaged"] = 1.0
    for thrust in (-5e3, 20e3, 60e3, 80e3, 105e3):
        fdm["ftc/command/thrust-n"] = thrust
        for _ in range(600):
            fdm.run()
        assert fdm["propulsion/engine/thrust-lbs"] * POUND_FORCE == pytest.approx(thrust, abs=220.0)


@pytest.mark.parametrize(
    ("corrected", "yaw_feedback"), [(True, False), (False, True)], ids=["corrected", "stock"]
)
def test_corrections_are_switchable(corrected, yaw_feedback):
    """The stock yaw damper feeds back yaw rate, the corrected one does not; so with the flaperons."""
    root = woven_aircraft(F16, corrected)
    text = (root / "aircraft" / "f16" / "f16.xml").read_text()
    assert ("<input>fcs/yaw-rate-norm</input>" in text) == yaw_feedback
    assert ("-fcs/left-flaperon-norm" in text) != yaw_feedback


def test_every_quirk_is_named_and_explained():
    names = {correction.name: correction.reason for correction in F16.correction}
    assert set(names) == {"yaw damper", "flaperon mix", "rudder position"}
    assert all(len(reason) > 100 for reason in names.values())


def test_woven_copy_lives_outside_the_project():
    """The shipped files are GPL: nothing of them is written beside this project's own."""
    root = woven_aircraft(F16, True)
    assert Path(__file__).parents[3] not in root.parents


def test_edit_that_does_not_find_what_it_expects_is_refused():
    edit = Edit(element="flight_control/channel[@name='Yaw']", expect="something else", remove=True)
    other = F16.model_copy(update={"correction": (Correction(name="x", reason="y", edit=(edit,)),)})
    with pytest.raises(AircraftError, match=r"correction 'x'.*expected 'something else'"):
        woven_aircraft(other, True)


def test_missing_model_is_refused():
    other = F16.model_copy(update={"jsbsim_model": "f99"})
    with pytest.raises(AircraftError, match=r"f99\.xml not found"):
        woven_aircraft(other, True)


def test_unknown_and_read_only_properties_are_errors():
    """JSBSim itself reads an unknown name as 0 and ignores a write to a read-only one."""
    fdm = load(F16, woven_aircraft(F16, True), 0.005)
    with pytest.raises(AircraftError, match="no property 'fcs/elevatr'"):
        node(fdm, "fcs/elevatr")
    fdm.run_ic()
    with pytest.raises(AircraftError, match="does not take 5"):
        write_checked(fdm, "velocities/mach", 5.0)


def test_stock_and_corrected_are_woven_apart():
    assert woven_aircraft(F16, True) != woven_aircraft(F16, False)


def test_number_that_an_inner_loop_lacks_is_named(tmp_path):
    """A user's folder with a misspelt property: the message has what is missing; nothing is flown."""
    folder = tmp_path / "mine"
    shutil.copytree(F16.folder, folder)
    path = folder / "inner_loop.xml"
    path.write_text(path.read_text().replace('"ftc/airframe/aileron"', '"ftc/airframe/ailron"', 1))
    with pytest.raises(AircraftError, match="ftc/airframe/aileron"):
        fly(load_scenario("paper", ["model=jsbsim", f"aircraft.name='{folder}'"]))


def test_own_folder_flies_by_path_and_a_bare_name_is_always_the_shipped_one(tmp_path, monkeypatch):
    """A folder `paper` in the working folder does not replace Table 1; `./paper` is that folder."""
    shutil.copytree(F16.folder, tmp_path / "paper")
    monkeypatch.chdir(tmp_path)
    assert fly(load_scenario("nominal", ["duration=0.1"])).record["mass"][0] == 14515.0
    own = load_scenario("nominal", ["duration=0.1", "model=jsbsim", "aircraft.name='./paper'"])
    assert fly(own).outcome.status == "complete"
