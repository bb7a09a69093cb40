"""`ftc-jsb figures`: every figure in every format."""

import re

import pytest

from tests.cli.command import run


def test_figures_of_a_recording_in_one_command(tmp_path):
    run("fly", "paper", "--set", "duration=3", "--out", "a", cwd=tmp_path)
    result = run("figures", "a/flight.nc", "--out", "f", cwd=tmp_path)
    assert result.returncode == 0, result.stderr
    names = {path.name for path in (tmp_path / "f").iterdir()}
    for figure in ("1_states", "2_controls", "3_trajectories", "4_effectiveness"):
        assert {f"figure{figure}.{suffix}" for suffix in ("pdf", "svg", "png")} < names


def test_publisher_asks_for_font_width_and_format(tmp_path):
    """88 mm wide, in DejaVu Serif, as PDF alone; the font is in the file under its own name."""
    run("fly", "paper", "--set", "duration=3", "--out", "a", cwd=tmp_path)
    asked = ("--font", "DejaVu Serif", "--width", "88mm", "--format", "pdf")
    result = run("figures", "a/flight.nc", *asked, "--out", "f", cwd=tmp_path)
    assert result.returncode == 0, result.stderr
    files = list((tmp_path / "f").iterdir())
    assert files
    for path in files:
        assert path.suffix == ".pdf"
        pdf = path.read_bytes()
        assert b"DejaVuSerif" in pdf
        box = re.search(rb"/MediaBox \[ ?0 0 ([\d.]+) ", pdf)
        assert box is not None
        assert float(box[1]) * 25.4 / 72.0 == pytest.approx(88.0, abs=0.01)


@pytest.mark.parametrize(
    ("asked", "said"),
    [
        (("--font", "Nonsuch"), "--font Nonsuch: not installed; expected one of serif"),
        (("--width", "3furlong"), "no width of a figure; expected 1.5 to 40 in"),
        (("--width", "nan"), "no width of a figure"),
        (("--width", "5000mm"), "no width of a figure; expected"),
        (("--format", "bmp"), "'bmp' is not one of"),
    ],
)
def test_what_no_figure_can_have_is_one_sentence(tmp_path, asked, said):
    result = run("figures", "none.nc", *asked, "--out", "f", cwd=tmp_path)
    assert result.returncode == 2
    assert said in result.stderr
    assert "Traceback" not in result.stderr
