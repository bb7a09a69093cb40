"""The report of real flights: self-contained, complete, and in agreement with metrics.json."""

import json
import re

import pytest

from ftc_jsb.metrics import flight_metrics
from ftc_jsb.report import words
from ftc_jsb.report.page import write_report


@pytest.fixture(scope="module")
def written(flown, tmp_path_factory):
    folder = tmp_path_factory.mktemp("report")
    flights = {
        f"{model}-{loop}": flown("paper", f"model={model}", f"loop.name={loop}")
        for model in ("paper", "jsbsim")
        for loop in ("ftc", "no-ftc")
    }
    metrics = write_report(flights, folder, "ftc-jsb compare paper")
    return flights, folder, metrics, (folder / "report.html").read_text()


def test_every_number_of_the_table_is_in_metrics_json(written):
    _, folder, metrics, page = written
    stored = json.loads((folder / "metrics.json").read_text())["flights"]
    assert stored == json.loads(json.dumps(metrics))
    for figure in words.FIGURES:
        row = page.split(f'<th scope="row">{figure.title}')[1].split("</tr>")[0]
        cells = re.findall(r"<td[^>]*>([^<]*)</td>", row)
        assert cells == [words.shown(figure, values) for values in stored.values()]


def test_figures_are_there_as_svg_png_and_pdf(written):
    _, folder, _, page = written
    names = {path.stem for path in (folder / "figures").iterdir()}
    assert {
        "figure1_states",
        "figure2_controls",
        "figure3_trajectories",
        "figure4_effectiveness",
    } < names
    assert "differences" in names
    for name in names:
        for suffix in ("svg", "png", "pdf"):
            assert (folder / "figures" / f"{name}.{suffix}").stat().st_size > 5000
        assert f'<figure id="{name}">' in page


def test_page_needs_no_network_and_ids_are_unique(written):
    """Nothing is loaded from elsewhere; ids of the inlined figures do not clash."""
    page = written[3]
    assert not re.search(r'(src|href)="(https?:)?//', page)
    assert "<script" not in page
    ids = re.findall(r'\bid="([^"]+)"', page)
    assert len(ids) == len(set(ids))
    for target in re.findall(r'(?:xlink:href|href)="#([^"]+)"|url\(#([^)]+)\)', page):
        assert "".join(target) in ids


def test_page_tells_how_to_fly_it_again(written):
    page = written[3]
    assert "ftc-jsb compare paper" in page
    assert "[reference]" in page
    assert "jsbsim 1." in page


def test_recordings_of_different_scenarios_are_told_apart(flown, tmp_path):
    flights = {"one": flown("paper"), "two": flown("severe")}
    write_report(flights, tmp_path, "ftc-jsb report")
    page = (tmp_path / "report.html").read_text()
    assert "Scenario of one<" in page
    assert "Scenario of two<" in page


def test_flight_that_ended_early_and_loop_without_estimate_are_drawn(flown, tmp_path):
    short = flown("paper", "loop.name=integral", "duration=5")
    write_report({"short": short}, tmp_path, "ftc-jsb report")
    assert flight_metrics(short)["effectiveness_thrust_error_rms"] is None
    assert "–" in (tmp_path / "report.html").read_text()
