"""Start of the outer loop: level trim as u_n(0), the first measurement as the first estimate."""

import math

from ftc_jsb.compiled import compiled
from ftc_jsb.control.observer import start_observer
from ftc_jsb.point_mass.dynamics import level_trim_thrust
from ftc_jsb.point_mass.model import Condition
from ftc_jsb.vocabulary.kernel_types import LoopSettings, LoopState, ModelRecord, Row


@compiled
def start_loop(s: LoopSettings, m: ModelRecord, x: LoopState, at: Condition, row: Row) -> None:
    """Level trim within the engine's limits, wings level, nothing given up, nothing integrated."""
    airspeed, path = x.known.state[0], x.known.state[1]
    thrust = level_trim_thrust(at, airspeed, path)
    x.trim[0] = min(max(thrust, at.thrust_idle), at.thrust_maximum)
    x.trim[1] = math.cos(path)
    x.trim[2] = 0.0
    for k in range(3):
        x.demand[k] = x.trim[k]
        x.integral[k] = 0.0
    x.given_up[0], x.given_up[1], x.given_up[2] = 0.0, 0.0, 0.0
    x.drag_beyond, x.sustained = 0.0, 0.0
    x.short_time, x.lasting = 0.0, 1.0
    lag = x.inner_loop
    for axis in range(2):
        lag.command[axis] = x.trim[1 + axis]
        lag.slow[axis] = x.trim[1 + axis]
        lag.response[axis, 0], lag.response[axis, 1] = x.trim[1 + axis], 0.0
    start_observer(s, m, x, at, row)
