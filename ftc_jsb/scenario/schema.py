"""The scenario file, typed and bounded: every key, its unit and its default.

Angles are in degrees here as in the file (`_deg`), and in radians in every kernel. What a section
becomes is converted where it is made: references in `reference.py`, sizes of sensor faults in
`faults.py`, wind and sensors in `disturbance/`, the initial condition in the plants.
"""

from typing import Annotated, Literal, Self

from pydantic import BeforeValidator, Field, model_validator

from ftc_jsb.scenario.faults import Fault
from ftc_jsb.scenario.limits import Limits
from ftc_jsb.scenario.loop import Loop
from ftc_jsb.scenario.model_error import ModelError
from ftc_jsb.scenario.reference import Reference
from ftc_jsb.scenario.sensors import Sensors
from ftc_jsb.scenario.types import Text
from ftc_jsb.scenario.wind import Wind
from ftc_jsb.typed_file import Section

Model = Literal["paper", "identified", "jsbsim", "flightgear"]
FlownHere = Literal["paper", "identified", "jsbsim"]


TITLE_LENGTH, DESCRIPTION_LENGTH = 300, 4000  # characters
LONGEST_RECORDING = 4_000_000  # samples: 11 h at 100 Hz, about 3 GB


def _as_text(name: object) -> object:
    """A name that TOML reads as a number, such as 737, as text."""
    return str(name) if isinstance(name, int) and not isinstance(name, bool) else name


class AircraftChoice(Section):
    """[aircraft]: flown by the models `identified` and `jsbsim`."""

    name: Annotated[Text, BeforeValidator(_as_text)] = "f16"
    flight_control: Literal["corrected", "stock"] = "corrected"
    fuel_fraction: float = Field(0.43, ge=0.0, le=1.0)  # of internal fuel


class Initial(Section):
    """[initial]: trimmed flight at the start, and the origin of the tangent plane."""

    airspeed: float = Field(300.0, ge=50.0, le=600.0)  # m/s
    altitude: float = Field(3048.0, ge=100.0, le=18000.0)  # m
    flight_path_deg: float = Field(0.0, ge=-30.0, le=30.0)
    heading_deg: float = Field(0.0, ge=-360.0, le=360.0)
    latitude_deg: float = Field(47.0, ge=-89.0, le=89.0)
    longitude_deg: float = Field(8.0, ge=-180.0, le=180.0)


class Simulation(Section):
    """[simulation]: how finely the plants are integrated inside a sample of the outer loop."""

    jsbsim_steps: int = Field(2, ge=1, le=100)  # JSBSim frames a sample: 200 Hz at 100 Hz
    # Runge-Kutta steps a sample; by default 2.5 ms long, 10 ms where nothing lags and no wind changes
    point_mass_steps: int | None = Field(None, ge=1, le=1000)
    record_every: int = Field(1, ge=1, le=10000)  # samples a row of the saved recording


class Agreement(Section):
    """[compare.agreement]: RMS differences up to which a point mass and the 6-DOF aircraft agree."""

    airspeed: float = Field(0.3, ge=1e-9, le=1e3)  # m/s
    flight_path_deg: float = Field(0.1, ge=1e-9, le=90.0)
    heading_deg: float = Field(0.2, gt=0.0, le=180.0)
    position: float = Field(25.0, ge=1e-9, le=1e6)  # m


class Compare(Section):
    """[compare]: what `compare` flies."""

    models: Annotated[tuple[FlownHere, ...], Field(min_length=1)] = (
        "paper",
        "identified",
        "jsbsim",
    )
    loops: Annotated[tuple[Text, ...], Field(min_length=1)] = ("ftc", "no-ftc")
    agreement: Agreement = Agreement()

    @model_validator(mode="after")
    def _distinct(self) -> Self:
        for name in ("models", "loops"):
            if len(set(getattr(self, name))) != len(getattr(self, name)):
                raise ValueError(f"compare.{name}: an entry is given twice")
        return self


class Scenario(Section):
    """A whole scenario file."""

    name: Annotated[str, Field(pattern=r"^[A-Za-z0-9][A-Za-z0-9_.-]*$", max_length=80)]
    title: str = Field("", max_length=TITLE_LENGTH)
    description: str = Field("", max_length=DESCRIPTION_LENGTH)
    duration: float = Field(60.0, gt=0.0, le=86400.0)  # s
    model: Model = "paper"
    seed: int = Field(0, ge=0, le=2**31 - 1)
    aircraft: AircraftChoice = AircraftChoice()
    initial: Initial = Initial()
    reference: Reference
    loop: Loop = Loop()
    model_error: ModelError = ModelError()
    fault: Annotated[tuple[Fault, ...], Field(max_length=16)] = ()
    sensors: Sensors = Sensors()
    wind: Wind = Wind()
    simulation: Simulation = Simulation()
    limits: Limits = Limits()
    compare: Compare = Compare()

    @model_validator(mode="after")
    def _whole(self) -> Self:
        samples = self.duration * self.loop.rate
        if not 2 <= samples <= LONGEST_RECORDING:
            raise ValueError(
                f"duration x loop.rate: {samples:g} samples; expected 2 to {LONGEST_RECORDING}"
            )
        turn = self.reference.heading_deg[0][1] - self.initial.heading_deg
        if abs(turn) > 180.0:
            raise ValueError(
                f"reference.heading_deg: starts {turn:g} deg from initial.heading_deg; heading is "
                "continuous and never wrapped: 10 deg seen from 350 is 370"
            )
        return self

    @property
    def samples(self) -> int:
        """Number of control periods of the flight."""
        return round(self.duration * self.loop.rate)
