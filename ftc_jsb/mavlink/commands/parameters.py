"""The parameters of the vehicle: numbers of the outer loop, and how commands act."""

import math
import re
import struct
from collections.abc import Callable
from typing import NamedTuple

from ftc_jsb.control.records import NO_ESTIMATOR
from ftc_jsb.errors import ScenarioError
from ftc_jsb.loops.built_in import BUILT_IN, tuned_by_sensors
from ftc_jsb.recording.commands import SetLoop
from ftc_jsb.scenario.keys import value_at
from ftc_jsb.scenario.loop import Loop
from ftc_jsb.simulation.steering import changed_loop


class Parameter(NamedTuple):
    """A number with a name of at most 16 capitals."""

    name: str
    unit: str
    meaning: str
    key: str = ""  # in [loop]; else it belongs to the link
    low: float = 0.0  # of the link's own; [loop] has its own ranges
    high: float = 0.0
    default: float = 0.0
    whole: bool = False


TRACKING_GAINS = (
    Parameter("GAIN_SPD", "1/s", "K_c of airspeed", "gains[0]"),
    Parameter("GAIN_FPA", "1/s", "K_c of flight path", "gains[1]"),
    Parameter("GAIN_HDG", "1/s", "K_c of heading", "gains[2]"),
)
INTEGRAL_GAINS = (
    Parameter("GAIN_I_SPD", "1/s^2", "integral gain of airspeed", "integral_gains[0]"),
    Parameter("GAIN_I_FPA", "1/s^2", "of flight path", "integral_gains[1]"),
    Parameter("GAIN_I_HDG", "1/s^2", "of heading", "integral_gains[2]"),
)
PATH_GAINS = (
    Parameter("GAIN_POS", "1/s^2", "path gain of position", "path_gains[0]"),
    Parameter("GAIN_VEL", "1/s", "path gain of velocity", "path_gains[1]"),
)
EVERY_LOOP = (
    Parameter("TRIM_ZETA", "1/s", "trim-input filter (10)", "trim_filter"),
    Parameter(
        "EFF_FLOOR", "1", "least effectiveness that the law divides by", "effectiveness_floor"
    ),
)
DETECTOR = (
    Parameter(
        "DET_MARGIN", "1", "loss that the detector puts down to the models", "detector.margin"
    ),
    Parameter(
        "DET_SIGMAS", "1", "standard deviations that the loss must exceed", "detector.sigmas"
    ),
    Parameter("DET_HOLD", "s", "for so long", "detector.hold"),
)
COVARIANCES = (
    Parameter(
        "UKF_Q_SPD", "(m/s)^2", "process noise of airspeed a step", "estimator.process_noise[0]"
    ),
    Parameter("UKF_Q_FPA", "rad^2", "of flight path", "estimator.process_noise[1]"),
    Parameter("UKF_Q_HDG", "rad^2", "of heading", "estimator.process_noise[2]"),
    Parameter(
        "UKF_Q_EFF", "1", "of the first estimated effectiveness", "estimator.process_noise[3]"
    ),
    Parameter(
        "UKF_R_SPD", "(m/s)^2", "measurement noise of airspeed", "estimator.measurement_noise[0]"
    ),
    Parameter("UKF_R_FPA", "rad^2", "of flight path", "estimator.measurement_noise[1]"),
    Parameter("UKF_R_HDG", "rad^2", "of heading", "estimator.measurement_noise[2]"),
)
RESPONSE_TIME = (
    Parameter("UKF_TIME", "s", "response time of the estimate", "estimator.response_time"),
)
LINK_PARAMETERS = (
    Parameter("SYS_FAILURE_EN", "", "1 lets failures be injected", "", 0.0, 1.0, 0.0, True),
    Parameter("FAIL_EFF", "1", "effectiveness that SLOW leaves", "", 0.0, 1.0, 0.6),
    Parameter("FAIL_DELAY", "s", "by which DELAYED makes a sensor late", "", 0.01, 10.0, 0.5),
    Parameter("SP_SPD_RATE", "m/s^2", "rate of airspeed set-points", "", 0.1, 20.0, 2.0),
    Parameter("SP_FPA_RATE", "deg/s", "rate of flight path set-points", "", 0.05, 5.0, 0.5),
    Parameter("SP_FPA_MAX", "deg", "steepest path to a new altitude", "", 0.5, 30.0, 5.0),
    Parameter("SP_HDG_RATE", "deg/s", "rate of heading set-points", "", 0.1, 20.0, 3.0),
)


def loop_parameters(loop: Loop) -> tuple[Parameter, ...]:
    """Those that act on a loop: none on one of the user's own."""
    kind = BUILT_IN.get(loop.name)
    if kind is None:
        return ()
    found = (PATH_GAINS if kind.path else TRACKING_GAINS) + EVERY_LOOP
    if kind.integral:
        found += INTEGRAL_GAINS
    if kind.estimator != NO_ESTIMATOR:
        tuned = tuned_by_sensors(loop)
        found += DETECTOR + (RESPONSE_TIME if tuned else COVARIANCES)
    return found


class Parameters:
    """The parameters of one flight, in a fixed order."""

    def __init__(self, loop: Loop) -> None:
        """Args: [loop] of the scenario; a loop of the user's own has no numbers to be set."""
        self._loop = loop
        self.all = LINK_PARAMETERS + loop_parameters(loop)
        self._index = {parameter.name: index for index, parameter in enumerate(self.all)}
        self._values = {p.name: p.default for p in self.all if not p.key}

    def restart(self, loop: Loop) -> None:
        """The loop begins anew with its own numbers; the link keeps its."""
        self._loop = loop

    def index_of(self, name: str) -> int | None:
        """Index of a parameter; None where there is none of the name."""
        return self._index.get(name)

    def __getitem__(self, name: str) -> float:
        """Value of a parameter."""
        parameter = self.all[self._index[name]]
        return _loop_number(self._loop, parameter.key) if parameter.key else self._values[name]

    def set(self, name: str, value: float, queue_command: Callable[[SetLoop], None]) -> bool:
        """Set a parameter that exists; what belongs to the loop goes by `queue_command`.

        Returns:
            Whether the value is in range; else nothing is changed.
        """
        parameter = self.all[self._index[name]]
        if not math.isfinite(value):
            return False
        if not parameter.key:
            if not parameter.low <= value <= parameter.high:
                return False
            if parameter.whole and value != round(value):
                return False
            self._values[name] = value
            return True
        change = SetLoop(key=parameter.key, value=value)
        try:
            self._loop = changed_loop(self._loop, change)
        except ScenarioError:
            return False
        queue_command(change)
        return True

    def bound(self, name: str, value: float) -> str:
        """What was expected of a value that `set` has refused."""
        parameter = self.all[self._index[name]]
        if not math.isfinite(value):
            return "expected a number"
        if not parameter.key:
            kind = "whole, " if parameter.whole else ""
            return f"expected {kind}{parameter.low:g} to {parameter.high:g}"
        try:
            changed_loop(self._loop, SetLoop(key=parameter.key, value=value))
        except ScenarioError as error:
            found = re.search(r"(less|greater) than (?:or equal to )?(\S+)", str(error))
            if found:
                return f"expected {'at most' if found[1] == 'less' else 'at least'} {found[2]}"
        return "out of range"


def _loop_number(loop: Loop, key: str) -> float:
    """A number of [loop], such as `gains[0]` or `detector.margin`."""
    return float(value_at(loop.model_dump(), key))


TINIEST = 1e-20  # below it a 32-bit float is no integer, but the bytes of one of up to 2^29


def is_in_bytes(value: float) -> bool:
    """Whether an integer came in the bytes of a 32-bit float, as some stations send it."""
    return math.isfinite(value) and 0.0 < abs(value) < TINIEST


def integer_as_meant(value: float) -> float:
    """An integer that came as a 32-bit float of the same value, or in its bytes."""
    if is_in_bytes(value):
        return float(struct.unpack("<i", struct.pack("<f", value))[0])
    return value


def as_bytes(value: float) -> float:
    """The 32-bit float whose bytes are those of an integer."""
    return float(struct.unpack("<f", struct.pack("<i", round(value)))[0])


def float32_as_meant(value: float) -> float:
    """A number that came as 32-bit float, as its sender meant it: the shortest that is the same."""
    import numpy as np

    return float(str(np.float32(value)))
