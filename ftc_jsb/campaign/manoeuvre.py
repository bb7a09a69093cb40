"""[manoeuvre] of a campaign: references made from a few numbers, which can be dispersed.

From straight flight: to another path angle and on to a second one, a turn and a turn back, a change of
airspeed. Pushovers, pull-ups, bunts into a turn and reversals are all of this form.
"""

from typing import Annotated, Any

from pydantic import Field

from ftc_jsb.scenario.types import Time
from ftc_jsb.typed_file import Section

_Path = Annotated[float, Field(ge=-60.0, le=60.0)]  # deg
_Turn = Annotated[float, Field(ge=-3600.0, le=3600.0)]  # deg
_Rate = Annotated[float, Field(gt=0.0, le=1000.0)]
_LEAST = 0.1  # [s]: what does not change still takes time, breakpoints must increase


class Manoeuvre(Section):
    """[manoeuvre]: what is flown from the initial condition on, in place of the scenario's references."""

    start: Time = 5.0  # s, of path and airspeed
    path_deg: _Path = 0.0  # path angle to begin with
    path_rate: _Rate = 2.0  # deg/s
    path_hold: Time = 5.0  # s
    path_end_deg: _Path = 0.0  # path angle that it ends with
    turn_start: Time = 5.0  # s
    turn_deg: _Turn = 0.0  # change of heading
    turn_rate: _Rate = 5.0  # deg/s
    turn_hold: Time = 5.0  # s
    turn_back_deg: _Turn = 0.0  # change of heading after the hold
    airspeed_change: Annotated[float, Field(ge=-200.0, le=200.0)] = 0.0  # m/s
    airspeed_rate: _Rate = 5.0  # m/s2


def breakpoints(manoeuvre: Manoeuvre, initial: dict[str, Any]) -> dict[str, list[list[float]]]:
    """Breakpoints [time s, value] of airspeed [m/s], flight path and heading [deg].

    Args:
        manoeuvre: what is flown.
        initial: [initial] of the scenario, complete.
    """
    m = manoeuvre
    airspeed, path = initial["airspeed"], initial["flight_path_deg"]
    heading = initial["heading_deg"]
    legs = {
        "airspeed": (m.start, [(m.airspeed_change, m.airspeed_rate, 0.0)], airspeed),
        "flight_path_deg": (
            m.start,
            [
                (m.path_deg - path, m.path_rate, m.path_hold),
                (m.path_end_deg - m.path_deg, m.path_rate, 0.0),
            ],
            path,
        ),
        "heading_deg": (
            m.turn_start,
            [(m.turn_deg, m.turn_rate, m.turn_hold), (m.turn_back_deg, m.turn_rate, 0.0)],
            heading,
        ),
    }
    return {name: _ramps(*leg) for name, leg in legs.items()}


def _ramps(start: float, legs: list[tuple[float, float, float]], value: float) -> list[list[float]]:
    """From `value` at `start` by (change, rate, hold [s]) after another."""
    points, time = [[0.0, value]], start
    for change, rate, hold in legs:
        if change == 0.0:
            time += hold
            continue
        if time > points[-1][0]:
            points.append([time, value])
        value += change
        time += max(abs(change) / rate, _LEAST)
        points.append([time, value])
        time += hold
    return points
