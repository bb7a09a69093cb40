"""The figures for print: as they were when they were looked at, column-sized, vector, readable in grey."""

import re
from pathlib import Path

import matplotlib.pyplot as plt
import pytest
from matplotlib.testing.compare import compare_images

from ftc_jsb.report.figures import draw
from ftc_jsb.report.figures.estimates import estimates
from ftc_jsb.report.figures.states import controls, states
from ftc_jsb.report.figures.style import REFERENCE, STYLES
from ftc_jsb.report.figures.trajectories import trajectories

BASELINE = Path(__file__).parent / "baseline"
FIGURES = {
    "figure1_states": states,
    "figure2_controls": controls,
    "figure3_trajectories": trajectories,
    "figure4_effectiveness": estimates,
}
# RMS of 255. matplotlib brings its own FreeType and is pinned, so that the pixels are the same on every machine
# but for rounding; one of the four flights left out is 4.4 to 9.0.
TOLERANCE = 2.0
POINT = 1.0 / 72.0  # in


@pytest.fixture(scope="module")
def flights(flown):
    """The paper's aircraft at two sizes of fault: the same flights whatever is identified anew.

    The second stands in as another model, for figures of two columns.
    """
    flights = {}
    for loop in ("ftc", "no-ftc"):
        flights[f"paper-{loop}"] = flown("paper", f"loop.name={loop}")
        other = flown("paper", f"loop.name={loop}", "fault[0].effectiveness=0.7")
        scenario = other.scenario.model_copy(update={"model": "identified"})
        flights[f"identified-{loop}"] = other._replace(scenario=scenario)
    return flights


@pytest.mark.parametrize("name", FIGURES)
def test_figure_is_as_it_was_looked_at(flights, name, tmp_path, request):
    """RMS of all pixels against the picture in the repository."""
    figure = FIGURES[name](flights)
    drawn, kept = tmp_path / f"{name}.png", BASELINE / f"{name}.png"
    figure.savefig(drawn, dpi=60)
    plt.close(figure)
    if request.config.getoption("--rewrite-golden"):
        kept.parent.mkdir(exist_ok=True)
        kept.write_bytes(drawn.read_bytes())
    assert compare_images(str(kept), str(drawn), TOLERANCE) is None


@pytest.mark.parametrize("name", FIGURES)
def test_a_missing_line_is_noticed(flights, name, tmp_path):
    """The tolerance is tight enough: one flight left out."""
    fewer = {label: flight for label, flight in flights.items() if label != "identified-no-ftc"}
    figure = FIGURES[name](fewer)
    figure.savefig(tmp_path / "fewer.png", dpi=60)
    plt.close(figure)
    kept = BASELINE / f"{name}.png"
    assert compare_images(str(kept), str(tmp_path / "fewer.png"), TOLERANCE) is not None


def test_figures_of_one_recording_are_as_wide_as_a_column(flown, tmp_path):
    """Vector PDF of 3.5 in with fonts that publishers take, SVG with text as text, PNG of 300 dots an inch."""
    drawn = draw.draw_all({"paper-ftc": flown("paper", "duration=25")}, tmp_path)
    assert {"figure1_states", "figure2_controls", "figure3_trajectories"} < set(drawn)
    for name in drawn:
        pdf = (tmp_path / f"{name}.pdf").read_bytes()
        box = re.search(rb"/MediaBox \[ ?0 0 ([\d.]+) ([\d.]+) ?\]", pdf)
        assert box is not None
        assert float(box[1]) * POINT == pytest.approx(3.5)
        assert b"/Subtype /Image" not in pdf
        assert b"/CIDFontType2" in pdf
        assert b"/Type3" not in pdf
        assert "<text" in (tmp_path / f"{name}.svg").read_text()
        width, _ = plt.imread(tmp_path / f"{name}.png").shape[1::-1]
        assert width == round(3.5 * 300)


def test_figures_of_two_scenarios_are_in_a_folder_each(flown, tmp_path, monkeypatch):
    monkeypatch.setattr(draw, "_figures", lambda flights, wide: {"figure1_states": states(flights)})
    flights = {"a": flown("paper", "duration=25"), "b": flown("severe", "duration=25")}
    drawn = draw.draw_all(flights, tmp_path)
    assert "paper/figure1_states" in drawn
    assert (tmp_path / "severe" / "figure1_states.pdf").exists()


def test_lines_are_told_apart_in_grey():
    """Okabe and Ito's colours are alike in luminance: it is the dashes that differ, every one."""
    assert len({str(style["linestyle"]) for style in STYLES}) == len(STYLES)


def insets(figure):
    return [child for axes in figure.axes for child in axes.child_axes]


def test_the_fault_is_magnified_where_no_line_is_covered(flights):
    """An inset a model around 20 s; no sample of its panel is behind it."""
    figure = states(flights)
    figure.canvas.draw()
    found = insets(figure)
    assert len(found) == 2
    for inset in found:
        low, high = inset.get_xlim()
        assert low < 20.0 < high
        assert high - low < 10.0
        panel = next(axes for axes in figure.axes if inset in axes.child_axes)
        frame = inset.get_window_extent()
        for line in panel.get_lines():
            points = panel.transData.transform(line.get_xydata())
            assert not any(frame.contains(*point) for point in points)
    plt.close(figure)


def test_a_flight_without_a_fault_has_no_inset(flown):
    figure = states({"healthy": flown("nominal")})
    assert insets(figure) == []
    plt.close(figure)


def test_panels_are_lettered_in_reading_order(flights):
    figure = states(flights)
    letters = [text.get_text() for axes in figure.axes for text in axes.texts]
    assert letters == [f"({letter})" for letter in "abcdef"]
    plt.close(figure)


def test_reference_path_is_drawn_in_space(flights):
    """One thin dark line a model beside its flights."""
    figure = trajectories(flights)
    for axes in figure.axes:
        widths = [
            line.get_linewidth()
            for line in axes.get_lines()
            if line.get_color() == REFERENCE["color"]
        ]
        assert widths == [REFERENCE["linewidth"]]
    plt.close(figure)
