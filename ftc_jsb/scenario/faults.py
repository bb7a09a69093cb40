"""[[fault]] of a scenario: what goes wrong, with what, when and how."""

import math
import re
from typing import Literal, Self

from pydantic import Field, model_validator

from ftc_jsb.scenario.types import Bound, Text, Time
from ftc_jsb.typed_file import Section
from ftc_jsb.vocabulary.channels import CHANNELS, ENGINES, SURFACES
from ftc_jsb.vocabulary.signals import ANGLES, SENSED

_FaultKind = Literal[
    "loss-of-effectiveness",
    "flame-out",
    "stuck",
    "hard-over",
    "bias",
    "noise",
    "drift",
    "freeze",
    "dropout",
    "delay",
]


_NEEDS = {  # the number that a kind needs; that of a sensor has the sensor's unit
    "loss-of-effectiveness": "effectiveness",
    "hard-over": "direction",
    "bias": "size",
    "noise": "size",
    "drift": "size",
    "delay": "delay",
}


_RAMPED = ("loss-of-effectiveness", "bias", "noise")


def _kinds_of(target: str) -> tuple[str, ...]:
    """Kinds of fault that a target can have.

    Raises:
        ValueError: there is no such target.
    """
    if target in CHANNELS:
        return ("loss-of-effectiveness",)
    if re.fullmatch(rf"engine\[[0-{ENGINES - 1}]\]", target):
        return ("loss-of-effectiveness", "flame-out", "stuck")
    if target in SURFACES:
        return ("loss-of-effectiveness", "stuck", "hard-over")
    if target in SENSED:
        return ("bias", "noise", "drift", "freeze", "dropout", "delay")
    raise ValueError(
        f"target: no {target!r}; expected a channel ({', '.join(CHANNELS)}), an engine (engine[0], ...), "
        f"a surface ({', '.join(SURFACES)}) or a sensor ({', '.join(SENSED)})"
    )


class Fault(Section):
    """[[fault]]: what goes wrong with a channel, an engine, a control surface or a sensor."""

    target: Text = "thrust"
    kind: _FaultKind = "loss-of-effectiveness"
    effectiveness: float | None = Field(None, ge=0.0, le=1.0)  # that a loss leaves
    direction: Literal[-1, 1] | None = (
        None  # of a hard-over: to the low or the high end of the travel
    )
    size: Bound | None = None  # bias, standard deviation, or drift a second of a sensor
    size_deg: Bound | None = None  # the same of an angle [deg] or an angular rate [deg/s]
    delay: float | None = Field(None, ge=1e-6, le=10.0)  # s
    start: Time  # s
    end: Time | None = None  # s, recovery
    shape: Literal["step", "ramp", "intermittent"] = "step"
    rise: float | None = Field(None, ge=1e-6, le=86400.0)  # s, of a ramp
    fall: float | None = Field(None, ge=1e-6, le=86400.0)  # s from `end` on, in which it goes again
    period: float | None = Field(None, ge=1e-6, le=86400.0)  # s, of an intermittent fault
    duty: float | None = Field(None, ge=1e-6, lt=1.0)  # part of each period that is faulty

    @model_validator(mode="after")
    def _kind_suits_target(self) -> Self:
        kinds = _kinds_of(self.target)
        if self.kind not in kinds:
            raise ValueError(
                f"kind: {self.target!r} cannot have {self.kind!r}; expected one of {', '.join(kinds)}"
            )
        size = "size_deg" if self.target in ANGLES else "size"
        needs = _NEEDS.get(self.kind, "")
        needed = size if needs == "size" else needs
        for key in ("effectiveness", "direction", "size", "size_deg", "delay"):
            given = getattr(self, key) is not None
            if given != (key == needed):
                state = "needs" if key == needed else "does not take"
                hint = f"; it needs {needed!r}" if needed and key != needed else ""
                raise ValueError(f"{self.kind!r} of {self.target!r} {state} the key {key!r}{hint}")
        if self.shape == "ramp" and self.kind not in _RAMPED:
            raise ValueError(f"shape: {self.kind!r} is there or not; it cannot be a ramp")
        return self

    @model_validator(mode="after")
    def _shape_is_complete(self) -> Self:
        needed = {"step": (), "ramp": ("rise",), "intermittent": ("period", "duty")}[self.shape]
        for key in ("rise", "period", "duty"):
            given = getattr(self, key) is not None
            if given != (key in needed):
                state = "needs" if key in needed else "does not take"
                raise ValueError(f"a fault of shape {self.shape!r} {state} the key {key!r}")
        if self.end is not None and self.end <= self.start:
            raise ValueError(f"end must be later than start = {self.start} s")
        if self.fall is not None and (self.end is None or self.shape == "intermittent"):
            raise ValueError("fall: expected a fault with an end that is not intermittent")
        if self.fall is not None and self.kind not in _RAMPED:
            raise ValueError(f"fall: {self.kind!r} is there or not; it cannot go by a ramp")
        return self

    @property
    def value(self) -> float:
        """The number that goes with the kind, in SI and rad; 0 where it has none."""
        if self.size_deg is not None:
            return math.radians(self.size_deg)
        for value in (self.effectiveness, self.direction, self.size, self.delay):
            if value is not None:
                return float(value)
        return 0.0
