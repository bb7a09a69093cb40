"""What a flight asks of its aircraft: time at limits, travel of the commands, peaks of the envelope."""

from typing import Any

import numpy as np
import numpy.typing as npt

from ftc_jsb.analysis.finite_statistics import fraction, peak
from ftc_jsb.vocabulary.quantities import QUANTITIES

GIVEN_UP = ("climb_given_up", "turn_given_up", "airspeed_given_up")  # for want of thrust
ENVELOPE = ("load_factor", "bank_angle", "alpha", "sideslip")


def effort_metrics(record: npt.NDArray[Any]) -> dict[str, float | None]:
    """Saturation, what was given up, mean rates of the commands and peaks; units are in the keys."""
    saturated = (record["thrust_saturated"] > 0.5) | (record["load_factor_saturated"] > 0.5)
    duration = record["time"][-1] - record["time"][0]
    part = fraction(saturated, record["thrust_saturated"])
    return {
        "saturated_fraction": part,
        "saturated_time_s": None if part is None else part * float(duration),
        "outside_identified_fraction": fraction(
            record["outside_range"] > 0.5, record["outside_range"]
        ),
        **_peaks(record, GIVEN_UP),
        "unattainable_fraction": fraction(record["unattainable"] > 0.5, record["unattainable"]),
        "thrust_travel_n_per_s": _travel(record["thrust_cmd"], duration),
        "load_factor_travel_per_s": _travel(record["load_factor_cmd"], duration),
        "bank_travel_deg_per_s": _travel(
            QUANTITIES["bank_angle_cmd"].shown(record["bank_angle_cmd"]), duration
        ),
        "peak_thrust_n": peak(record["thrust"]),
        **_peaks(record, ENVELOPE),
    }


def _peaks(record: npt.NDArray[Any], names: tuple[str, ...]) -> dict[str, float | None]:
    shown = [QUANTITIES[name] for name in names]
    return {f"peak_{each.key}": peak(each.shown(record[each.name])) for each in shown}


def _travel(command: npt.NDArray[Any], duration: float) -> float:
    """Mean absolute rate of a command: the way it goes, up and down, over the flight's time [s]."""
    return float(np.nansum(np.abs(np.diff(command))) / duration) if duration > 0.0 else 0.0
