"""What became of a fault: set in, suspected, declared, isolated, limit broken, given up, control lost."""

from typing import Any, NamedTuple

import numpy as np
import numpy.typing as npt

from ftc_jsb.analysis.default_limits import flight_limits
from ftc_jsb.analysis.fault_detection import HEALTHY
from ftc_jsb.analysis.isolation import SAFE, suspicions
from ftc_jsb.analysis.limits import limited_variables
from ftc_jsb.analysis.loss_of_control import loss_of_control
from ftc_jsb.recording.flight import Flight
from ftc_jsb.vocabulary.channels import CHANNELS
from ftc_jsb.vocabulary.hypotheses import HYPOTHESES, NOBODY
from ftc_jsb.vocabulary.quantities import QUANTITIES

Mask = npt.NDArray[np.bool_]

FAULT, SUSPECTED, DECLARED, ISOLATED = "fault", "suspected", "declared", "isolated"
LIMIT, LOST = "limit broken", "control lost"
GIVEN_UP = {  # variable: its event, and the least that is an event, as it is shown
    "climb_given_up": ("climb given up", 0.1),  # [deg]
    "turn_given_up": ("turn given up", 0.1),  # [deg/s]
    "airspeed_given_up": ("airspeed given up", 0.1),  # [m/s]
}
EVENTS = (FAULT, SUSPECTED, DECLARED, ISOLATED, LIMIT, *(e for e, _ in GIVEN_UP.values()), LOST)
PAUSE = 0.5  # [s]: what stops for less goes on
MOST = 50  # stretches of one event and cause; of more the first


class Stretch(NamedTuple):
    """Something that lasts from one time to another [s]."""

    event: str  # of EVENTS
    what: str  # the target of a fault, who is suspected, the key of a limit; "" where there is none
    from_s: float
    to_s: float


def fault_timeline(flight: Flight) -> list[Stretch]:
    """Everything of EVENTS that happened in a flight, in the order of EVENTS and of time.

    What lasts to the end of the flight ends with it.
    """
    record = flight.record
    time, end = record["time"], float(record["time"][-1])
    found = _faults(flight, end) + _suspicions(flight, end)
    found += _lasting(DECLARED, "", time, record["fault_declared"] > 0.5)
    lost = loss_of_control(record)
    found += _limits(flight, end if lost is None else lost.time)
    for name, (event, least) in GIVEN_UP.items():
        found += _lasting(event, "", time, QUANTITIES[name].shown(record[name]) > least)
    if lost is not None:
        found.append(Stretch(LOST, lost.kind, lost.time, end))
    return sorted(found, key=lambda stretch: (EVENTS.index(stretch.event), stretch.from_s))


def _faults(flight: Flight, end: float) -> list[Stretch]:
    """Faults of the scenario; where it has none, what was injected in flight, by its effectiveness."""
    planned = [
        Stretch(FAULT, fault.target, fault.start, min(end if fault.end is None else fault.end, end))
        for fault in flight.scenario.fault
        if fault.start < end
    ]
    if planned:
        return planned
    record = flight.record
    return [
        stretch
        for channel in CHANNELS
        for stretch in _lasting(
            FAULT, channel, record["time"], record[f"effectiveness_{channel}"] < HEALTHY
        )
    ]


def _suspicions(flight: Flight, end: float) -> list[Stretch]:
    """Who was suspected, and who was isolated: named with a probability of SAFE at least."""
    found = suspicions(flight)
    times = [*(each["time_s"] for each in found), end][1:]
    return [
        Stretch(
            SUSPECTED if each["probability"] < SAFE else ISOLATED,
            each["suspect"],
            each["time_s"],
            until,
        )
        for each, until in zip(found, times, strict=True)
        if each["suspect"] != HYPOTHESES[NOBODY]
    ][: 2 * MOST]


def _limits(flight: Flight, judged: float) -> list[Stretch]:
    """Stretches outside each limit, until `judged` [s]."""
    record = flight.record[flight.record["time"] <= judged]
    limits = flight_limits(flight.scenario)
    found = []
    for name, values in limited_variables(record).items():
        bounds = getattr(limits, name, None)
        if bounds is not None:
            outside = (values < bounds[0]) | (values > bounds[1])
            found += _lasting(LIMIT, name, record["time"], outside)
    return found


def _lasting(event: str, what: str, time: npt.NDArray[Any], where: Mask) -> list[Stretch]:
    """Stretches in which something holds, joined over pauses shorter than PAUSE."""
    edges = np.flatnonzero(np.diff(np.concatenate([[0], where.astype(np.int8), [0]])))
    joined: list[list[float]] = []
    for first, after in zip(edges[::2], edges[1::2], strict=True):
        start, stop = float(time[first]), float(time[min(after, time.size - 1)])
        if joined and start - joined[-1][1] < PAUSE:
            joined[-1][1] = stop
        else:
            joined.append([start, stop])
    return [Stretch(event, what, start, stop) for start, stop in joined[:MOST]]
