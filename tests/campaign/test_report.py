"""From a finished campaign to its summary, its page, and one case again to the bit."""

import json
import re

from ftc_jsb.campaign.parquet import read_rows
from ftc_jsb.scenario.load import load_scenario
from tests.campaign.campaign_files import campaign_file
from tests.cli.command import assert_refused, run


def test_smoke_is_flown_reported_and_flown_again(tmp_path):
    """The shipped campaign: its rows' probabilities, worst cases as files, a rerun without a difference."""
    result = run("campaign", "smoke", "--out", "c", "--workers", "1", cwd=tmp_path)
    assert result.returncode == 0, result.stderr
    assert "Dashboard: http" in result.stderr
    folder = tmp_path / "c"
    rows = read_rows(folder / "results.parquet")
    assert [(row["case"], row["loop"]) for row in rows[:3]] == [
        (0, "ftc"),
        (0, "no-ftc"),
        (1, "ftc"),
    ]
    summary = json.loads((folder / "summary.json").read_text())
    failed = [row for row in rows if row["loop"] == "ftc" and row["verdict"] != "inside limits"]
    assert summary["flights"]["paper-ftc"]["events"]["failure"]["count"] == len(failed)
    assert summary["pairs"][0]["cases"] == 20
    worst = summary["worst"][0]
    assert worst["margin"] == min(row["margin"] for row in rows)
    assert (folder / "recordings" / f"case-{worst['case']:08d}").is_dir()
    scenario = load_scenario(str(folder / worst["file"]))
    assert scenario.loop.name == worst["loop"]
    page = (folder / "report.html").read_text()
    assert f"rerun c --case {worst['case']}" in page
    assert not re.search(r"https?://(?!www\.w3\.org)", page)

    again = run("campaign", "rerun", "c", "--case", str(worst["case"]), cwd=tmp_path)
    assert again.returncode == 0, again.stderr
    names = {path.name for path in (folder / f"case-{worst['case']}").iterdir()}
    assert {"paper-ftc.nc", "paper-no-ftc.nc", "report.html"} <= names

    before = (folder / "report.html").read_bytes()
    (folder / "report.html").unlink()
    assert run("campaign", "report", "c", cwd=tmp_path).returncode == 0
    assert (folder / "report.html").read_bytes() == before
    assert_refused(run("campaign", "rerun", "c", "--case", "20", cwd=tmp_path), "has no case 20")
    assert_refused(run("campaign", "smoke", "--out", "c", cwd=tmp_path), "is not empty")


def test_what_is_wrong_is_one_sentence(tmp_path):
    campaign_file(tmp_path)
    assert_refused(run("campaign", "smoek", cwd=tmp_path), "no campaign 'smoek'")
    assert_refused(run("campaign", "report", "nowhere", cwd=tmp_path), "no campaign there")
    assert_refused(run("campaign", "small.toml", "--resume", cwd=tmp_path), "--resume needs --out")
    result = run("campaign", "small.toml", "--dry-run", cwd=tmp_path)
    assert "12 cases of 2 flights: 24 flights" in result.stdout
    assert "on" in result.stdout
    assert [path.name for path in tmp_path.iterdir()] == ["small.toml"]
