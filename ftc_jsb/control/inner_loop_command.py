"""From the law's demand to the inner loop's command: lead against its lag."""

from ftc_jsb.compiled import compiled
from ftc_jsb.control.limits import Limits
from ftc_jsb.vocabulary.kernel_types import LoopSettings, LoopState, Row


@compiled
def command_inner_loop(s: LoopSettings, x: LoopState, row: Row, limits: Limits) -> None:
    """Write the commands of thrust, load factor and bank to the row.

    Load factor and bank lead by the lag that the inner loop was identified with; the rates come from a
    first-order filter of the demands.
    """
    lag = x.inner_loop
    row.load_factor_demand = x.demand[1]
    row.bank_angle_demand = x.demand[2]
    row.thrust_cmd = x.demand[0]
    load_factor_rate = s.lead_filter * (x.demand[1] - lag.slow[0])
    bank_rate = s.lead_filter * (x.demand[2] - lag.slow[1])
    with_lead = x.demand[1] + s.lead[0] * load_factor_rate
    row.load_factor_cmd = min(max(with_lead, limits.load_factor_min), limits.load_factor_max)
    row.bank_angle_cmd = x.demand[2] + s.lead[1] * bank_rate
    if s.upright == 1:
        row.bank_angle_cmd = min(max(row.bank_angle_cmd, -limits.bank_max), limits.bank_max)
    lag.command[0], lag.command[1] = row.load_factor_cmd, row.bank_angle_cmd
    for axis in range(2):
        lag.slow[axis] += s.lead_share * (x.demand[1 + axis] - lag.slow[axis])
