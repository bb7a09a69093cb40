"""What is compiled before a first flight: what the flight needs, once, told as it goes on."""

import os
import subprocess
import sys

import numba
import pytest

from ftc_jsb.errors import UserError
from ftc_jsb.scenario.loop import Loop
from ftc_jsb.warm import EVERYTHING, Flown, needs
from ftc_jsb.warm import compiling as module
from ftc_jsb.warm.needs import ISOLATING, JSBSIM, POINT_MASS
from ftc_jsb.warm.parts import PARTS

FIRST_FLIGHT = """
from numba.core import event
from ftc_jsb.scenario.load import load_scenario
from ftc_jsb.simulation.fly import fly
from ftc_jsb.warm import is_cold, warm

seen = []
print(is_cold(["point-mass"]), warm(lambda *now: seen.append(now), ["point-mass"]) > 0.0)
print(is_cold(["point-mass"]), is_cold(["isolating"]))
assert seen[-1][0] == seen[-1][1], seen[-1]
print(len({done for done, _, _ in seen}), any(text.endswith(": isolate_faults") for _, _, text in seen))

class Compiled(event.Listener):
    names = []
    def on_start(self, event):
        self.names.append(event.data["dispatcher"].py_func.__name__)
    def on_end(self, event):
        pass

event.register("numba:compile", Compiled())
fly(load_scenario("paper", ["duration=1"]))
print(Compiled.names)
"""


def loop(name, **settings):
    return Loop.model_validate({"name": name, **settings})


def test_flight_needs_the_kernels_of_its_model_and_isolation_where_its_loop_isolates():
    assert needs([Flown("paper", loop("ftc")), Flown("identified", loop("robust"))]) == (
        POINT_MASS,
    )
    assert needs([Flown("jsbsim", loop("ftc"))]) == (JSBSIM,)
    assert needs([Flown("jsbsim", loop("robust"))]) == (ISOLATING,)
    assert needs([Flown("jsbsim", loop("ftc", isolation={"enabled": True}))]) == (ISOLATING,)
    assert needs([Flown("jsbsim", loop("my_loop:Mine"))]) == (JSBSIM,)
    both = [Flown("jsbsim", loop("robust")), Flown("paper", loop("ftc"))]
    assert needs(both) == (POINT_MASS, ISOLATING)


@pytest.mark.skipif(bool(numba.config.DISABLE_JIT), reason="nothing is compiled")
def test_first_flight_compiles_what_it_needs_once(tmp_path):
    """A cache of its own. Afterwards nothing is left to be compiled; of isolation nothing ever was.

    The bar reaches its end, and its number of kernels is right to 15 %: it was counted.
    """
    shown = subprocess.run(
        [sys.executable, "-c", FIRST_FLIGHT],
        env={**os.environ, "XDG_CACHE_HOME": str(tmp_path), "TMPDIR": str(tmp_path)},
        capture_output=True, text=True, check=False, timeout=300,
    )  # fmt: skip
    assert shown.returncode == 0, shown.stderr
    *told, names = shown.stdout.splitlines()
    steps, isolated = told[2].split()
    assert told[:2] == ["True True", "False True"]
    assert isolated == "False"
    assert names == "[]"
    kernels = list(tmp_path.rglob("*.kernel"))
    expected = sum(PARTS[name].kernels for name in ("loop", "plant", "point-mass"))
    assert len(kernels) == pytest.approx(expected, rel=0.15)
    assert int(steps) > 10


def test_part_that_fails_is_said_and_its_neighbour_ended(tmp_path, monkeypatch):
    monkeypatch.setattr(module, "PARTS", {"no-such-part": PARTS["loop"], "loop": PARTS["loop"]})
    monkeypatch.setattr(module, "_cold", lambda wanted: [JSBSIM])
    monkeypatch.setitem(module.PARTS, JSBSIM, PARTS[JSBSIM])
    monkeypatch.setenv("XDG_CACHE_HOME", str(tmp_path))
    with pytest.raises(UserError, match="compiling outer loop and filters failed"):
        module.warm(lambda *_: None, EVERYTHING)
    assert not list(tmp_path.rglob("*.warm"))
