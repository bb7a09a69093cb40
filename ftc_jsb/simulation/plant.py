"""What `fly` asks of a plant. The outer loop cannot tell one plant from another."""

from typing import Any, Protocol

import numpy.typing as npt


class Plant(Protocol):
    """An aircraft that answers to commands, one sample of the outer loop at a time."""

    def reset(self, record: npt.NDArray[Any]) -> None:
        """Trim at the initial condition and bind the recording, (rows,) of `variables.ROW`."""

    def truth(self, i: int) -> None:
        """Write the state at the start of sample `i` to row `i`; what is measured of it is not its concern."""

    def step(self, i: int) -> None:
        """Fly the commands and the effectiveness of row `i` for one sample."""

    def close(self) -> None:
        """Release what the plant holds."""
