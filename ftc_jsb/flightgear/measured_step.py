"""A loop whose samples come when they come: filter, law and references take the step that is measured."""

from collections.abc import Callable
from functools import partial
from typing import Any

import numpy as np
import numpy.typing as npt

from ftc_jsb.compiled import compiled, direct
from ftc_jsb.control.command_filter import command_filter
from ftc_jsb.control.protocol import LoopSetup
from ftc_jsb.control.records import LoopArrays
from ftc_jsb.loops.built_in import CompiledLoop, loop_settings, tuned_by_sensors
from ftc_jsb.point_mass.dynamics import velocity
from ftc_jsb.point_mass.model import at_condition
from ftc_jsb.point_mass.thrust import healthy_thrust, rotor_speed_target
from ftc_jsb.scenario.reference import Reference
from ftc_jsb.simulation.assembly import Assembly
from ftc_jsb.simulation.sample import perceive, sample_step

MATRICES = ("transition", "from_now", "from_next")

EVEN_STEP = 0.05  # [s]: up to here the filter's own covariances hold
THIRD = 1.0  # [m/s^4]: a twelfth of the second derivative of drag over mass in a brisk roll


def rule_error(step: float) -> float:
    """Airspeed [m/s] by which a long step may be off: drag is taken as the mean of its ends.

    The error of the trapezoid rule goes by the third power of the step; where pictures or lines are missing
    it would be taken for a loss of thrust.
    """
    return THIRD * max(step**3 - EVEN_STEP**3, 0.0)


@compiled
def engine_at(loop: LoopArrays, thrust: float) -> None:
    """Settled rotor and thrust of the observer's healthy engine at a command [N]."""
    m, x = loop.model[0], loop.state[0]
    at = at_condition(m, x.known.state[0], x.known.altitude)
    x.observer.rotor_speed = rotor_speed_target(at, thrust)
    x.observer.thrust = healthy_thrust(at, x.observer.rotor_speed, thrust)


class MeasuredStep:
    """Takes samples of a flight's loop, each with the time that has passed since the one before.

    What the loop does over a sample it does over the sample that has passed, so that its step is known. The
    command filter alone looks ahead: it goes to the next sample by a guess, and goes there again once the
    step is known.
    """

    def __init__(self, flown: Assembly, reference: Reference) -> None:
        """Args: what the flight is made of; [reference] of its scenario."""
        self._flown, self._reference = flown, reference
        self._filters, self._hold = flown.inputs.command_filter, flown.inputs.altitude_hold
        self._before: tuple[npt.NDArray[Any], npt.NDArray[Any]] | None = None
        self._perceive = direct(perceive, flown.inputs, 0)
        self._decide = self._deciding()

    def _deciding(self) -> Callable[[int], int]:
        loop, inputs = self._flown.loop, self._flown.inputs
        if isinstance(loop, CompiledLoop):
            seen = (inputs, loop.arrays)
            return partial(direct(sample_step, *seen, 0), *seen)

        def decide(i: int) -> int:
            reason: int = self._perceive(inputs, i)
            if reason == 0:
                loop.step(i)
            return reason

        return decide

    def start_references(self, values: npt.ArrayLike, position: npt.ArrayLike) -> None:
        """References at rest on `values` (3,) [m/s, rad, rad], at `position` (3,) [m], from this sample on."""
        f = self._filters[0]
        f["value"], f["position"] = values, position
        f["slope"] = f["acceleration"] = 0.0
        f["velocity"] = velocity(*np.asarray(values, dtype=float))
        self._hold[0]["active"] = 0
        self._before = None

    def sample(self, i: int, step: float, setup: LoopSetup) -> int:
        """Row `i`, `step` seconds after the row before; commands are in the row then.

        Args:
            i: row; its truth, its time and raw commands, and those of the row after, are there.
            step: simulation time since row i - 1 [s]; of row 0, a guess.
            setup: of the loop, as it is now.

        Returns:
            Why the flight has departed; FLYING if it has not.
        """
        before = self._before if i > 0 else None
        if before is not None:
            self._filters[:], self._hold[:] = before
        self._use_step(step, setup)
        if before is not None:
            self._perceive(self._flown.inputs, i - 1)  # with the step that it was
        self._before = (self._filters.copy(), self._hold.copy())
        return self._decide(i)

    def start_engine(self, thrust: float) -> None:
        """The engine that the loop imagines runs at the thrust [N] in force, not at that of level flight."""
        loop = self._flown.loop
        if isinstance(loop, CompiledLoop):
            given = (loop.arrays, thrust)
            direct(engine_at, *given)(*given)

    def in_force(self, thrust: float, load_factor: float, bank_angle: float) -> None:
        """What the aircraft was commanded since the last sample: the filter's input [N], -, [rad]."""
        loop = self._flown.loop
        if isinstance(loop, CompiledLoop):
            state = loop.arrays.state[0]
            state["demand"] = (thrust, load_factor, bank_angle)
            state["inner_loop"]["command"] = (load_factor, bank_angle)

    def _use_step(self, step: float, setup: LoopSetup) -> None:
        shape = self._reference.filter_frequency, self._reference.filter_damping
        ahead = command_filter(*shape, step, np.zeros(3))
        for name in MATRICES:
            self._filters[name] = ahead[name]
        loop = self._flown.loop
        if isinstance(loop, CompiledLoop):
            settings = loop_settings(setup._replace(dt=step), self._flown.model)
            if not tuned_by_sensors(setup.settings):  # Q is given a sample of loop.rate
                settings["process_noise"] *= step * setup.settings.rate
            settings["process_noise"][0][0] += rule_error(step) ** 2
            loop.arrays.settings[:] = settings
