"""A flight that stops after every sample to be told its commands."""

from collections.abc import Callable
from functools import partial
from typing import Any

from ftc_jsb.compiled import direct
from ftc_jsb.control.protocol import Command, LoopSetup, Measurement, Reference
from ftc_jsb.recording.flight import Flight, Outcome
from ftc_jsb.scenario.schema import Scenario
from ftc_jsb.simulation.admissible_faults import refuse_unflyable
from ftc_jsb.simulation.assembly import assemble
from ftc_jsb.simulation.departure import FLYING, REASONS
from ftc_jsb.simulation.sample import perceive

_STATES = Reference._fields[:3]


class SampledFlight:
    """Plant, instruments and references of a scenario; its outer loop is whoever calls `step`."""

    def __init__(self, scenario: Scenario) -> None:
        """Trimmed, and the first row perceived.

        Raises:
            UserError: as `simulation.fly`.
        """
        refuse_unflyable(scenario)
        self._scenario = scenario
        self._flown = assemble(scenario)
        self._notice: Callable[[int], int] = partial(
            direct(perceive, self._flown.inputs, 0), self._flown.inputs
        )
        self.row = 0
        self.reason = FLYING
        self._perceive()

    @property
    def setup(self) -> LoopSetup:
        """What a loop of this flight is built from."""
        return self._flown.setup

    @property
    def over(self) -> bool:
        """Whether the last sample of the scenario has been perceived."""
        return self.row >= self._flown.record.size - 1

    @property
    def measurement(self) -> Measurement:
        """What is measured now."""
        return Measurement(*(self._now(f"{name}_meas") for name in Measurement._fields))

    @property
    def reference(self) -> Reference:
        """What is to be tracked now."""
        names = [f"{n}_ref" for n in _STATES] + [f"{n}_ref_rate" for n in _STATES]
        names += ["north_ref", "east_ref", "altitude_ref"]
        return Reference(*map(self._now, names))

    def value(self, name: str) -> float:
        """The truth of a recorded variable now, SI and rad."""
        return self._now(name)

    def step(self, command: Command) -> bool:
        """Fly a command for one sample; whether the flight goes on."""
        row = self._flown.record[self.row]
        row["thrust_cmd"] = command.thrust
        row["load_factor_cmd"] = row["load_factor_demand"] = command.load_factor
        row["bank_angle_cmd"] = row["bank_angle_demand"] = command.bank_angle
        self._flown.plant.step(self.row)
        self.row += 1
        self._perceive()
        return self.reason == FLYING

    def flight(self) -> Flight:
        """What has been flown, as a recording has it."""
        time = self.row / self._scenario.loop.rate
        outcome = Outcome("ended", time, "ended by command")
        if self.reason != FLYING:
            outcome = Outcome("departed", time, REASONS[self.reason])
        elif self.over:
            outcome = Outcome("complete", self._scenario.duration, "")
        return Flight(self._scenario, self._flown.record[: self.row + 1].copy(), outcome, None)

    def close(self) -> None:
        """Release the plant."""
        self._flown.plant.close()

    def _perceive(self) -> None:
        self._flown.plant.truth(self.row)
        self.reason = int(self._notice(self.row))

    def _now(self, name: str) -> float:
        value: Any = self._flown.record[self.row][name]
        return float(value)
