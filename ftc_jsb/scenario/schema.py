"""The scenario file, typed and bounded: every key, its unit and its default.

Angles are in degrees in the file (`_deg`) and in radians everywhere else; `reference.py` and
`simulation/` convert.
"""

import math
import re
from typing import Annotated, Literal, Self

from pydantic import Field, model_validator

from ftc_jsb.disturbance.signals import ANGLES, SENSED
from ftc_jsb.typed_file import Section

Model = Literal["paper", "identified", "jsbsim"]
Channel = Literal["thrust", "load_factor", "bank_angle"]
CHANNELS: tuple[Channel, ...] = ("thrust", "load_factor", "bank_angle")
ENGINES = 4  # the most that an aircraft may have
SURFACES: tuple[str, ...] = ("elevator", "aileron", "rudder")

_Text = Annotated[str, Field(min_length=1, max_length=300)]
_Time = Annotated[float, Field(ge=0.0, le=86400.0)]  # s
_Point = tuple[_Time, Annotated[float, Field(ge=-1e6, le=1e6)]]
_Breakpoints = Annotated[tuple[_Point, ...], Field(min_length=1, max_length=10000)]
_Gain = Annotated[float, Field(ge=0.0, le=100.0)]
_Variance = Annotated[float, Field(gt=0.0, le=1e6)]
_Error = Annotated[float, Field(ge=0.0, le=1e4)]
_Bound = Annotated[float, Field(ge=-1e6, le=1e6)]

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


LONGEST_RECORDING = 4_000_000  # samples: 11 h at 100 Hz, about 3 GB


class AircraftChoice(Section):
    """[aircraft]: flown by the models `identified` and `jsbsim`."""

    name: _Text = "f16"
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


class Reference(Section):
    """[reference]: breakpoints [time s, value], linear between and held outside; command filter."""

    filter_frequency: float = Field(3.0, ge=0.05, le=50.0)  # rad/s
    filter_damping: float = Field(1.0, ge=0.1, le=5.0)
    airspeed: _Breakpoints  # m/s
    flight_path_deg: _Breakpoints
    heading_deg: _Breakpoints

    @model_validator(mode="after")
    def _in_range(self) -> Self:
        bounds = {
            "airspeed": (50.0, 600.0),
            "flight_path_deg": (-60.0, 60.0),
            "heading_deg": (-36000.0, 36000.0),
        }
        for name, (low, high) in bounds.items():
            points: tuple[_Point, ...] = getattr(self, name)
            times = [time for time, _ in points]
            if times != sorted(set(times)):
                raise ValueError(f"reference.{name}: times must increase from point to point")
            for time, value in points:
                if not low <= value <= high:
                    raise ValueError(
                        f"reference.{name}: {value} at {time} s is outside [{low:g}, {high:g}]"
                    )
        return self


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
    tuning: Literal["given", "sensors"] = "given"  # covariances above, or by control/tuning.py
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


class Loop(Section):
    """[loop]: the outer loop, its rate, gains and estimator."""

    name: _Text = "ftc"
    rate: float = Field(100.0, ge=1.0, le=1000.0)  # Hz
    gains: tuple[_Gain, _Gain, _Gain] = (1.0, 1.0, 1.0)  # K_c, 1/s
    integral_gains: tuple[_Gain, _Gain, _Gain] = (0.25, 0.25, 0.25)  # 1/s2, loop `integral` only
    path_gains: tuple[_Gain, _Gain] = (0.25, 1.0)  # 1/s2 and 1/s, loop `path` only
    trim_filter: float = Field(50.0, ge=0.5, le=1000.0)  # zeta of (10), 1/s
    bank_share: float = Field(0.5, ge=0.0, le=1.0)  # load factor for the bank that is there
    drag_correction: bool = True  # the law pays for drag that is measured beyond its polar
    priority: Literal["speed", "none"] = "speed"  # where thrust cannot pay for the manoeuvre
    effectiveness_floor: float = Field(0.05, ge=0.001, le=0.5)  # sigma
    feedback: Literal["measured", "estimated"] = "measured"  # what the tracking errors are taken of
    lead_filter: float = Field(50.0, ge=0.5, le=1000.0)  # 1/s, of the rate that the lead takes
    response_lead: bool = True  # lead against the identified lag of load factor and bank
    estimator: Estimator = Estimator()
    detector: Detector = Detector()


class Fault(Section):
    """[[fault]]: what goes wrong with a channel, an engine, a control surface or a sensor."""

    target: _Text = "thrust"
    kind: _FaultKind = "loss-of-effectiveness"
    effectiveness: float | None = Field(None, ge=0.0, le=1.0)  # that a loss leaves
    direction: Literal[-1, 1] | None = (
        None  # of a hard-over: to the low or the high end of the travel
    )
    size: _Bound | None = None  # bias, standard deviation, or drift a second of a sensor
    size_deg: _Bound | None = None  # the same of an angle [deg] or an angular rate [deg/s]
    delay: float | None = Field(None, gt=0.0, le=10.0)  # s
    start: _Time  # s
    end: _Time | None = None  # s, recovery
    shape: Literal["step", "ramp", "intermittent"] = "step"
    rise: float | None = Field(None, gt=0.0, le=86400.0)  # s, of a ramp
    period: float | None = Field(None, gt=0.0, le=86400.0)  # s, of an intermittent fault
    duty: float | None = Field(None, gt=0.0, lt=1.0)  # part of each period that is faulty

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


class Sensor(Section):
    """[sensors.SIGNAL]: what is not given is the profile's. Angles and rates take the `_deg` keys."""

    noise: _Error | None = None  # standard deviation, in the signal's unit
    noise_deg: _Error | None = None
    bias: _Bound | None = None  # the same in every flight
    bias_deg: _Bound | None = None
    bias_spread: _Error | None = None  # standard deviation of a bias drawn for each flight
    bias_spread_deg: _Error | None = None
    rate: float | None = Field(None, gt=0.0, le=1000.0)  # Hz: readings in between are held
    delay: float | None = Field(None, ge=0.0, le=2.0)  # s


class Sensors(Section):
    """[sensors]: what the outer loop sees of the aircraft."""

    profile: Literal["perfect", "tactical"] = "perfect"
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


class Gust(Section):
    """[[wind.gust]]: a discrete gust, 1 - cosine up over `length`, held, and down again."""

    speed: float = Field(0.0, ge=0.0, le=100.0)  # m/s, level part
    from_deg: float = Field(270.0, ge=0.0, le=360.0)
    updraught: float = Field(0.0, ge=-100.0, le=100.0)  # m/s
    start: _Time  # s
    length: float = Field(gt=0.0, le=600.0)  # s
    hold: float = Field(0.0, ge=0.0, le=3600.0)  # s


class Wind(Section):
    """[wind]: steady wind at the initial altitude, shear, gusts, turbulence."""

    speed: float = Field(0.0, ge=0.0, le=100.0)  # m/s
    from_deg: float = Field(270.0, ge=0.0, le=360.0)
    shear: float = Field(0.0, ge=-0.1, le=0.1)  # 1/s: m/s more for each metre up
    turbulence: Literal["none", "light", "moderate", "severe"] = "none"  # MIL-F-8785C
    gust: Annotated[tuple[Gust, ...], Field(max_length=8)] = ()


class Simulation(Section):
    """[simulation]: how finely the plants are integrated inside a sample of the outer loop."""

    jsbsim_steps: int = Field(2, ge=1, le=100)  # JSBSim frames a sample: 200 Hz at 100 Hz
    # Runge-Kutta steps a sample; by default 2.5 ms long, 10 ms where nothing lags and no wind changes
    point_mass_steps: int | None = Field(None, ge=1, le=1000)
    record_every: int = Field(1, ge=1, le=10000)  # samples a row of the saved recording


_Range = tuple[_Bound, _Bound]


class Limits(Section):
    """[limits]: [low, high]; a flight that leaves one fails."""

    airspeed: _Range | None = None  # m/s
    altitude: _Range | None = None  # m
    load_factor: _Range | None = None
    bank_deg: _Range | None = None
    flight_path_deg: _Range | None = None
    alpha_deg: _Range | None = None
    sideslip_deg: _Range | None = None
    mach: _Range | None = None
    error_airspeed: _Range | None = None  # m/s
    error_flight_path_deg: _Range | None = None
    error_heading_deg: _Range | None = None

    @model_validator(mode="after")
    def _ordered(self) -> Self:
        for name in type(self).model_fields:
            bounds = getattr(self, name)
            if bounds is not None and bounds[0] >= bounds[1]:
                raise ValueError(f"limits.{name}: low must be less than high (got {list(bounds)})")
        return self


class Compare(Section):
    """[compare]: what `compare` flies."""

    models: Annotated[tuple[Model, ...], Field(min_length=1)] = ("paper", "identified", "jsbsim")
    loops: Annotated[tuple[_Text, ...], Field(min_length=1)] = ("ftc", "no-ftc")

    @model_validator(mode="after")
    def _distinct(self) -> Self:
        for name in ("models", "loops"):
            if len(set(getattr(self, name))) != len(getattr(self, name)):
                raise ValueError(f"compare.{name}: an entry is given twice")
        return self


class Scenario(Section):
    """A whole scenario file."""

    name: Annotated[str, Field(pattern=r"^[A-Za-z0-9][A-Za-z0-9_.-]*$", max_length=80)]
    title: str = Field("", max_length=300)
    description: str = Field("", max_length=4000)
    duration: float = Field(60.0, gt=0.0, le=86400.0)  # s
    model: Model = "paper"
    seed: int = Field(0, ge=0, le=2**31 - 1)
    aircraft: AircraftChoice = AircraftChoice()
    initial: Initial = Initial()
    reference: Reference
    loop: Loop = Loop()
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
