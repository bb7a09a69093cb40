"""A plant with one input perturbed: the loop's command goes on, unseen by it, with gain, delay or injection."""

from typing import Any, NamedTuple, Protocol

import numpy as np
import numpy.typing as npt

from ftc_jsb.simulation.plant import Plant
from ftc_jsb.vocabulary.channels import Channel

Array = npt.NDArray[np.float64]


class Perturbation(Protocol):
    """What is done to one command of the loop on its way to the plant."""

    def __call__(self, commands: Array, i: int) -> float:
        """What the plant is given at sample `i`, from the loop's commands up to there."""


class Injection(NamedTuple):
    """A signal is added."""

    signal: Array  # (rows,)

    def __call__(self, commands: Array, i: int) -> float:
        """See Perturbation."""
        return float(commands[i] + self.signal[i])


class Gain(NamedTuple):
    """The command's distance from its trim is multiplied from a sample on, and a step added.

    About the trim, since a gain on all of it would be a loss of effectiveness, which the loop
    estimates and makes good.
    """

    factor: float
    start: int
    step: float

    def __call__(self, commands: Array, i: int) -> float:
        """See Perturbation."""
        if i < self.start:
            return float(commands[i])
        trim = commands[self.start - 1]
        return float(trim + self.factor * (commands[i] - trim) + self.step)


class Delay(NamedTuple):
    """The command arrives later from a sample on, and a step is added.

    A part of a sample is linear between two commands: late by that part to 1 % of a sample for
    frequencies below a tenth of the sample rate.
    """

    samples: float
    start: int
    step: float

    def __call__(self, commands: Array, i: int) -> float:
        """See Perturbation."""
        if i < self.start:
            return float(commands[i])
        whole = int(self.samples)
        part = self.samples - whole
        late, later = commands[max(i - whole, 0)], commands[max(i - whole - 1, 0)]
        return float((1.0 - part) * late + part * later + self.step)


class PerturbedPlant:
    """A `Plant` around another one that perturbs one command before it is flown.

    The recording keeps what the loop commanded; what was flown is in `given`.
    """

    def __init__(self, plant: Plant, channel: Channel, perturbation: Perturbation) -> None:
        """Args: the plant; which command is perturbed; how."""
        self._plant = plant
        self._column = f"{channel}_cmd"
        self._perturbation = perturbation
        self.given: Array = np.empty(0)

    def reset(self, record: npt.NDArray[Any]) -> None:
        """As the plant; of a JSBSim aircraft the fuel is frozen, so that the trim stays."""
        self._plant.reset(record)
        fdm = getattr(self._plant, "fdm", None)
        if fdm is not None:
            from ftc_jsb.six_dof.properties import writer

            writer(fdm, "propulsion/fuel_freeze")(1.0)  # reads back as 0 whatever it is
        self._record = record
        self._commands = record[self._column]
        self.given = np.full(record.size, np.nan)

    def truth(self, i: int) -> None:
        """As the plant."""
        self._plant.truth(i)

    def step(self, i: int) -> None:
        """Fly the perturbed command for one sample."""
        commanded = float(self._commands[i])
        self.given[i] = self._perturbation(self._commands, i)
        self._commands[i] = self.given[i]
        try:
            self._plant.step(i)
        finally:
            self._commands[i] = commanded

    def close(self) -> None:
        """As the plant."""
        self._plant.close()
