"""The campaign file, typed and bounded: what is flown how often, and what varies."""

from typing import Annotated, Any, Literal, Self

from pydantic import Field, model_validator

from ftc_jsb.campaign.dispersion import Dispersion
from ftc_jsb.campaign.manoeuvre import Manoeuvre
from ftc_jsb.scenario.schema import Model
from ftc_jsb.scenario.types import Text
from ftc_jsb.typed_file import Section

MOST_CASES = 10_000_000
Event = Literal["failure", "loss-of-control", "false-alarm", "miss"]
EVENTS: tuple[Event, ...] = ("failure", "loss-of-control", "false-alarm", "miss")
Sampling = Literal["monte-carlo", "latin-hypercube", "sobol", "grid"]
_Names = Annotated[tuple[Text, ...], Field(min_length=1, max_length=64)]
_Confidence = Annotated[float, Field(ge=0.5, le=0.9999)]


class Stop(Section):
    """[stop]: when a campaign ends before all its cases are flown; every given rule must be met."""

    event: Event = "failure"
    interval_width: float | None = Field(None, gt=0.0, lt=1.0)  # of the probability of the event
    rate_per_hour: float | None = Field(
        None, ge=1e-12, le=1e6
    )  # proven: the event is rarer than that
    confidence: _Confidence = 0.95
    every: int = Field(100, ge=1, le=1_000_000)  # cases between two looks


class Search(Section):
    """[search]: how `--search` looks for the worst case."""

    flights: int = Field(200, ge=10, le=1_000_000)  # budget
    objective: Text = "margin"  # the metric that is made small
    method: Literal["cma-es", "differential-evolution", "random"] = "cma-es"
    baseline: bool = True  # as many flights at random, to compare


class Subset(Section):
    """[subset]: the probability of a rare event by subset simulation."""

    samples: int = Field(500, ge=20, le=100_000)  # a level
    level_probability: float = Field(0.1, ge=0.05, le=0.5)
    levels: int = Field(8, ge=1, le=20)  # at most
    objective: Text = "margin"
    threshold: Annotated[float, Field(ge=-1e6, le=1e6)] = 0.0  # the event: the objective is below


class Campaign(Section):
    """A whole campaign file."""

    name: Annotated[str, Field(pattern=r"^[A-Za-z0-9][A-Za-z0-9_.-]*$", max_length=80)]
    title: str = Field("", max_length=300)
    description: str = Field("", max_length=4000)
    scenarios: _Names  # each as likely as the others
    models: Annotated[tuple[Model, ...], Field(min_length=1)] | None = (
        None  # default: the scenario's
    )
    loops: _Names = ("ftc", "no-ftc")  # each flies every case
    cases: int | None = Field(None, ge=1, le=MOST_CASES)  # default: of a grid, all of it
    seed: int = Field(0, ge=0, le=2**31 - 1)
    sampling: Sampling = "latin-hypercube"
    vary_seed: bool = True  # noise and turbulence are others in each case
    overrides: dict[str, Any] = Field(default_factory=dict)  # keys of the scenarios, in every case
    manoeuvre: Manoeuvre | None = None
    dispersion: Annotated[tuple[Dispersion, ...], Field(max_length=100)] = ()
    recordings: Literal["none", "failed", "worst", "all"] = "none"
    worst: int = Field(10, ge=0, le=10_000)  # cases that the report lists, and `recordings` keeps
    roc: bool = False  # the report judges detection
    stop: Stop | None = None
    search: Search = Search()
    subset: Subset | None = None

    @model_validator(mode="after")
    def _whole(self) -> Self:
        for name in ("scenarios", "models", "loops"):
            given = getattr(self, name) or ()
            if len(set(given)) != len(given):
                raise ValueError(f"{name}: an entry is given twice")
        if self.sampling == "grid":
            for index, dispersion in enumerate(self.dispersion):
                if dispersion.points is None and dispersion.values is None:
                    raise ValueError(f"dispersion[{index}].points: a grid needs it")
            if self.grid_size > MOST_CASES:
                raise ValueError(f"a grid of {self.grid_size} cases; expected at most {MOST_CASES}")
        elif self.cases is None:
            raise ValueError("cases: missing, and it has no default but for a grid")
        if (
            self.stop is not None
            and self.stop.interval_width is None
            and self.stop.rate_per_hour is None
        ):
            raise ValueError("stop: expected interval_width, rate_per_hour or both")
        return self

    @property
    def dimensions(self) -> int:
        """Of the unit cube: the scenario, where there are several, and the dispersions."""
        return len(self.dispersion) + (len(self.scenarios) > 1)

    @property
    def grid_size(self) -> int:
        """Cases of the full grid, on every scenario."""
        size = len(self.scenarios)
        for dispersion in self.dispersion:
            size *= grid_levels(dispersion)
        return size

    @property
    def count(self) -> int:
        """Cases to be flown at most."""
        whole = self.grid_size if self.sampling == "grid" else MOST_CASES
        return whole if self.cases is None else min(self.cases, whole)


def grid_levels(dispersion: Dispersion) -> int:
    """Values of a dispersion on a grid."""
    return len(dispersion.values) if dispersion.values is not None else dispersion.points or 1
