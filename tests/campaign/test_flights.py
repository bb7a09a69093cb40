"""What becomes of a case that goes wrong: a row with its reason, beside the others."""

import numpy as np
import pytest

from ftc_jsb.campaign.adaptive import search_campaign, subset_campaign
from ftc_jsb.campaign.flights import Item, fly_items
from ftc_jsb.campaign.load import load_campaign
from ftc_jsb.campaign.parquet import read_rows
from ftc_jsb.campaign.run import fly_campaign, work_of
from ftc_jsb.campaign.store import opened
from ftc_jsb.errors import RecordingError, UserError
from ftc_jsb.simulation.fly import fly
from ftc_jsb.simulation.series import Series
from tests.campaign.campaign_files import SMALL, campaign_file


def test_a_loop_that_raises_and_a_scenario_that_is_none_are_rows(tmp_path):
    text = SMALL.replace('"no-ftc"]', '"tests.control.my_loop:BrokenLoop"]')
    bases = load_campaign(str(campaign_file(tmp_path, text)))
    rows = fly_items(work_of(bases), [Item(0), Item(1, (7.0, 0.5, 0.5))]).rows
    assert rows[0]["verdict"] is not None
    assert rows[1]["verdict"] == "failed"
    assert "ZeroDivisionError" in rows[1]["reason"]
    assert rows[2]["verdict"] is None
    assert "fault[0].effectiveness" in rows[2]["error"]


def test_what_nobody_foresaw_is_a_row_too(tmp_path, monkeypatch):
    """An error of the program itself, made by a plant that cannot be built."""
    bases = load_campaign(str(campaign_file(tmp_path)))
    monkeypatch.setattr(Series, "fly", lambda _, scenario: fly(scenario, plant=3))
    rows = fly_items(work_of(bases), [Item(0)]).rows
    assert "AttributeError" in rows[0]["error"]


def test_other_versions_do_not_fly_together(tmp_path):
    work = work_of(load_campaign(str(campaign_file(tmp_path))))
    with pytest.raises(UserError, match="another version"):
        fly_items(work._replace(code="older"), [Item(0)])


def test_recordings_that_are_kept(tmp_path):
    bases = load_campaign(str(campaign_file(tmp_path)))
    items = [Item(number) for number in range(6)]
    failed = fly_items(work_of(bases, "failed"), items)
    bad = {(row["case"], f"paper-{row['loop']}") for row in failed.rows if row["margin"] < 0.0}
    assert set(failed.recordings) == bad
    assert len(fly_items(work_of(bases, "all"), items).recordings) == 12


@pytest.fixture(scope="module")
def client():
    """Dask without processes of its own."""
    from distributed import Client, LocalCluster

    with (
        LocalCluster(n_workers=1, threads_per_worker=1, processes=False, dashboard_address=None) as cluster,
        Client(cluster) as connected,
    ):  # fmt: skip
        yield connected


def quiet(done, total, seconds):
    assert done <= total
    assert seconds >= 0.0


def test_stop_rule_ends_a_campaign_at_the_case_it_says(tmp_path, client):
    text = SMALL + "\n[stop]\ninterval_width = 0.9\nevery = 4\n"
    bases = load_campaign(str(campaign_file(tmp_path, text)))
    flown = fly_campaign(bases, tmp_path, client, False, quiet)
    assert (flown.cases, flown.stopped) == (4, True)
    assert {row["case"] for row in read_rows(tmp_path / "results.parquet")} == set(range(4))


SUBSET = "\n[search]\nflights = 20\n\n[subset]\nsamples = 20\nlevels = 2\n"


@pytest.mark.parametrize("fly_it", [search_campaign, subset_campaign])
def test_search_and_rare_event_are_taken_up_again(tmp_path, client, fly_it):
    """Interrupted on the way, they ask the same questions again and fly what was not answered."""
    bases = load_campaign(str(campaign_file(tmp_path, SMALL + SUBSET)))
    one, two = tmp_path / "one", tmp_path / "two"
    one.mkdir()
    two.mkdir()

    def interrupting(done, total, seconds):
        if done >= 10:
            raise KeyboardInterrupt

    whole = fly_it(bases, one, client, False, quiet)
    with pytest.raises(KeyboardInterrupt):
        fly_it(bases, two, client, False, interrupting)
    resumed = fly_it(bases, two, client, True, quiet)
    assert 0 < resumed.flown_now <= whole.cases - 10
    rows = read_rows(one / "results.parquet")
    assert read_rows(two / "results.parquet") == rows
    assert {row["loop"] for row in rows} == {"ftc"}
    other = subset_campaign if fly_it is search_campaign else search_campaign
    with pytest.raises(RecordingError, match="was begun as"):
        other(bases, two, client, True, quiet)


@pytest.mark.parametrize("fly_it", [search_campaign, subset_campaign])
def test_nothing_dispersed_is_nothing_to_search(tmp_path, client, fly_it):
    text = SMALL.split("[[dispersion]]")[0] + SUBSET
    bases = load_campaign(str(campaign_file(tmp_path, text)))
    with pytest.raises(UserError, match="dispersion: missing"):
        fly_it(bases, tmp_path, client, False, quiet)


def test_one_folder_has_one_campaign_and_one_writer(tmp_path):
    bases = load_campaign(str(campaign_file(tmp_path)))
    made = {"code": "this", "purpose": "sampling"}
    out = tmp_path / "out"
    out.mkdir()

    def refused(says, campaign, program, resume):
        with pytest.raises(RecordingError, match=says), opened(out, campaign, program, resume):
            pass

    with opened(out, bases, made, False):
        refused("another process flies", bases, made, True)
    other = bases._replace(campaign=bases.campaign.model_copy(update={"seed": 4}))
    refused("another campaign", other, made, True)
    refused("another version", bases, made | {"code": "that"}, True)


def test_a_case_is_the_flight_of_fly(tmp_path):
    """The row of a case has the numbers of the scenario that its file says."""
    from ftc_jsb.analysis.metrics import flight_metrics
    from ftc_jsb.campaign.case import case_of, scenario_of_case

    bases = load_campaign(str(campaign_file(tmp_path)))
    row = fly_items(work_of(bases), [Item(3)]).rows[0]
    metrics = flight_metrics(fly(scenario_of_case(case_of(bases, 3), "paper", "ftc")))
    for key in ("rmse_airspeed_mps", "verdict", "peak_bank_deg", "detection_delay_s"):
        assert row[key] == metrics[key]
    assert np.isfinite(row["margin"])
