"""The paper's outer loop as one compiled step: measure, estimate, decide, limit, filter.

Every built-in loop is this kernel with other settings: which estimator runs, and where the law
takes the effectiveness from. It reads one row of the recording and writes its decisions there.
"""

from ftc_jsb.compiled import compiled
from ftc_jsb.control.attainment import record_attainment
from ftc_jsb.control.believed_readings import isolate_if_asked
from ftc_jsb.control.decision import (
    demand_of_law,
    drag_beyond_polar,
    effectiveness_for_law,
    integrate_errors,
    limit_demand,
    state_for_law,
    tracking_errors,
    wanted_rates,
)
from ftc_jsb.control.envelope import keep_inside_envelope
from ftc_jsb.control.inner_loop_command import command_inner_loop
from ftc_jsb.control.known_state import update_known_state
from ftc_jsb.control.law import Rates
from ftc_jsb.control.limits import limits_now
from ftc_jsb.control.observer import observe, record_estimates
from ftc_jsb.control.priority import put_speed_first
from ftc_jsb.control.records import LoopArrays
from ftc_jsb.control.start import start_loop
from ftc_jsb.point_mass.model import at_condition
from ftc_jsb.vocabulary.channels import CHANNELS
from ftc_jsb.vocabulary.kernel_types import LoopSettings, LoopState, Records, Row

INPUTS = len(CHANNELS)


@compiled
def outer_loop_step(loop: LoopArrays, record: Records, i: int) -> None:
    """One sample of the outer loop.

    Args:
        loop: settings, model and state of the loop; the state and the model's mass are advanced.
        record: (rows,) of the recording; references and measurements of row `i` are read,
            commands, estimates and the detector's verdict are written.
        i: row; 0 starts the loop.
    """
    s, m, x, row = loop.settings[0], loop.model[0], loop.state[0], record[i]
    if i == 0:
        m.mass = m.mass_start
    isolate_if_asked(loop.isolates, s, m, x, row, i)
    update_known_state(s, x, row, i)
    at = at_condition(m, x.known.state[0], x.known.altitude)
    if i == 0:
        start_loop(s, m, x, at, row)
    else:
        observe(s, m, x, at, row)
    record_estimates(s, m, x, at, row)

    errors = tracking_errors(s, x, row)
    state = state_for_law(s, x)
    effectiveness = effectiveness_for_law(s, x, row)
    asked = wanted_rates(s, x, row, state, errors)
    unpaid = drag_beyond_polar(s, x, at, row, state.airspeed, effectiveness.thrust)
    wanted = put_speed_first(s, m, x, at, row, state, effectiveness.thrust, asked)
    limits = limits_now(s, m, at, state.airspeed)
    allowed = keep_inside_envelope(s, m, x, at, state, effectiveness.thrust, limits, wanted)
    wanted = Rates(allowed.airspeed + unpaid, allowed.flight_path_angle, allowed.heading)
    demand = demand_of_law(s, x, at, row, state, effectiveness, wanted, limits)
    limit_demand(x, at, row, demand, limits)
    record_attainment(s, x, row, errors, asked, allowed)
    integrate_errors(s, x, row, errors)
    command_inner_loop(s, x, row, limits)
    advance_trim_input(s, x, row)


@compiled
def advance_trim_input(s: LoopSettings, x: LoopState, row: Row) -> None:
    """(10): u_n goes towards the limited u, exactly for a held command; the row keeps u_n before."""
    row.trim_input_thrust = x.trim[0]
    row.trim_input_load_factor = x.trim[1]
    row.trim_input_bank_angle = x.trim[2]
    for k in range(INPUTS):
        x.trim[k] += s.trim_share * (x.demand[k] - x.trim[k])
