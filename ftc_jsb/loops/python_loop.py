"""A user's loop flown on a recording: rows as named tuples in, checked numbers out."""

import math
from collections.abc import Mapping
from typing import Any

import numpy.typing as npt

from ftc_jsb.control.protocol import Command, Measurement, OuterLoop, Reference
from ftc_jsb.errors import LoopError
from ftc_jsb.loops.fence import said, shown


class PythonLoop:
    """A loop of the user's, given rows of the recording as named tuples."""

    def __init__(self, loop: OuterLoop, record: npt.NDArray[Any]) -> None:
        """Args: the loop; the recording it reads and writes."""
        self._loop = loop
        self._record = record
        self._measured = [f"{name}_meas" for name in Measurement._fields]
        states = Reference._fields[:3]
        self._reference = [f"{n}_ref" for n in states] + [f"{n}_ref_rate" for n in states]
        self._reference += ["north_ref", "east_ref", "altitude_ref"]
        names = record.dtype.names or ()
        self._writable = [n for n in names if n.endswith(("_est", "_std"))] + ["fault_declared"]

    def step(self, i: int) -> None:
        """One sample.

        Raises:
            LoopError: the loop raised, or returned something that is not a Command.
        """
        row = self._record[i]
        measurement = Measurement(*(float(row[name]) for name in self._measured))
        reference = Reference(*(float(row[name]) for name in self._reference))
        name = f"{type(self._loop).__module__}:{type(self._loop).__qualname__}"
        try:
            command = self._loop.step(float(row["time"]), measurement, reference)
        except KeyboardInterrupt:
            raise
        except BaseException as error:  # sys.exit() included
            raise LoopError(
                f"loop {name}, step at {float(row['time']):.2f} s: {said(error)}"
            ) from error
        if not isinstance(command, Command):
            raise LoopError(f"loop {name}: step returned {shown(command)}, expected a Command")
        row["thrust_cmd"] = _number(name, "thrust", command.thrust)
        row["load_factor_cmd"] = _number(name, "load_factor", command.load_factor)
        row["bank_angle_cmd"] = _number(name, "bank_angle", command.bank_angle)
        row["load_factor_demand"] = row["load_factor_cmd"]
        row["bank_angle_demand"] = row["bank_angle_cmd"]
        if not isinstance(command.estimates, Mapping):
            raise LoopError(
                f"loop {name}: estimates are {shown(command.estimates)}, expected a mapping"
            )
        for key, value in dict(command.estimates).items():
            if key not in self._writable:
                raise LoopError(
                    f"loop {name}: estimates[{shown(key)}]: expected one of {', '.join(self._writable)}"
                )
            row[key] = _number(name, key, value)


def _number(loop: str, field: str, value: object) -> float:
    """A finite number out of a user's loop.

    Raises:
        LoopError: it is none.
    """
    try:
        number = float(value)  # type: ignore[arg-type]
    except Exception:  # an int beyond all floats; whatever a __float__ raises
        number = math.nan
    if not math.isfinite(number):
        raise LoopError(f"loop {loop}: {field} is {shown(value)}, expected a finite number")
    return number
