"""Margins of one loop at its three inputs, by insertion and by frequency response."""

from collections.abc import Callable
from typing import NamedTuple

import numpy as np

from ftc_jsb.errors import TrimError
from ftc_jsb.margins.classical import ClassicalMargins, classical_margins
from ftc_jsb.margins.frequency_response import (
    FrequencyResponse,
    harmonics,
    loop_response,
    multisine,
)
from ftc_jsb.margins.input_perturbation import Delay, Gain, Injection
from ftc_jsb.margins.perturbed_flight import perturbed_flight
from ftc_jsb.margins.stability_limit import diverges, smallest_divergent
from ftc_jsb.scenario.schema import Scenario
from ftc_jsb.vocabulary.channels import Channel

CHANNELS: tuple[Channel, ...] = ("thrust", "load_factor", "bank_angle")
STEPS = 3  # that `channel_margins` tells of
# RMS of the injection and size of the step: so small that no limit and no rate limit is met
AMPLITUDE = {"thrust": 20.0, "load_factor": 0.005, "bank_angle": 0.005}  # [N], [-], [rad]
SETTLE = 10.0  # [s] of flight before anything is perturbed
PERIOD = 40.0  # [s] of the multisine: its lowest line is 0.157 rad/s
LINES = 90
REALISATIONS = 4
AFTER = 30.0  # [s] of flight after a gain or delay is inserted
MOST_GAIN, MOST_DELAY = 1000.0, 10.0  # [-], [s]
GAIN_AGREES, DELAY_AGREES = 0.06, 0.05  # relative: 0.5 dB; and one sample for delays


class ChannelMargins(NamedTuple):
    """One input of the loop."""

    channel: Channel
    gain: float  # factor inserted that breaks it; inf: none up to MOST_GAIN
    delay: float  # [s] inserted that breaks it; inf: none up to MOST_DELAY
    classical: ClassicalMargins
    response: FrequencyResponse
    agree: bool
    amplitude: float  # of the signals [N], [-], [rad]


Progress = Callable[[str], None]


def channel_margins(
    scenario: Scenario, channel: Channel, tell: Progress, scale: float = 1.0
) -> ChannelMargins:
    """Measure both ways and compare.

    Args:
        scenario: straight and level, see `condition.level_scenario`.
        channel: input of the plant at which the loop is opened or perturbed.
        tell: is told what is flown next.
        scale: of the signals, in units of AMPLITUDE.

    Raises:
        UserError: the aircraft cannot be had or trimmed, or does not fly unperturbed.
    """
    tell(f"{channel}: frequency response")
    amplitude = scale * AMPLITUDE[channel]
    response = frequency_response(scenario, channel, amplitude)
    classical = classical_margins(response)
    tell(f"{channel}: gain")
    gain = gain_margin(scenario, channel, amplitude)
    tell(f"{channel}: delay")
    delay = delay_margin(scenario, channel, amplitude)
    near_gain = _close(gain, classical.gain, GAIN_AGREES, 0.0, MOST_GAIN)
    sample = 1.0 / scenario.loop.rate
    near_delay = _close(delay, classical.delay, DELAY_AGREES, sample, MOST_DELAY)
    agree = near_gain and near_delay
    return ChannelMargins(channel, gain, delay, classical, response, agree, amplitude)


def _close(found: float, other: float, relative: float, absolute: float, most: float) -> bool:
    if np.isinf(found):
        return other > most * (1.0 - relative)
    return abs(found - other) <= max(relative * other, absolute)


def frequency_response(scenario: Scenario, channel: Channel, amplitude: float) -> FrequencyResponse:
    """L at one input by multisines of different phases, a flight each.

    Raises:
        TrimError: the loop does not fly with the injection.
    """
    rate = scenario.loop.rate
    samples = 2 * round(0.5 * PERIOD * rate)
    lines = harmonics(samples, 1, LINES)
    still = round(SETTLE * rate)
    before, after = [], []
    for seed in range(REALISATIONS):
        period = multisine(samples, lines, amplitude, seed)
        signal = np.concatenate([np.zeros(still), period, period, period, period[:1]])
        flown = perturbed_flight(scenario, channel, Injection(signal), (signal.size - 1) / rate)
        if not flown.complete:
            raise TrimError(f"margins: {channel}: the injection ends the flight: {flown.reason}")
        settled = slice(still + samples, still + 3 * samples)
        before.append(flown.commanded[settled])
        after.append(flown.given[settled])
    return loop_response(np.array(before), np.array(after), lines, 1.0 / rate)


def gain_margin(scenario: Scenario, channel: Channel, step: float) -> float:
    """Factor on the command about its trim that breaks the loop.

    Raises:
        TrimError: it is broken unaltered.
    """
    start = round(SETTLE * scenario.loop.rate)

    def broken(factor: float) -> bool:
        flown = perturbed_flight(scenario, channel, Gain(factor, start, step), SETTLE + AFTER)
        return diverges(flown.given[start:], step, flown.complete)

    if broken(1.0):
        raise TrimError(f"margins: {channel}: the loop breaks unaltered")
    return smallest_divergent(broken, 1.05, MOST_GAIN)


def delay_margin(scenario: Scenario, channel: Channel, step: float) -> float:
    """Delay [s] of the command that breaks the loop; the flight after it lasts forty delays."""
    rate = scenario.loop.rate
    start = round(SETTLE * rate)

    def broken(delay: float) -> bool:
        after = max(AFTER, 40.0 * delay)
        inserted = Delay(delay * rate, start, step)
        flown = perturbed_flight(scenario, channel, inserted, SETTLE + after)
        return diverges(flown.given[start:], step, flown.complete)

    return smallest_divergent(broken, 1.0 / rate, MOST_DELAY)
