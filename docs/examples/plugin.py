"""The outer loop on your own FGFDMExec: turn 30 degrees, lose 40 % of thrust, see it found."""

from math import degrees, radians

import jsbsim

from ftc_jsb.plugin import OuterLoop, load_woven

fdm = jsbsim.FGFDMExec(None)  # yours, and so is all that follows but three lines
load_woven(fdm, "f16", 1.0 / 200.0)  # the aircraft with its inner loop; time step [s]
fdm["ic/h-sl-ft"], fdm["ic/vt-fps"], fdm["ic/gamma-deg"] = 10000.0, 984.0, 0.0
fdm.run_ic()
fdm["propulsion/set-running"] = -1
fdm["simulation/do_simple_trim"] = 1

loop = OuterLoop(fdm, "f16")  # engages, holds what is flown
loop.track(heading=loop["heading"] + radians(30.0))
while fdm.get_sim_time() < 30.0:
    if fdm.get_sim_time() > 10.0:
        fdm["ftc/effectiveness/engine[0]"] = 0.6  # your fault
    loop.update()  # before every run
    fdm.run()

print(f"effectiveness {loop.effectiveness:.3f} +- {loop.effectiveness_std:.1g}")
print(f"fault declared: {loop.fault_declared}; heading {degrees(loop['heading']):.2f} deg")
