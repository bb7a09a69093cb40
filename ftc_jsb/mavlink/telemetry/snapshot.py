"""What the messages are made of: one row of a recording, with position, attitude and thrust limits."""

import math
from enum import Enum
from typing import Any, NamedTuple

import numpy.typing as npt

from ftc_jsb.compiled import direct
from ftc_jsb.frames import body_rates
from ftc_jsb.mavlink.telemetry.geodesy import Origin
from ftc_jsb.point_mass.model import thrust_limits
from ftc_jsb.scenario.schema import Scenario
from ftc_jsb.simulation.assembly import point_mass_of
from ftc_jsb.vocabulary.signals import SENSED

Angles = tuple[float, float, float]

LARGEST_PLAUSIBLE = (
    1e12  # in any unit: a number beyond it is of a flight that is lost, and sent as unknown
)


class Phase(Enum):
    """Where a flight is, as ground stations see it."""

    WAITING = "waiting"  # not yet begun
    FLYING = "flying"
    PAUSED = "paused"
    OVER = "over"  # complete or ended by command
    LOST = "lost"  # departed, failed or interrupted


class LinkHealth(NamedTuple):
    """What SYS_STATUS tells of the link itself."""

    load: float = 0.0  # share of the last sample's time that the flight took
    overruns: int = 0  # samples that began late
    clamped: int = 0  # values that did not fit their field
    unsent: int = 0  # frames that no peer took
    refused: int = 0  # frames that were not understood or not trusted


class Snapshot(NamedTuple):
    """A vehicle at one sample, SI and rad."""

    phase: Phase
    health: LinkHealth
    unix: float  # [s]
    row: dict[str, float]  # of the recording; empty while waiting
    attitude: Angles  # roll, pitch, yaw [rad]
    rates: Angles  # about the axes of the body [rad/s]
    thrust_idle: float  # [N]
    thrust_maximum: float  # [N]
    origin: Origin  # of north and east
    critical: bool = False  # whether a limit is broken, or control lost

    def silent(self, *signals: str) -> bool:
        """Whether a signal that the aircraft has gives no reading."""
        return any(
            math.isfinite(self.row.get(name, math.nan)) and math.isnan(self.row[f"{name}_meas"])
            for name in signals
        )

    def failed(self, *signals: str) -> bool:
        """Whether one of these signals is silent, or excluded: isolation lets something stand in for it."""
        excluded = self.row.get("excluded", 0.0)
        bits = int(excluded) if math.isfinite(excluded) else 0  # a loop without isolation has none
        return self.silent(*signals) or any(bits >> SENSED.index(name) & 1 for name in signals)

    @property
    def in_flight(self) -> bool:
        """Whether it flies or is paused."""
        return self.phase in (Phase.FLYING, Phase.PAUSED)

    @property
    def time_boot_ms(self) -> float:
        """Time of flight [ms]; 0 while waiting."""
        return 1e3 * self.row.get("time", 0.0)

    @property
    def time_usec(self) -> float:
        """Time of flight [us]; 0 while waiting."""
        return 1e6 * self.row.get("time", 0.0)


class SnapshotBuilder:
    """Makes snapshots of rows of the recordings of one scenario."""

    def __init__(self, scenario: Scenario) -> None:
        """Builds what a snapshot needs, kernels included: none is compiled in flight."""
        initial = scenario.initial
        self._origin = (initial.latitude_deg, initial.longitude_deg, initial.altitude)
        self._model = point_mass_of(scenario).record(scenario.aircraft.fuel_fraction)
        self._dt = 1.0 / scenario.loop.rate
        self._rates = direct(body_rates, (0.0, 0.0, 0.0), (0.0, 0.0, 0.0), 0.0)
        self._limits = direct(thrust_limits, self._model, 0.0, 0.0)

    def waiting(self, unix: float, health: LinkHealth) -> Snapshot:
        """Before the first row."""
        nowhere = (0.0, 0.0, 0.0)
        return Snapshot(
            Phase.WAITING, health, unix, {}, nowhere, nowhere, 0.0, 0.0, self._origin
        )  # fmt: skip

    def at(
        self, record: npt.NDArray[Any], i: int, phase: Phase, unix: float, health: LinkHealth
    ) -> Snapshot:
        """Of row `i`, which is complete."""
        names, values = record.dtype.names or (), record[i].tolist()
        row = {
            name: v if -LARGEST_PLAUSIBLE < v < LARGEST_PLAUSIBLE else math.nan
            for name, v in zip(names, values, strict=True)
        }
        now = (row["roll"], row["pitch"], row["yaw"])
        rates = (row["roll_rate"], row["pitch_rate"], row["yaw_rate"])
        if not math.isfinite(sum(rates)):  # a point mass has none
            before = record[max(i - 1, 0)]
            then = (float(before["roll"]), float(before["pitch"]), float(before["yaw"]))
            apart = float(record[i]["time"] - before["time"])  # more than a sample if thinned
            rates = self._rates(then, now, apart or self._dt)
        idle, most = self._limits(self._model, row["airspeed"], row["altitude"])
        return Snapshot(phase, health, unix, row, now, rates, idle, most, self._origin)
