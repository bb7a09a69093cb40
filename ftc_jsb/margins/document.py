"""Margins as the contents of `margins.json`: numbers with their units in the keys, unknown ones null."""

import math
from collections.abc import Sequence
from typing import Any

import numpy as np

from ftc_jsb.margins.measure import (
    AFTER,
    DELAY_AGREES,
    GAIN_AGREES,
    PERIOD,
    REALISATIONS,
    SETTLE,
    ChannelMargins,
)
from ftc_jsb.margins.stability_limit import QUIET, RESOLUTION
from ftc_jsb.recording.provenance import versions
from ftc_jsb.scenario.schema import Scenario

UNITS = {"thrust": "n", "load_factor": "1", "bank_angle": "rad"}


def document(scenario: Scenario, found: Sequence[ChannelMargins]) -> dict[str, Any]:
    """Everything that was measured, and how."""
    return {
        "aircraft": "paper" if scenario.model == "paper" else scenario.aircraft.name,
        "model": scenario.model,
        "loop": scenario.loop.name,
        "airspeed_mps": scenario.initial.airspeed,
        "altitude_m": scenario.initial.altitude,
        "fuel_fraction": scenario.aircraft.fuel_fraction,
        "method": {
            "loop_rate_hz": scenario.loop.rate,
            "settle_s": SETTLE,
            "period_s": PERIOD,
            "realisations": REALISATIONS,
            "after_insertion_s": AFTER,
            "quiet_fraction": QUIET,
            "brink_resolution": RESOLUTION,
            "gain_agreement_relative": GAIN_AGREES,
            "delay_agreement_relative": DELAY_AGREES,
        },
        "channels": {each.channel: _channel(each) for each in found},
        "versions": versions(),
    }


def _channel(found: ChannelMargins) -> dict[str, Any]:
    c, response = found.classical, found.response
    return {
        f"amplitude_{UNITS[found.channel]}": found.amplitude,
        "gain_margin_inserted_db": _number(decibel(found.gain)),
        "gain_margin_response_db": _number(decibel(c.gain)),
        "gain_reduction_margin_response_db": _number(decibel(c.gain_down)),
        "phase_crossover_rad_s": _number(c.phase_crossover),
        "phase_margin_deg": _number(math.degrees(c.phase)),
        "gain_crossover_rad_s": _number(c.gain_crossover),
        "delay_margin_inserted_s": _number(found.delay),
        "delay_margin_response_s": _number(c.delay),
        "coherence_at_crossovers": _number(c.coherence),
        "methods_agree": found.agree,
        "response": {
            "frequency_rad_s": response.frequency.tolist(),
            "magnitude_db": (20.0 * np.log10(np.abs(response.loop))).tolist(),
            "phase_deg": np.degrees(np.unwrap(np.angle(response.loop))).tolist(),
            "coherence": response.coherence.tolist(),
        },
    }


def decibel(factor: float) -> float:
    """20 log10; -inf of 0."""
    return 20.0 * math.log10(factor) if factor > 0.0 else -math.inf


def _number(value: float) -> float | None:
    return float(value) if math.isfinite(value) else None
