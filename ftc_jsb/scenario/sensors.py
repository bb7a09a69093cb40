"""[sensors] of a scenario: what the outer loop sees of the aircraft."""

from typing import Literal, Self

from pydantic import Field, model_validator

from ftc_jsb.scenario.types import Bound, Error
from ftc_jsb.typed_file import Section
from ftc_jsb.vocabulary.signals import ANGLES, SENSED


class Sensor(Section):
    """[sensors.SIGNAL]: what is not given is the profile's. Angles and rates take the `_deg` keys."""

    noise: Error | None = None  # standard deviation, in the signal's unit
    noise_deg: Error | None = None
    bias: Bound | None = None  # the same in every flight
    bias_deg: Bound | None = None
    bias_spread: Error | None = None  # standard deviation of a bias drawn for each flight
    bias_spread_deg: Error | None = None
    rate: float | None = Field(None, gt=0.0, le=1000.0)  # Hz: readings in between are held
    delay: float | None = Field(None, ge=0.0, le=2.0)  # s


class Sensors(Section):
    """[sensors]: what the outer loop sees of the aircraft."""

    profile: Literal["perfect", "tactical"] = "perfect"
    inner_loop: bool | None = None  # whether it reads them, too; by default with `tactical`
    airspeed: Sensor | None = None  # m/s
    altitude: Sensor | None = None  # m
    alpha: Sensor | None = None
    sideslip: Sensor | None = None
    roll: Sensor | None = None
    pitch: Sensor | None = None
    yaw: Sensor | None = None
    roll_rate: Sensor | None = None
    pitch_rate: Sensor | None = None
    yaw_rate: Sensor | None = None
    load_factor_x: Sensor | None = None  # g
    load_factor_y: Sensor | None = None
    load_factor_z: Sensor | None = None
    north: Sensor | None = None  # m
    east: Sensor | None = None
    elevator_position: Sensor | None = None
    flap_position: Sensor | None = None
    aileron_position: Sensor | None = None
    rudder_position: Sensor | None = None

    @property
    def reach_inner_loop(self) -> bool:
        """Whether the inner loop of the 6-DOF aircraft reads what is measured, or the truth."""
        return self.profile == "tactical" if self.inner_loop is None else self.inner_loop

    @model_validator(mode="after")
    def _units(self) -> Self:
        for name in SENSED:
            sensor: Sensor | None = getattr(self, name)
            for key in ("noise", "bias", "bias_spread") if sensor is not None else ():
                wrong = key if name in ANGLES else f"{key}_deg"
                if getattr(sensor, wrong) is not None:
                    right = f"{key}_deg" if name in ANGLES else key
                    raise ValueError(f"{name}.{wrong}: expected {right} for this signal")
        return self
