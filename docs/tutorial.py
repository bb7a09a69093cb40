# ---
# jupyter:
#   kernelspec:
#     display_name: Python 3
#     language: python
#     name: python3
# ---

# %% [markdown]
# # Ten minutes
#
# An aircraft loses thrust and nobody tells the autopilot. In this notebook you fly that, make it worse,
# compare an autopilot that estimates the loss with one that does not, put one of your own in their place,
# let an instrument fail in place of the engine, and look for the point at which nothing helps.
#
# What you need is [installed](install.md) by `pip install .`. Paste the cells into a Python shell, or
# open this page as a notebook, which the install page tells how. Everything on this page was computed
# when the page was built.
#
# ## Fly
#
# The scenario `paper` is 60 s of turns, a climb and a descent. At 20 s the engine loses 40 % of its
# thrust. The very first flight after an installation compiles the numerical kernels, about half a minute;
# after that a flight takes less than a second.

# %%
import ftc_jsb as ftc

flight = ftc.fly("paper", model="jsbsim")
flight

# %% [markdown]
# The model `jsbsim` is an F-16 with six degrees of freedom. The verdict says that no limit was broken,
# the RMSE that airspeed was kept within a few cm/s, and the detection delay how soon the loss was
# declared. In pictures:

# %%
flight.plot("states")

# %% [markdown]
# The thin line is the reference. The dip of the airspeed at 20 s is the whole of the fault: 0.4 m/s. What
# the loop knows of it is its estimate of the **effectiveness**: the part of the commanded thrust that is
# still delivered.

# %%
flight.plot("effectiveness")

# %% [markdown]
# ## Break
#
# Any key of the scenario can be set. Here only 30 % of the thrust is left:

# %%
broken = ftc.fly("paper", model="jsbsim", set={"fault[0].effectiveness": 0.3})
print(broken.verdict)
for limit in broken.metrics["limits_broken"]:
    print(f"{limit['name']} from {limit['time']:.1f} s on: {limit['value']:.1f}")

# %% [markdown]
# The loss was found as before, but the thrust that is left cannot pay for turn and climb. The loop keeps
# the airspeed, within 2 m/s, and gives up climb and turn until they can be had again, in a stated
# [order](loops.md#where-thrust-cannot-pay-for-the-manoeuvre).

# %%
broken.plot("states")

# %% [markdown]
# ## Compare
#
# Is the loop any good, and can a simple point mass be believed? `compare` flies both questions: with
# fault tolerance (`ftc`) and without (`no-ftc`), on the paper's point mass, on a point mass that was
# fitted to the F-16, and on the F-16 itself.

# %%
both = ftc.compare("paper")
few = [
    "verdict",
    "rmse_airspeed_mps",
    "rmse_flight_path_deg",
    "rmse_heading_deg",
    "detection_delay_s",
]
both.to_pandas()[few]

# %%
for pair in both.ftc_helped:
    print(f"{pair['model']:10s} {pair['answer']}")

# %%
both.plot("errors")

# %% [markdown]
# `both` alone shows every metric, `both.report("my-report")` writes all of it as one page,
# `my-report/report.html`.
#
# ## A loop of your own
#
# A loop is a class. It is built once with what it may know of the aircraft, and asked a hundred times a
# second. This one knows nothing of faults; where airspeed is missing it adds thrust until it is not.


# %%
import math


class Steady:
    """Proportional gains, and an integral of the airspeed error."""

    def __init__(self, setup: ftc.LoopSetup) -> None:
        self.mass, self.dt = setup.mass, setup.dt
        self.gravity = setup.aircraft.mass.gravity  # [m/s^2]
        self.trim = 0.3 * self.mass * self.gravity  # [N], a first guess

    def step(self, time, measured: ftc.Measurement, wanted: ftc.Reference):
        speed, path = measured.airspeed, measured.flight_path_angle
        error = wanted.airspeed - speed  # [m/s]
        self.trim += 0.25 * self.dt * self.mass * error
        thrust = self.trim + self.mass * (wanted.airspeed_rate + error)
        climb = wanted.flight_path_angle_rate + wanted.flight_path_angle - path
        turn = wanted.heading_rate + wanted.heading - measured.heading  # [rad/s]
        up = math.cos(path) + speed * climb / self.gravity
        side = speed * math.cos(path) * turn / self.gravity
        return ftc.Command(thrust, math.hypot(up, side), math.atan2(side, up))


mine = ftc.compare("paper", models=["jsbsim"], loops=["ftc", "no-ftc", Steady])
mine.to_pandas()[few]

# %%
mine.plot("errors")

# %% [markdown]
# An integral alone gets back to the airspeed, later. It does not know why, so it can declare nothing.
# What a loop may read and write is in [loops](loops.md#your-own).
#
# ## A fault of your own
#
# Now the engine is healthy, and the pitot tube drifts by 1.5 m/s each second, in moderate turbulence and
# through real instruments. `ftc` believes it; `robust` compares the instruments with each other.

# %%
pitot = {"target": "airspeed", "kind": "drift", "size": 1.5, "start": 20.0}
fooled = ftc.compare(
    "turbulence", models=["jsbsim"], loops=["ftc", "robust"], set={"fault": [pitot]}
)
fooled.to_pandas()[["verdict", "rmse_airspeed_mps", "false_alarms"]]

# %%
fooled["jsbsim-robust"].metrics["suspicions"]

# %% [markdown]
# It names the airspeed and flies on without it. Engines, surfaces and every instrument can fail:
# [faults](scenarios.md#faults). Whose fault it is, and how that is told: [isolation](isolation.md).
#
# ## Sweep
#
# How large a loss can be borne? `sweep` flies a grid and gives a table, a row a flight.

# %%
left = {"fault[0].effectiveness": [0.2, 0.3, 0.4, 0.5, 0.6, 0.8]}
swept = ftc.sweep("paper", left, models=["jsbsim"], loops=["ftc", "no-ftc"])
table = swept.to_pandas().pivot(index="fault[0].effectiveness", columns="loop")
table[["verdict", "rmse_airspeed_mps"]]

# %%
axes = table["rmse_airspeed_mps"].plot(logy=True, marker="o", ylabel="RMSE airspeed [m/s]")

# %% [markdown]
# Where the thrust that is left can pay for the manoeuvre, an estimate is worth a factor of thirty to
# fifty. Below, no loop makes thrust out of nothing; what differs is what is given up.
# `swept.flight(3)` flies a row again, to be looked at.
#
# ## What next
#
# - [Which loop?](howto/which-loop.md), [thousands of flights](howto/sweep.md),
#   [an aircraft of your own](howto/own-aircraft.md), [a ground station](howto/ground-station.md),
#   [FlightGear](flightgear.md), [a cluster](howto/cluster.md)
# - The same from a shell: `ftc-jsb compare paper`, and
#   `ftc-jsb fly paper --model jsbsim --set fault[0].effectiveness=0.3`
# - [The Python interface](python.md): two futures from one moment, recordings, margins, campaigns
# - [How far a point mass can be believed](validity.py), [the theory](theory.md)
