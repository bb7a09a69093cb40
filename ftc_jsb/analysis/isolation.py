"""Whom the isolation suspected, when, and whether it was right."""

from typing import Any

import numpy as np

from ftc_jsb.recording.flight import Flight
from ftc_jsb.vocabulary.hypotheses import HYPOTHESES, NOBODY, hypothesis

THRUST_TARGETS = ("thrust", "engine[0]", "engine[1]", "engine[2]", "engine[3]")
SAFE = 0.9  # probability from which on a suspicion is a decision


def suspicions(flight: Flight) -> list[dict[str, Any]]:
    """Every change of the suspect, and every decision on one who was suspect: time [s], who, probability.

    "healthy" is where suspicion ends.
    """
    suspect = flight.record["suspect"]
    if not np.isfinite(suspect).any():
        return []
    known = np.nan_to_num(suspect).astype(int)
    sure = np.nan_to_num(flight.record["suspect_probability"], nan=1.0) >= SAFE
    decided = np.diff(sure.astype(int), prepend=1) == 1
    changes = np.flatnonzero((np.diff(known, prepend=NOBODY) != 0) | (decided & (known != NOBODY)))
    return [
        {
            "time_s": float(flight.record["time"][k]),
            "suspect": hypothesis(known[k]),
            "probability": float(flight.record["suspect_probability"][k]),
        }
        for k in changes
    ]


def isolation_metrics(flight: Flight) -> dict[str, Any]:
    """Suspicions, how long after the first fault its cause was named, and how many named somebody else.

    None where nothing isolates; no delay without a fault that can be named, or where it never was.
    """
    found = suspicions(flight)
    if not np.isfinite(flight.record["suspect"]).any():
        return {"suspicions": None, "isolation_delay_s": None, "false_suspicions": None}
    at_fault = {name_of(fault.target): fault.start for fault in reversed(flight.scenario.fault)}
    delay = None
    right = [
        each["time_s"] - at_fault[each["suspect"]]
        for each in found
        if each["suspect"] in at_fault and each["time_s"] >= at_fault[each["suspect"]]
    ]
    if right:
        delay = min(right)
    wrong = [
        each
        for each in found
        if each["suspect"] != HYPOTHESES[NOBODY]
        and each["probability"] >= SAFE
        and not at_fault.get(each["suspect"], np.inf) <= each["time_s"]
    ]
    return {"suspicions": found, "isolation_delay_s": delay, "false_suspicions": len(wrong)}


def name_of(target: str) -> str:
    """Hypothesis of a fault's target: of all engines it is the thrust."""
    return "thrust" if target in THRUST_TARGETS else target
