"""The table of an aircraft's flown steps, a row an airspeed, with whether the criteria are met."""

import math

from ftc_jsb.inner_loop_design.criteria import criteria_missed
from ftc_jsb.inner_loop_design.handling import Handling
from ftc_jsb.inner_loop_design.published_steps import Steps

COLUMNS = (
    "aircraft", "airspeed [m/s]", "load factor to", "rise [s]", "overshoot [%]", "error [%]",
    "bank settled [s]", "overshoot [%]", "sideslip in it [deg]", "in a steady turn [deg]",
    "thrust up [s]", "down [s]", "error [%]", "criteria",
)  # fmt: skip


def table_row(name: str, steps: Steps, handling: Handling) -> list[str]:
    """The numbers of one airspeed, as COLUMNS."""
    pulled, rolled = steps.load_factor_response, steps.bank_response
    return [
        name,
        f"{steps.airspeed:.0f}",
        f"{steps.load_factor:.2f}",
        f"{pulled.rise:.2f}",
        f"{100.0 * pulled.overshoot:.1f}",
        f"{100.0 * pulled.error:.1f}",
        f"{rolled.settling:.2f}",
        f"{100.0 * rolled.overshoot:.1f}",
        f"{math.degrees(steps.roll_sideslip):.2f}",
        f"{math.degrees(steps.turn_sideslip):.3f}",
        f"{steps.thrust_up:.2f}",
        f"{steps.thrust_down:.2f}",
        f"{100.0 * steps.thrust_error:.1f}",
        "not kept" if criteria_missed(steps, handling) else "kept",
    ]
