"""A case is a function of its campaign and number: distributions, manoeuvres, scenarios, seeds."""

import numpy as np
import pytest
from scipy.stats import kstest, norm, truncnorm

from ftc_jsb.campaign.case import case_of, scenario_of_case
from ftc_jsb.campaign.dispersion import Dispersion
from ftc_jsb.campaign.load import load_campaign
from ftc_jsb.campaign.sampling import unit_point
from ftc_jsb.scenario.load import load_scenario
from tests.campaign.campaign_files import SMALL, campaign_file

MANOEUVRE = """
[manoeuvre]
path_hold = 3.0

[[dispersion]]
key = "manoeuvre.path_deg"
distribution = "uniform"
low = -10
high = -10.000001
"""


@pytest.mark.parametrize("sampling", ["monte-carlo", "latin-hypercube", "sobol"])
def test_a_case_depends_on_its_number_alone(tmp_path, sampling):
    """Asked for backwards and by another process' copy: the same drawn values."""
    path = campaign_file(tmp_path, sampling=f'"{sampling}"')
    one, other = load_campaign(str(path)), load_campaign(str(path))
    forward = [case_of(one, number) for number in range(12)]
    assert [case_of(other, number) for number in reversed(range(12))] == forward[::-1]
    assert len({case.parameters["seed"] for case in forward}) == 12


def test_hypercube_has_one_case_in_every_stratum(tmp_path):
    bases = load_campaign(str(campaign_file(tmp_path)))
    points = np.array([unit_point(bases.campaign, number) for number in range(12)])
    assert np.all(np.sort(np.floor(12 * points), axis=0) == np.arange(12)[:, None])


def test_grid_is_the_whole_product_with_its_ends(tmp_path):
    text = SMALL.replace("cases = 12", 'sampling = "grid"').replace(
        "high = 1.0", "high = 1.0\npoints = 3"
    )
    bases = load_campaign(
        str(campaign_file(tmp_path, text.replace("high = 6.0", "high = 6.0\npoints = 2")))
    )
    assert bases.campaign.count == 3 * 2 * 2
    drawn = set()
    for number in range(12):
        found = case_of(bases, number).parameters
        level, start = (round(found[f"fault[0].{key}"], 9) for key in ("effectiveness", "start"))
        drawn.add((level, start, found["sensors.profile"]))
    profiles = ("perfect", "tactical")
    assert drawn == {(k, t, p) for k in (0.2, 0.6, 1.0) for t in (2.0, 6.0) for p in profiles}


@pytest.mark.parametrize(
    ("keys", "expected"),
    [
        ({"distribution": "uniform", "low": 2, "high": 5}, lambda x: (x - 2) / 3),
        ({"distribution": "log-uniform", "low": 1, "high": 100}, lambda x: np.log(x) / np.log(100)),
        ({"distribution": "normal", "mean": 3, "deviation": 2}, norm(3, 2).cdf),
        (
            {"distribution": "truncated-normal", "mean": 3, "deviation": 2, "low": 2, "high": 6},
            truncnorm(-0.5, 1.5, 3, 2).cdf,
        ),
        (  # so far out that the normal's own quantiles are infinite
            {"distribution": "truncated-normal", "mean": 0, "deviation": 1, "low": 10, "high": 20},
            truncnorm(10, 20).cdf,
        ),
        (
            {"distribution": "truncated-normal", "mean": 0, "deviation": 1, "low": -9, "high": -2},
            truncnorm(-9, -2).cdf,
        ),
    ],
)
def test_distributions_are_what_they_are_called(keys, expected):
    """Kolmogorov-Smirnov on 2000 equally spaced quantiles: within 1/2000 of the exact distribution."""
    dispersion = Dispersion(key="duration", **keys)
    values = [dispersion.value((k + 0.5) / 2000) for k in range(2000)]
    assert kstest(values, np.vectorize(expected)).statistic < 1 / 2000


def test_choice_keeps_its_weights():
    dispersion = Dispersion(
        key="duration",
        distribution="choice",
        values=(1.0, 2.0),
        weights=(1.0, 3.0),
        labels=("a", "b"),
    )
    values = [dispersion.value((k + 0.5) / 1000) for k in range(1000)]
    assert values.count(1.0) == 250
    assert dispersion.shown(0.1) == "a"


def test_dispersions_scale_add_and_apply_only_when(tmp_path):
    text = SMALL + """
[[dispersion]]
key = ["initial.airspeed", "reference.airspeed[0][1]"]
distribution = "uniform"
low = 0.5
high = 0.500001
apply = "scale"

[[dispersion]]
key = "seed"
distribution = "choice"
values = [77]
when = { "sensors.profile" = ["tactical"] }
"""  # fmt: skip
    bases = load_campaign(str(campaign_file(tmp_path, text)))
    for number in range(12):
        case = case_of(bases, number)
        scenario = scenario_of_case(case, None, "ftc")
        assert scenario.initial.airspeed == pytest.approx(150.0, rel=1e-5)
        assert scenario.reference.airspeed[0][1] == scenario.initial.airspeed
        assert (scenario.seed == 77) == (scenario.sensors.profile == "tactical")


def test_manoeuvre_starts_from_the_initial_condition(tmp_path):
    text = SMALL.replace("cases = 12", "cases = 1") + MANOEUVRE.replace("-10.000001", "-9.99")
    bases = load_campaign(str(campaign_file(tmp_path, text)))
    made = scenario_of_case(case_of(bases, 0), "jsbsim", "ftc").reference
    assert made.airspeed == ((0.0, 300.0),)
    times, angles = zip(*made.flight_path_deg, strict=True)
    assert angles == pytest.approx((0.0, 0.0, -10.0, -10.0, 0.0), abs=0.01)
    assert times == pytest.approx((0.0, 5.0, 10.0, 13.0, 18.0), abs=0.02)


def test_every_scenario_gets_its_share(tmp_path):
    text = SMALL.replace('["paper"]\nmodels', '["paper", "nominal"]\nmodels').split(
        "[[dispersion]]"
    )[0]
    bases = load_campaign(str(campaign_file(tmp_path, text)))
    names = [case_of(bases, number).parameters["scenario"] for number in range(12)]
    assert names.count("paper") == names.count("nominal") == 6


def test_written_scenario_of_a_case_is_what_it_flew(tmp_path):
    """A base without dispersions and overrides is the scenario itself, but for loop and seed."""
    text = SMALL.split("[[dispersion]]")[0].replace(
        "overrides = { duration = 8.0 }", "vary_seed = false"
    )
    bases = load_campaign(str(campaign_file(tmp_path, text)))
    assert scenario_of_case(case_of(bases, 5), None, "ftc") == load_scenario("paper")
