"""The registry of outer loops, and what makes each flyable on a recording."""

import importlib
import math
import sys
from collections.abc import Callable
from importlib.metadata import entry_points
from pathlib import Path
from typing import Any, NamedTuple, Protocol

import numpy as np
import numpy.typing as npt

from ftc_jsb.compiled import direct
from ftc_jsb.control.outer_loop import (
    ASSUMED_HEALTHY,
    ESTIMATED,
    EXTENDED,
    LOOP_SETTINGS,
    LOOP_STATE,
    NO_ESTIMATOR,
    TRUE,
    UNSCENTED,
    outer_loop_step,
)
from ftc_jsb.control.protocol import Command, LoopSetup, Measurement, OuterLoop, Reference
from ftc_jsb.disturbance.faults import CHANNELS
from ftc_jsb.errors import LoopError
from ftc_jsb.scenario.schema import Loop


class Kind(NamedTuple):
    """What makes one built-in loop differ from another."""

    meaning: str
    estimator: int = UNSCENTED
    effectiveness: int = ESTIMATED  # where the law takes it from
    integral: bool = False
    path: bool = False  # tracks position


BUILT_IN = {
    "ftc": Kind("the paper's: UKF estimate in the law (20)"),
    "no-ftc": Kind(
        "same law and filter, effectiveness 1 in the law", effectiveness=ASSUMED_HEALTHY
    ),
    "oracle": Kind("the true effectiveness in the law", effectiveness=TRUE),
    "integral": Kind("no estimator, integral action", NO_ESTIMATOR, ASSUMED_HEALTHY, integral=True),
    "ekf": Kind("as ftc, with an extended Kalman filter", EXTENDED),
    "path": Kind("as ftc, tracking position: the path that the references make", path=True),
}
ENTRY_POINTS = "ftc_jsb.loops"


class RecordedLoop(Protocol):
    """A loop bound to a recording."""

    def step(self, i: int) -> None:
        """Read row `i` and write the commands of that sample there."""


class CompiledLoop:
    """One of the built-in loops: the compiled kernel with its settings."""

    def __init__(
        self, name: str, loop: Loop, model: npt.NDArray[Any], dt: float, record: npt.NDArray[Any]
    ) -> None:
        """Args: name in BUILT_IN; [loop]; (1,) MODEL; sample time [s]; recording."""
        self.settings = loop_settings(name, loop, model, dt)
        self.state = np.zeros(1, LOOP_STATE)
        filters = self.state[0]["filter"]
        filters["count"] = 3 + len(loop.estimator.channels)
        for index, channel in enumerate(loop.estimator.channels):
            filters["channel"][index] = CHANNELS.index(channel)
        self._model = model
        self._record = record
        self._step = direct(outer_loop_step, self.settings, model, self.state, record, 0)

    def step(self, i: int) -> None:
        """One sample."""
        self._step(self.settings, self._model, self.state, self._record, i)


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
        except Exception as error:
            raise LoopError(
                f"loop {name}, step at {float(row['time']):.2f} s: {type(error).__name__}: {error}"
            ) from error
        if not isinstance(command, Command):
            raise LoopError(f"loop {name}: step returned {command!r}, expected a Command")
        row["thrust_cmd"] = _number(name, "thrust", command.thrust)
        row["load_factor_cmd"] = _number(name, "load_factor", command.load_factor)
        row["bank_angle_cmd"] = _number(name, "bank_angle", command.bank_angle)
        row["load_factor_demand"] = row["load_factor_cmd"]
        row["bank_angle_demand"] = row["bank_angle_cmd"]
        row["thrust_saturated"] = row["load_factor_saturated"] = row["outside_range"] = 0.0
        for key, value in command.estimates.items():
            if key not in self._writable:
                raise LoopError(
                    f"loop {name}: estimates[{key!r}]: expected one of {', '.join(self._writable)}"
                )
            row[key] = _number(name, key, value)


def _number(loop: str, field: str, value: object) -> float:
    """A finite number out of a user's loop.

    Raises:
        LoopError: it is none.
    """
    try:
        number = float(value)  # type: ignore[arg-type]
    except (TypeError, ValueError):
        number = math.nan
    if not math.isfinite(number):
        raise LoopError(f"loop {loop}: {field} is {value!r}, expected a finite number")
    return number


def loop_settings(name: str, loop: Loop, model: npt.NDArray[Any], dt: float) -> npt.NDArray[Any]:
    """[loop] of a scenario as (1,) LOOP_SETTINGS of the built-in loop `name`."""
    kind = BUILT_IN[name]
    estimator, detector = loop.estimator, loop.detector
    settings = np.zeros(1, LOOP_SETTINGS)
    s = settings[0]
    s["dt"] = dt
    s["estimator"] = kind.estimator
    s["effectiveness"] = kind.effectiveness
    s["gains"] = loop.gains
    s["integral_gains"] = loop.integral_gains if kind.integral else 0.0
    s["track_path"] = kind.path
    s["path_gains"] = loop.path_gains
    s["trim_filter"] = loop.trim_filter
    s["effectiveness_floor"] = loop.effectiveness_floor
    if loop.response_lead:
        for axis in range(2):  # a second-order lag is late by 2 z / w
            frequency = model[0]["response_frequency"][axis]
            if frequency > 0.0:
                s["lead"][axis] = 2.0 * model[0]["response_damping"][axis] / frequency
    size = len(estimator.process_noise)
    s["process_noise"][:size] = estimator.process_noise
    s["measurement_noise"] = estimator.measurement_noise
    s["initial_covariance"][:size] = estimator.initial_covariance
    s["spread"] = estimator.spread
    if estimator.gate:
        from scipy.stats import chi2

        s["gate"] = chi2.ppf(estimator.gate_probability, df=3)
        s["gate_patience"] = estimator.gate_patience
    s["bounded"] = estimator.bounded
    s["detector_margin"] = detector.margin
    s["detector_sigmas"] = detector.sigmas
    s["detector_hold"] = detector.hold
    return settings


def loop_names() -> dict[str, str]:
    """Name and description of every loop: built in, and installed by entry point."""
    names = {name: kind.meaning for name, kind in BUILT_IN.items()}
    for point in entry_points(group=ENTRY_POINTS):
        names[point.name] = f"installed: {point.value}"
    return names


def build_loop(setup: LoopSetup, model: npt.NDArray[Any], record: npt.NDArray[Any]) -> RecordedLoop:
    """The loop `setup.settings.name`, bound to a recording.

    Raises:
        LoopError: unknown, cannot be imported, or refuses its settings.
    """
    name = setup.settings.name
    if name in BUILT_IN:
        return CompiledLoop(name, setup.settings, model, setup.dt, record)
    loop = find_loop(name)
    try:
        return PythonLoop(loop(setup), record)
    except LoopError:
        raise
    except Exception as error:
        raise LoopError(
            f"loop {name!r} cannot be built: {type(error).__name__}: {error}"
        ) from error


def find_loop(name: str) -> Callable[[LoopSetup], OuterLoop]:
    """Class of a loop that is not built in: an entry point, or `package.module:Class`.

    Modules are searched for in the working folder, too.

    Raises:
        LoopError: there is none.
    """
    for point in entry_points(group=ENTRY_POINTS, name=name):
        loaded: Callable[[LoopSetup], OuterLoop] = point.load()
        return loaded
    module_name, colon, class_name = name.partition(":")
    if not colon or not module_name or not class_name:
        raise LoopError(
            f"loop.name: no loop {name!r}; expected one of {', '.join(loop_names())}, "
            "or package.module:Class"
        )
    if str(Path.cwd()) not in sys.path:
        sys.path.append(str(Path.cwd()))
    try:
        module = importlib.import_module(module_name)
    except Exception as error:  # whatever a user's module does when it is imported
        raise LoopError(
            f"loop.name: {name!r}: cannot import {module_name!r}: {type(error).__name__}: {error}"
        ) from None
    try:
        found: Callable[[LoopSetup], OuterLoop] = getattr(module, class_name)
    except AttributeError:
        raise LoopError(f"loop.name: {name!r}: {module_name!r} has no {class_name!r}") from None
    return found
