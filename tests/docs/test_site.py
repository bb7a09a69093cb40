"""The site of the documentation is built without a warning: every page has its place, every link leads on."""

import os
import re
import subprocess
import sys
from pathlib import Path

import pytest

ROOT = Path(__file__).parents[2]


def built(folder, configuration=ROOT / "mkdocs.yml"):
    """MkDocs' exit status and messages; the notebooks have a test of their own."""
    return subprocess.run(
        [sys.executable, "-m", "mkdocs", "build", "--strict", "-f", configuration, "-d", folder],
        capture_output=True,
        text=True,
        env={**os.environ, "FTC_JSB_EXECUTE_NOTEBOOKS": "false", "NO_MKDOCS_2_WARNING": "1"},
        check=False,
    )


@pytest.fixture(scope="module")
def site(tmp_path_factory):
    folder = tmp_path_factory.mktemp("site")
    made = built(folder)
    assert made.returncode == 0, made.stderr
    return folder


def text(path):
    """Of a page, without its tags."""
    return re.sub(r"<[^>]+>", "", path.read_text(encoding="utf-8"))


def test_every_key_of_the_files_is_on_its_page(site):
    response = "loop.estimator.response_time"
    scenario = ("duration", "fault[].effectiveness", response, "sensors.SIGNAL.noise_deg")
    campaign = ("sampling", "dispersion[].distribution", "stop.rate_per_hour")
    for kind, keys in (("scenario", scenario), ("campaign", campaign)):
        page = text(site / "reference" / f"{kind}-keys.html")
        assert not [key for key in keys if key not in page]


def test_every_public_name_and_command_is_on_its_page(site):
    import ftc_jsb
    from ftc_jsb.cli.main import main

    page = (site / "reference" / "api.html").read_text(encoding="utf-8")
    anchors = set(re.findall(r'id="ftc_jsb\.[\w.]+\.(\w+)"', page))
    assert set(ftc_jsb.__all__) <= anchors
    page = text(site / "reference" / "cli.html")
    assert not [name for name in main.commands if f"ftc-jsb {name}" not in page]


def test_a_page_asks_for_nothing_from_elsewhere(site):
    """It opens from the disk and behind walls: no fonts, no scripts of others."""
    for page in site.rglob("*.html"):
        fetched = re.findall(
            r"<(?:script|link|img)[^>]*(?:src|href)=\"(https?:[^\"]+)", page.read_text()
        )
        assert not [address for address in fetched if "canonical" not in address], page.name


def test_a_link_that_leads_nowhere_fails_the_build(tmp_path):
    """The check can fail: a page with a wrong file and a wrong heading."""
    (tmp_path / "docs").mkdir()
    (tmp_path / "docs" / "index.md").write_text("# A\n\n[x](nowhere.md) [y](#no-such)\n")
    lines = (ROOT / "mkdocs.yml").read_text().split("validation:")[1].split("theme:")[0]
    (tmp_path / "mkdocs.yml").write_text(f"site_name: x\nvalidation:{lines}")
    made = built(tmp_path / "site", tmp_path / "mkdocs.yml")
    assert made.returncode == 1
    assert "nowhere.md" in made.stderr
    assert "#no-such" in made.stderr
