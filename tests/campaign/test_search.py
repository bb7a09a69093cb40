"""The search finds a seeded defect in a third of the flights that random sampling takes."""

import numpy as np
import pytest

from ftc_jsb.campaign.flights import Item, fly_items
from ftc_jsb.campaign.load import load_campaign
from ftc_jsb.campaign.run import work_of
from ftc_jsb.campaign.search import METHODS, minimise, one_by_one
from tests.campaign.campaign_files import campaign_file

# Ten parameters; the defect is a bias of the airspeed near 8 m/s to either side, one of six fault classes.
DEFECT = """
name = "defect"
scenarios = ["paper"]
models = ["paper"]
loops = ["ftc"]
cases = 4000
vary_seed = false
sampling = "monte-carlo"

[overrides]
duration = 14.0

[overrides.limits]
error_airspeed = [-9.3, 9.3]
error_flight_path_deg = [-15, 15]
error_heading_deg = [-30, 30]
altitude = [-20000, 30000]
bank_deg = [-179, 179]
load_factor = [-30, 30]
alpha_deg = [-90, 90]

[manoeuvre]
start = 2.0
path_hold = 2.0
turn_start = 2.0
turn_hold = 2.0

[[dispersion]]
key = "fault"
distribution = "choice"
values = [
  [{ target = "thrust", kind = "loss-of-effectiveness", effectiveness = 1.0, start = 5 }],
  [{ target = "thrust", kind = "loss-of-effectiveness", effectiveness = 0.8, start = 5 }],
  [{ target = "load_factor", kind = "loss-of-effectiveness", effectiveness = 0.8, start = 5 }],
  [{ target = "north", kind = "bias", size = 5.0, start = 5 }],
  [{ target = "altitude", kind = "bias", size = 5.0, start = 5 }],
  [{ target = "airspeed", kind = "bias", size = 5.0, start = 5 }],
]

[[dispersion]]
key = "fault[0].effectiveness"
distribution = "uniform"
low = 0.5
high = 1.0
when = { "fault[0].kind" = ["loss-of-effectiveness"] }

[[dispersion]]
key = "fault[0].size"
distribution = "uniform"
low = -8.0
high = 8.0
when = { "fault[0].kind" = ["bias"] }
"""
RANGES = {
    "initial.airspeed": (270, 310),
    "initial.altitude": (2500, 4000),
    "manoeuvre.path_deg": (-6, 6),
    "manoeuvre.path_rate": (0.5, 2),
    "manoeuvre.turn_deg": (-30, 30),
    "manoeuvre.turn_rate": (1, 6),
    "fault[0].start": (3, 8),
}
SEEDS, BUDGET = 10, 600


def test_seeded_defect_is_found_in_a_third_of_the_flights(tmp_path):
    """Real flights of the point mass, median of ten seeds. What random sampling takes follows from how
    probable the defect is, which is measured inside its class: ln 2 / p flights in the median.
    """
    more = "".join(
        f'[[dispersion]]\nkey = "{key}"\ndistribution = "uniform"\nlow = {low}\nhigh = {high}\n'
        for key, (low, high) in RANGES.items()
    )
    bases = load_campaign(str(campaign_file(tmp_path, DEFECT + more)))
    work = work_of(bases)
    assert bases.campaign.dimensions == 10

    def margins(points):
        items = [Item(k, tuple(map(float, point))) for k, point in enumerate(points)]
        return [row["margin"] for row in fly_items(work, items).rows]

    def first_failure(seed):
        trace = minimise(stopping(margins), 10, BUDGET, seed)
        return trace.first_below(0.0) or BUDGET + 1

    within = np.random.default_rng(0).random((400, 10))
    within[:, 0] = 1.0 - within[:, 0] / 6.0  # the last of six classes
    probability = np.mean(np.array(margins(within)) < 0.0) / 6.0
    assert 0.0 < probability < 0.01
    blind = np.log(2.0) / probability
    searched = np.median([first_failure(seed) for seed in range(SEEDS)])
    assert searched < blind / 3.0, (searched, blind)


def stopping(objective):
    """The same objective; after the first failure it costs nothing more."""
    found = False

    def watched(points):
        nonlocal found
        values = [1.0] * len(points) if found else objective(points)
        found = found or min(values) < 0.0
        return values

    return watched


@pytest.mark.parametrize("method", METHODS)
def test_same_seed_asks_for_the_same_points_within_the_budget(method):
    """Any callable is an objective; a value that is not finite does not stop it."""

    def bowl(point):
        return float("nan") if point[0] > 0.9 else float(np.sum((point - 0.3) ** 2))

    one, other = (minimise(one_by_one(bowl), 3, 150, 7, method) for _ in range(2))
    assert one.points.shape == (150, 3)
    assert np.array_equal(one.points, other.points)
    assert np.all((one.points >= 0.0) & (one.points <= 1.0))
    blind = minimise(one_by_one(bowl), 3, 150, 7, "random")
    assert method == "random" or one.values.min() < blind.values.min()


def test_unknown_method_is_named():
    with pytest.raises(ValueError, match="no 'best'; expected one of cma-es"):
        minimise(one_by_one(sum), 2, 10, method="best")
