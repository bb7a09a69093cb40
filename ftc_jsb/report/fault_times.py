"""When faults set in and end, for the marks in charts and figures."""

import numpy as np

from ftc_jsb.analysis.fault_steps import fault_steps
from ftc_jsb.recording.flight import Flight

MOST = 20  # marks of one flight


def fault_times(flight: Flight) -> list[float]:
    """Times [s] at which the thrust effectiveness steps, and at which any other fault starts or ends.

    An intermittent fault steps often: the first are marked.
    """
    record = flight.record
    steps = record["time"][fault_steps(record["effectiveness_thrust"], flight.scenario)]
    planned = [
        time
        for fault in flight.scenario.fault
        for time in (fault.start, fault.end)
        if time is not None and time < record["time"][-1]
    ]
    return sorted(set(np.round([*steps, *planned], 6).tolist()))[:MOST]


def onset(flight: Flight) -> float | None:
    """When the first fault sets in [s]; None without one."""
    times = fault_times(flight)
    return times[0] if times else None
