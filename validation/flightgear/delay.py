"""What the exchange's delay takes from the margins: `python -m validation.flightgear.delay [DELAY [PICTURE]]`.

The open loop of each input is measured as `ftc-jsb margins f16` does, with samples of 10 ms; it is then turned
by the delay from frame to command, and by half of what a command is held for longer than in that measurement.
"""

import sys
from collections.abc import Iterator

import numpy as np

from ftc_jsb.margins.classical import classical_margins
from ftc_jsb.margins.condition import level_scenario
from ftc_jsb.margins.document import decibel
from ftc_jsb.margins.measure import AMPLITUDE, CHANNELS, frequency_response

DELAY = 0.050  # [s], from frame to command, as it is measured in FlightGear
PICTURE = 1.0 / 24.0  # [s]


def table(delay: float, picture: float) -> Iterator[str]:
    """Lines: margins without and with the exchange, input by input.

    Args:
        delay: from frame to command [s].
        picture: time that a command is held for [s].
    """
    scenario = level_scenario("f16", "jsbsim")
    late = delay + 0.5 * (picture - 1.0 / scenario.loop.rate)
    yield f"{1e3 * late:.0f} ms later; gain margin [dB], phase margin [deg], delay margin [ms]"
    yield "| input | crossover [rad/s] | without | with |"
    yield "|---|---|---|---|"
    for channel in CHANNELS:
        response = frequency_response(scenario, channel, AMPLITUDE[channel])
        turned = response.loop * np.exp(-1j * response.frequency * late)
        cells = []
        for each in (response, response._replace(loop=turned)):
            found = classical_margins(each)
            cells.append(
                f"{decibel(found.gain):.1f}, {np.degrees(found.phase):.0f}, {1e3 * found.delay:.0f}"
            )
        yield f"| {channel} | {classical_margins(response).gain_crossover:.2f} | {' | '.join(cells)} |"


if __name__ == "__main__":
    given = [float(text) for text in sys.argv[1:3]]
    print("\n".join(table(*(*given, *(DELAY, PICTURE)[len(given) :]))))
