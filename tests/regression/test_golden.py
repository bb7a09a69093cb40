"""Golden flights: stored every half second, compared at each change.

`make golden` rewrites them; a commit that does so says why.
"""

from pathlib import Path

import numpy as np
import pytest

HERE = Path(__file__).parent
COLUMNS = (
    "time", "airspeed", "flight_path_angle", "heading", "north", "east", "altitude", "thrust_cmd",
    "load_factor_cmd", "bank_angle_cmd", "effectiveness_thrust_est", "effectiveness_thrust_std",
)  # fmt: skip

# Relative to each column's largest value. The point mass is the same arithmetic everywhere but for
# the last bits of sin, cos and pow; JSBSim's own arithmetic differs more between machines.
FLIGHTS = {
    "paper-ftc": (("paper",), 1e-9),
    "paper-no-ftc": (("paper", "loop.name=no-ftc"), 1e-9),
    "total-loss": (("total-loss",), 1e-9),
    "identified-ftc": (("paper", "model=identified"), 1e-7),
    "jsbsim-ftc": (("paper", "model=jsbsim"), 1e-6),
}


@pytest.mark.parametrize("name", FLIGHTS)
def test_flight_is_the_golden_one(flown, name, request):
    arguments, tolerance = FLIGHTS[name]
    record = flown(*arguments).record[:-1:50]
    flight = np.column_stack([record[column] for column in COLUMNS])
    path = HERE / f"{name}.csv"
    if request.config.getoption("--rewrite-golden"):
        np.savetxt(path, flight, fmt="%.15g", delimiter=",", header=",".join(COLUMNS), comments="")
    golden = np.loadtxt(path, delimiter=",", skiprows=1)
    assert flight.shape == golden.shape
    scale = np.abs(golden).max(axis=0)
    worst = np.abs(flight - golden).max(axis=0) / np.where(scale > 0.0, scale, 1.0)
    told = {
        column: error for column, error in zip(COLUMNS, worst, strict=True) if error > tolerance
    }
    assert not told, f"largest relative differences: {told}"
