"""Fit of what the engines burn, for the loop that follows the aircraft's mass."""

from typing import Any, NamedTuple

import numpy as np
import numpy.typing as npt

from ftc_jsb.errors import AircraftError
from ftc_jsb.identify.regression import Array
from ftc_jsb.identify.thrust_deck import settled
from ftc_jsb.point_mass.atmosphere import standard_atmosphere
from ftc_jsb.point_mass.fuel import SEA_LEVEL_SOUND_SPEED

SPAN = 20  # samples over which the fuel's change is a flow, and the flow's change a rate
STILL = 0.01  # of the flow, over which a settled one may change
FEWEST = 100  # samples that a fit needs
ABOVE_IDLE = 1.02  # of the least flow: below, the idle's floor may be what flows
FAR = 0.2  # of the settled flow: so far from it a flow goes as fast as it can
AT_ONCE = 1e6  # [kg/s^2], where no flight shows a limit


class Consumption(NamedTuple):
    """Coefficients of `point_mass.fuel`."""

    dry: float  # [kg/(N s)]
    part_power: float
    reheat: float  # [kg/(N s)]
    idle: float  # [kg/s]
    rise_dry: float = AT_ONCE  # [kg/s^2]
    rise_reheat: float = AT_ONCE
    fall: float = AT_ONCE

    def settled(self, rows: "Burning") -> Array:
        """(samples,): flow [kg/s] where it has settled."""
        slow = 1.0 - np.minimum(rows.throttle, 1.0)
        dry = self.dry * rows.warm * (1.0 + self.part_power * slow**2)
        each = np.where(rows.throttle > 1.0, self.reheat, dry)
        return np.maximum(each * rows.thrust, self.idle)


class Burning(NamedTuple):
    """Samples of a flight; (samples,) each."""

    thrust: Array  # [N]
    throttle: Array
    warm: Array  # speed of sound over that of sea level
    flow: Array  # [kg/s]
    rate: Array  # of the flow [kg/s^2]
    still: npt.NDArray[np.bool_]  # engine and flow have settled

    def where(self, chosen: npt.NDArray[np.bool_]) -> "Burning":
        """Some of the samples."""
        return Burning(
            self.thrust[chosen],
            self.throttle[chosen],
            self.warm[chosen],
            self.flow[chosen],
            self.rate[chosen],
            self.still[chosen],
        )


def burning(records: list[npt.NDArray[Any]]) -> Burning:
    """What test flights burnt, but for their ends, where the flow's change is not known."""
    found = []
    for record in records:
        dt = float(record["time"][1] - record["time"][0])
        middle = slice(SPAN, record.size - SPAN)
        fuel = record["fuel"]
        flow = (
            (fuel[SPAN // 2 : -SPAN // 2 - SPAN] - fuel[SPAN // 2 + SPAN : -SPAN // 2]) / SPAN / dt
        )
        before = (fuel[: -2 * SPAN] - fuel[SPAN:-SPAN]) / (SPAN * dt)
        after = (fuel[SPAN:-SPAN] - fuel[2 * SPAN :]) / (SPAN * dt)
        sound = np.array([standard_atmosphere(h)[1] for h in record["altitude"][middle]])
        still = settled(record)[middle] & (np.abs(after - before) < STILL * flow)
        columns = (record["thrust"][middle], record["throttle"][middle], sound, flow)
        found.append((*columns, (after - before) / (SPAN * dt), still))
    thrust, throttle, sound, flow, rate, still = map(np.concatenate, zip(*found, strict=True))
    return Burning(thrust, throttle, sound / SEA_LEVEL_SOUND_SPEED, flow, rate, still)


def fit_consumption(records: list[npt.NDArray[Any]]) -> Consumption:
    """Coefficients of the fuel flow: least squares of the relative error, and the rates of its changes.

    Args:
        records: test flights.

    Raises:
        AircraftError: the flights burn nothing, or never settle above idle.
    """
    every = burning(records)
    rows = every.where(every.still & (every.flow > 0.0))
    if rows.flow.size < FEWEST:
        raise AircraftError("identification: the test flights hold no settled flow of fuel")
    idle = float(rows.flow.min())
    rows = rows.where((rows.flow > ABOVE_IDLE * idle) & (rows.thrust > 0.0))
    dry, lit = rows.where(rows.throttle <= 1.0), rows.where(rows.throttle > 1.0)
    if dry.flow.size < FEWEST:
        raise AircraftError("identification: no test flight burns more than at idle")
    share = dry.thrust * dry.warm / dry.flow
    design = np.stack([share, share * (1.0 - dry.throttle) ** 2], axis=1)
    first, second = np.linalg.lstsq(design, np.ones(dry.flow.size), rcond=None)[0]
    reheat = float(first)
    if lit.flow.size:
        share = lit.thrust / lit.flow
        reheat = float(share.sum() / (share @ share))
    fitted = Consumption(float(first), float(max(second / first, 0.0)), reheat, idle)
    return _with_rates(fitted, every)


def _with_rates(fitted: Consumption, rows: Burning) -> Consumption:
    """The same with the rates at which a flow changes that is far from where it goes.

    Their medians: of an engine whose flow follows its rotor, that is the rotor's pace.
    """
    target = fitted.settled(rows)
    gap, lit = target - rows.flow, rows.throttle > 1.0
    far = np.abs(gap) > FAR * target
    rates = []
    for use in (far & (gap > 0.0) & ~lit, far & (gap > 0.0) & lit, far & (gap < 0.0)):
        seen = np.abs(rows.rate[use])
        rates.append(float(np.median(seen)) if seen.size >= FEWEST else AT_ONCE)
    return fitted._replace(rise_dry=rates[0], rise_reheat=rates[1], fall=rates[2])


def consumption_residual(records: list[npt.NDArray[Any]], fitted: Consumption) -> Array:
    """(Flow of the fit - flow) / flow, (samples,), of settled engines in flights that were not fitted to."""
    rows = burning(records)
    rows = rows.where(rows.still & (rows.flow > 0.0))
    return np.asarray(fitted.settled(rows) / rows.flow - 1.0)
