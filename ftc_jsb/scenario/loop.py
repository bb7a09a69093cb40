"""[loop] of a scenario: the outer loop, its estimator and its detector."""

from typing import Annotated, Literal, Self

from pydantic import Field, model_validator

from ftc_jsb.scenario.types import Text
from ftc_jsb.typed_file import Section
from ftc_jsb.vocabulary.channels import Channel

_Gain = Annotated[float, Field(ge=0.0, le=100.0)]


_Variance = Annotated[float, Field(ge=1e-30, le=1e6)]


class Estimator(Section):
    """[loop.estimator]: covariances, gate and bounds of the filter."""

    channels: Annotated[tuple[Channel, ...], Field(min_length=1, max_length=3)] = ("thrust",)
    process_noise: tuple[_Variance, ...] = (1e-10, 1e-10, 1e-3, 1e-10)  # Q a step: V, gamma, chi, k
    measurement_noise: tuple[_Variance, _Variance, _Variance] = (1e-10, 1e-10, 1e-3)  # R
    initial_covariance: tuple[_Variance, ...] = (1e-6, 1e-8, 1e-6, 1e-4)  # P0
    spread: float = Field(3.0, ge=0.5, le=10.0)  # n_a + kappa of (26)
    gate: bool = False  # chi-squared gate on the innovations
    gate_probability: float = Field(0.9999, ge=0.9, le=0.9999999)
    gate_patience: int = Field(5, ge=1, le=1000)  # samples in a row that may be refused
    bounded: bool = False  # estimates kept in [sigma, 1]
    tuning: Literal["given", "sensors"] = "given"  # covariances above, or by loops/tuning.py
    accelerometer: bool = False  # the force along the velocity is measured, too
    response_time: float = Field(0.5, ge=0.05, le=60.0)  # s, of the estimate; tuning "sensors" only

    @model_validator(mode="after")
    def _sizes(self) -> Self:
        size = 3 + len(self.channels)
        if len(set(self.channels)) != len(self.channels):
            raise ValueError("channels: a channel is named twice")
        for name in ("process_noise", "initial_covariance"):
            if len(getattr(self, name)) != size:
                raise ValueError(
                    f"{name}: expected {size} numbers: airspeed, flight path angle, heading and "
                    f"one for each of {len(self.channels)} estimated channels"
                )
        return self


class Detector(Section):
    """[loop.detector]: when a loss of effectiveness is declared."""

    margin: float = Field(0.1, ge=0.001, le=0.9)  # loss that is put down to the models
    sigmas: float = Field(4.0, ge=0.0, le=20.0)
    hold: float = Field(0.2, ge=0.0, le=10.0)  # s


class Isolation(Section):
    """[loop.isolation]: whose fault it is, instruments' or the thrust's; excluded ones are replaced."""

    enabled: bool | None = None  # by default in loop `robust`, on an aircraft with measured drag
    false_alarms: float = Field(0.001, ge=1e-6, le=10.0)  # an hour, that the threshold is meant for


class Loop(Section):
    """[loop]: the outer loop, its rate, gains and estimator."""

    name: Text = "ftc"
    rate: float = Field(100.0, ge=1.0, le=1000.0)  # Hz
    gains: tuple[_Gain, _Gain, _Gain] = (1.0, 1.0, 1.0)  # K_c, 1/s
    integral_gains: tuple[_Gain, _Gain, _Gain] = (0.25, 0.25, 0.25)  # 1/s2, loop `integral` only
    path_gains: tuple[_Gain, _Gain] = (0.25, 1.0)  # 1/s2 and 1/s, loop `path` only
    trim_filter: float = Field(50.0, ge=0.5, le=1000.0)  # zeta of (10), 1/s
    # Load factor until bank has come: 0 path and turn alike, 1 path alone; by default by the roll rate
    bank_share: float | None = Field(None, ge=0.0, le=1.0)
    drag_correction: bool = True  # the law pays for drag that is measured beyond its polar
    priority: Literal["speed", "none"] = "speed"  # where thrust cannot pay for the manoeuvre
    # m/s that is spent before climb and turn are given up; by default 5 with `robust`, else 0
    airspeed_reserve: float | None = Field(None, ge=0.0, le=100.0)
    effectiveness_floor: float = Field(0.05, ge=0.001, le=0.5)  # sigma
    feedback: Literal["measured", "estimated"] = "measured"  # what the tracking errors are taken of
    lead_filter: float = Field(50.0, ge=0.5, le=1000.0)  # 1/s, of the rate that the lead takes
    response_lead: bool = True  # lead against the identified lag of load factor and bank
    estimator: Estimator = Estimator()
    detector: Detector = Detector()
    isolation: Isolation = Isolation()
