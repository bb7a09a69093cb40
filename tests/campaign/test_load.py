"""Campaign files: what is shipped is valid, what is wrong is refused with file, key and expectation."""

import pytest

from ftc_jsb.campaign.load import campaign_names, load_campaign, packed, unpacked, write_campaign
from ftc_jsb.errors import UserError
from tests.campaign.campaign_files import SMALL, campaign_file


@pytest.mark.parametrize("name", campaign_names())
def test_shipped_campaign_is_valid(name):
    assert load_campaign(name).campaign.name == name


def test_campaign_that_is_written_is_the_same_campaign(tmp_path):
    bases = load_campaign(str(campaign_file(tmp_path)))
    folder = tmp_path / "out"
    folder.mkdir()
    write_campaign(bases, folder)
    again = load_campaign(str(folder / "campaign.toml"))
    assert again.scenarios == bases.scenarios
    assert again.campaign.dispersion == bases.campaign.dispersion
    assert unpacked(packed(bases)) == bases


@pytest.mark.parametrize(
    ("before", "after", "says"),
    [
        ("cases = 12", "", "cases: missing"),
        ("cases = 12", "cases = 0", "cases: input should be greater than or equal to 1"),
        ("cases = 12", 'sampling = "grid"', "dispersion[0].points: a grid needs it"),
        ("seed = 3", "sead = 3", "unknown key 'sead'; did you mean 'seed'?"),
        ('"paper"]\nmodels', '"papper"]\nmodels', "no scenario 'papper'; expected one of"),
        ('"ftc", "no-ftc"', '"ftc", "none"', "loop.name: no loop 'none'"),
        ('"ftc", "no-ftc"', '"ftc", "ftc"', "loops: an entry is given twice"),
        ("low = 0.2", "low = 1.2", "low must be less than high (got 1.2 and 1)"),
        ("low = 0.2", "", "the distribution 'uniform' needs the key 'low'"),
        ("low = 0.2", "low = 0.2\nmean = 1", "mean: the distribution 'uniform' does not take it"),
        ("low = 0.2", "low = -4", "dispersion[0]: fault[0].effectiveness: input should be greater"),
        ("[0].effectiveness", "[0].efectiveness", "unknown key 'fault[0].efectiveness'"),
        ("[0].effectiveness", "[3].effectiveness", "dispersion[0]: fault has 1 entries"),
        ("[0].effectiveness", "x", "unknown key 'faultx'"),
        ("fault[0].start", "manoeuvre.path_deg", "the campaign has no section [manoeuvre]"),
        ('"tactical"]', '"tactcal"]', "dispersion[2]: sensors.profile: input should be"),
        ('"tactical"]', '"tactical"]\nlabels = ["a"]', "labels: expected one for each of 2 values"),
        ('"tactical"]', '"tactical"]\napply = "scale"', "values: only numbers can scale"),
        ('"uniform"', '"unifrom"', "dispersion[0].distribution: input should be 'uniform'"),
    ],
)  # fmt: skip
def test_what_is_wrong_is_one_sentence(tmp_path, before, after, says):
    assert before in SMALL
    path = campaign_file(tmp_path, SMALL.replace(before, after))
    with pytest.raises(UserError) as refusal:
        load_campaign(str(path))
    assert says in str(refusal.value)
    assert "\n" not in str(refusal.value)


def test_unknown_campaign_names_those_that_are_shipped():
    with pytest.raises(UserError, match=r"no campaign 'smoek' .*'smoke'.*; shipped are .*smoke"):
        load_campaign("smoek")
