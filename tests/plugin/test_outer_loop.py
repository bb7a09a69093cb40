"""The outer loop on a user's FGFDMExec: the documented example, the same flight as `fly`, refusals."""

import math
import runpy
from pathlib import Path

import jsbsim
import numpy as np
import pytest

from ftc_jsb.aircraft.description import load_aircraft
from ftc_jsb.errors import AircraftError, LoopError
from ftc_jsb.plugin import OuterLoop, load_woven, woven_root
from ftc_jsb.recording.columns import ROW
from ftc_jsb.scenario.load import load_scenario
from ftc_jsb.scenario.loop import Loop
from ftc_jsb.simulation.assembly import point_mass_of
from ftc_jsb.six_dof.trim import trimmed
from ftc_jsb.six_dof.weaving.engine_deck import EFFECTIVENESS

EXAMPLE = Path(__file__).parents[2] / "docs" / "examples" / "plugin.py"


def own_fdm(dt: float = 0.005, woven: bool = True) -> jsbsim.FGFDMExec:
    """A user's F-16 at 250 m/s, 3000 m, heading 350 deg, trimmed, engine running."""
    fdm = jsbsim.FGFDMExec(None)
    fdm.set_debug_level(0)
    if woven:
        load_woven(fdm, "f16", dt)
    else:
        fdm.set_dt(dt)
        fdm.load_model("f16")
    fdm["ic/h-sl-ft"], fdm["ic/vt-fps"], fdm["ic/psi-true-deg"] = 9842.5, 820.2, 350.0
    fdm.run_ic()
    fdm["propulsion/set-running"] = -1
    fdm["simulation/do_simple_trim"] = 1
    return fdm


def advance(fdm: jsbsim.FGFDMExec, loop: OuterLoop, seconds: float) -> None:
    end = fdm.get_sim_time() + seconds - 1e-6
    while fdm.get_sim_time() < end:
        loop.update()
        fdm.run()


def test_documented_example_turns_30_degrees_and_finds_the_fault():
    """30 s: effectiveness within 0.005 of 0.6, declared, heading within 0.1 deg, speed 1 m/s."""
    after = runpy.run_path(str(EXAMPLE))
    loop = after["loop"]
    assert loop.effectiveness == pytest.approx(0.6, abs=0.005)
    assert 0.0 < loop.effectiveness_std < 0.05
    assert loop.fault_declared
    assert math.degrees(loop["heading"]) == pytest.approx(30.0, abs=0.1)
    assert loop["airspeed"] == pytest.approx(984.0 * 0.3048, abs=1.0)


def test_documentation_shows_the_example_that_is_run():
    page = (EXAMPLE.parents[1] / "plugin.md").read_text()
    shown = page.split("```python\n")[1].split("```")[0]
    assert EXAMPLE.read_text().endswith(shown)


def test_plug_in_flies_what_fly_flies(flown):
    """The paper's scenario, the user's fault at 20 s through the property: bit for bit.

    Every column but the positions, which agree to 1 um.
    """
    scenario = load_scenario("paper", ["model=jsbsim"])
    record = flown("paper", "model=jsbsim").record
    aircraft = load_aircraft("f16")
    fuel = scenario.aircraft.fuel_fraction
    fdm = trimmed(aircraft, woven_root("f16"), 0.005, scenario.initial, fuel)
    mass = point_mass_of(scenario).initial_mass(fuel)
    loop = OuterLoop(fdm, "f16", scenario.loop, scenario.reference, mass)
    places = [
        f"{axis}{kind}" for axis in ("north", "east", "altitude") for kind in ("", "_meas", "_ref")
    ]
    for i in range(2500):
        fdm[f"{EFFECTIVENESS}[0]"] = 0.6 if i >= 2000 else 1.0
        assert loop.update()
        fdm.run()
        assert not loop.update()
        fdm.run()
        if i % 50 == 0 or i > 1990:
            for name in set(ROW.names) - {*places, "engine_0_effectiveness"}:
                np.testing.assert_array_equal(loop[name], record[i][name], err_msg=f"{name} {i}")
            for name in places:  # the origin is read back from JSBSim: 1 um
                assert loop[name] == pytest.approx(record[i][name], abs=1e-6)


def test_set_points_are_held_and_tracked_through_north():
    """Held at first; then 240 m/s, 3 deg, heading 380: within 0.5 m/s, 0.1 deg, 0.1 deg after 25 s."""
    fdm = own_fdm()
    loop = OuterLoop(fdm, "f16")
    assert math.isnan(loop.effectiveness)
    assert not loop.fault_declared
    advance(fdm, loop, 3.0)
    assert loop["airspeed"] == pytest.approx(250.0, abs=0.1)
    assert math.degrees(loop["heading"]) == pytest.approx(350.0, abs=0.05)
    loop.track(airspeed=240.0, flight_path_angle=math.radians(3.0))
    for k in range(500):  # set anew at every sample: 4 deg/s to the right
        loop.track(heading=math.radians(min(350.0 + 0.04 * k, 380.0)))
        advance(fdm, loop, 0.01)
    loop.track(heading=math.radians(380.0))
    advance(fdm, loop, 20.0)
    assert loop["airspeed"] == pytest.approx(240.0, abs=0.5)
    assert math.degrees(loop["flight_path_angle"]) == pytest.approx(3.0, abs=0.1)
    assert math.degrees(loop["heading"]) == pytest.approx(380.0, abs=0.1)
    assert loop.effectiveness == pytest.approx(1.0, abs=0.01)


def test_any_rate_that_the_time_step_divides():
    """JSBSim at 120 Hz with the loop at 40 Hz; one sample in three frames."""
    fdm = own_fdm(dt=1.0 / 120.0)
    loop = OuterLoop(fdm, "f16", Loop(rate=40.0))
    taken = []
    for _ in range(1200):
        taken.append(loop.update())
        fdm.run()
    assert taken == [frame % 3 == 0 for frame in range(1200)]
    assert loop["airspeed"] == pytest.approx(250.0, abs=0.2)


def test_stock_aircraft_without_inner_loop_is_refused():
    with pytest.raises(AircraftError, match=r"has no inner loop.*load_woven\(fdm, 'f16', dt\)"):
        OuterLoop(own_fdm(woven=False), "f16")
    with pytest.raises(AircraftError, match="has no aircraft"):
        OuterLoop(jsbsim.FGFDMExec(None), "f16")


def test_time_step_that_does_not_divide_the_period_is_refused():
    with pytest.raises(
        LoopError, match=r"0\.00833.* s does not divide the loop's period of 0\.01 s"
    ):
        OuterLoop(own_fdm(dt=1.0 / 120.0), "f16")
    with pytest.raises(LoopError, match="does not divide"):
        OuterLoop(own_fdm(dt=0.02), "f16")
    with pytest.raises(LoopError, match="needs at least 80 Hz"):
        OuterLoop(own_fdm(dt=0.02), "f16", Loop(rate=50.0))


def test_what_the_inner_loop_counts_on_is_checked():
    fdm = own_fdm()
    fdm["fcs/fbw-override"] = 0.0
    with pytest.raises(AircraftError, match="fcs/fbw-override is 0, expected 1"):
        OuterLoop(fdm, "f16")
    fdm = own_fdm()
    fdm["propulsion/engine/set-running"] = 0
    with pytest.raises(AircraftError, match="engine 0 does not run"):
        OuterLoop(fdm, "f16")


def test_missed_samples_and_a_changed_clock_are_errors():
    fdm = own_fdm()
    loop = OuterLoop(fdm, "f16")
    loop.update()
    for _ in range(3):
        fdm.run()
    with pytest.raises(LoopError, match=r"call update\(\) before every run"):
        loop.update()
    fdm = own_fdm()
    loop = OuterLoop(fdm, "f16")
    fdm.set_dt(0.01)
    with pytest.raises(LoopError, match=r"attached at 0\.005 s"):
        loop.update()


def test_bad_set_points_are_errors():
    fdm = own_fdm()
    with pytest.raises(LoopError, match="airspeed is nan, expected a finite number"):
        OuterLoop(fdm, "f16").track(airspeed=math.nan)
    reference = load_scenario("paper").reference
    with pytest.raises(LoopError, match="references are those of the scenario"):
        OuterLoop(fdm, "f16", reference=reference).track(airspeed=200.0)
    with pytest.raises(KeyError):
        OuterLoop(fdm, "f16")["airspede"]


def test_departure_is_told():
    """Flown into the sea, which the law alone does not refuse: the reason, not nan."""
    fdm = own_fdm()
    loop = OuterLoop(fdm, "f16", Loop(name="law"))
    loop.track(flight_path_angle=math.radians(-60.0))
    with pytest.raises(LoopError, match=r"departed at .* s: "):
        advance(fdm, loop, 60.0)
