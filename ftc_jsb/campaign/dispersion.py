"""[[dispersion]] of a campaign: how one or several keys of a scenario vary from case to case."""

import math
from typing import Annotated, Any, Literal, Self

import numpy as np
from pydantic import Field, model_validator
from scipy.special import log_ndtr, ndtr, ndtri, ndtri_exp

from ftc_jsb.scenario.types import Text
from ftc_jsb.typed_file import Section

_Number = Annotated[float, Field(ge=-1e9, le=1e9)]
_Positive = Annotated[float, Field(ge=1e-12, le=1e9)]

_LARGEST = 2**1000  # integer: beyond it, none of any key's

_NEEDS: dict[str, tuple[str, ...]] = {
    "uniform": ("low", "high"),
    "log-uniform": ("low", "high"),
    "normal": ("mean", "deviation"),
    "truncated-normal": ("mean", "deviation", "low", "high"),
    "choice": ("values",),
}
_TAKES = {"choice": ("labels", "weights")}


class Dispersion(Section):
    """[[dispersion]]: the keys, and the distribution of the one value that they all get."""

    key: Text | Annotated[tuple[Text, ...], Field(min_length=1, max_length=16)]
    distribution: Literal["uniform", "log-uniform", "normal", "truncated-normal", "choice"]
    low: _Number | None = None
    high: _Number | None = None
    mean: _Number | None = None
    deviation: _Positive | None = None  # standard deviation, of the normal before it is truncated
    values: Annotated[tuple[Any, ...], Field(min_length=1, max_length=10000)] | None = None
    labels: tuple[Text, ...] | None = None  # names of the values in results
    weights: tuple[_Positive, ...] | None = None  # of the values; by default all the same
    apply: Literal["replace", "scale", "add"] = "replace"  # what is done to the scenario's value
    points: int | None = Field(None, ge=1, le=10000)  # of a grid; a choice has its values
    when: dict[str, Annotated[tuple[Any, ...], Field(min_length=1)]] = Field(default_factory=dict)

    @model_validator(mode="after")
    def _complete(self) -> Self:
        needed = _NEEDS[self.distribution]
        taken = needed + _TAKES.get(self.distribution, ())
        for key in ("low", "high", "mean", "deviation", "values", "labels", "weights"):
            given = getattr(self, key) is not None
            if key in needed and not given:
                raise ValueError(f"the distribution {self.distribution!r} needs the key {key!r}")
            if given and key not in taken:
                raise ValueError(f"{key}: the distribution {self.distribution!r} does not take it")
        if self.low is not None and self.high is not None and self.low >= self.high:
            raise ValueError(f"low must be less than high (got {self.low:g} and {self.high:g})")
        if self.distribution == "log-uniform" and (self.low or 0.0) <= 0.0:
            raise ValueError(
                f"low: a log-uniform distribution is of positive numbers (got {self.low:g})"
            )
        for key in ("labels", "weights"):
            given = getattr(self, key)
            if given is not None and len(given) != len(self.values or ()):
                raise ValueError(f"{key}: expected one for each of {len(self.values or ())} values")
        if self.labels is not None and len(set(self.labels)) != len(self.labels):
            raise ValueError("labels: a label is given twice")
        return self

    @model_validator(mode="after")
    def _applicable(self) -> Self:
        if self.apply != "replace" and self.distribution == "choice":
            wrong = [value for value in self.values or () if not is_number(value)]
            if wrong:
                raise ValueError(f"values: only numbers can {self.apply} (got {wrong[0]!r})")
        return self

    @property
    def keys(self) -> tuple[str, ...]:
        """Dotted keys of the scenario that get the value."""
        return (self.key,) if isinstance(self.key, str) else self.key

    @property
    def parameter(self) -> str:
        """The name of the value in results: its first key."""
        return self.keys[0]

    def index(self, unit: float) -> int:
        """Of a choice: which of its values stands at `unit` in [0, 1]."""
        values = self.values or ()
        if self.weights is None:
            return min(int(unit * len(values)), len(values) - 1)
        reached, total = 0.0, math.fsum(self.weights)
        for index, weight in enumerate(self.weights):
            reached += weight / total
            if unit < reached:
                return index
        return len(values) - 1

    def value(self, unit: float) -> Any:
        """Quantile of the distribution at `unit` in [0, 1]."""
        if self.distribution == "choice":
            return (self.values or ())[self.index(unit)]
        low, high = self.low or 0.0, self.high or 0.0
        if self.distribution == "uniform":
            return low + (high - low) * unit
        if self.distribution == "log-uniform":
            return math.exp(math.log(low) + math.log(high / low) * unit)
        mean, deviation = self.mean or 0.0, self.deviation or 0.0
        if self.distribution == "truncated-normal":
            ends = (low - mean) / deviation, (high - mean) / deviation
            return min(max(mean + deviation * _truncated_quantile(*ends, unit), low), high)
        quantile = mean + deviation * float(ndtri(1e-12 + (1.0 - 2e-12) * unit))  # finite
        return min(max(quantile, mean - 7.0 * deviation), mean + 7.0 * deviation)

    def shown(self, unit: float) -> Any:
        """The value as results have it: a number, or a text."""
        if self.labels is not None:
            return self.labels[self.index(unit)]
        value = self.value(unit)
        return float(value) if all(map(is_number, self.values or ())) else str(value)


def _log(value: float) -> float:
    return math.log(value) if value > 0.0 else -math.inf


def _truncated_quantile(low: float, high: float, unit: float) -> float:
    """Quantile of the standard normal within [low, high]; beyond 1 on one side by the tail's logarithms."""
    if high < -1.0:
        tails = log_ndtr(low) + _log(1.0 - unit), log_ndtr(high) + _log(unit)
        return float(ndtri_exp(np.logaddexp(*tails)))
    if low > 1.0:
        return -_truncated_quantile(-high, -low, 1.0 - unit)
    below, above = float(ndtr(low)), float(ndtr(high))
    return float(ndtri(below + (above - below) * unit))


def is_number(value: Any) -> bool:
    """Whether a value of a TOML file is a number that a float holds."""
    if isinstance(value, bool) or not isinstance(value, int | float):
        return False
    return isinstance(value, float) or abs(value) <= _LARGEST
