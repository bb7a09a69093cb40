"""`ftc-jsb figures`: every figure in every format."""

from tests.cli.command import run


def test_figures_of_a_recording_in_one_command(tmp_path):
    run("fly", "paper", "--set", "duration=3", "--out", "a", cwd=tmp_path)
    result = run("figures", "a/flight.nc", "--out", "f", cwd=tmp_path)
    assert result.returncode == 0, result.stderr
    names = {path.name for path in (tmp_path / "f").iterdir()}
    for figure in ("1_states", "2_controls", "3_trajectories", "4_effectiveness"):
        assert {f"figure{figure}.{suffix}" for suffix in ("pdf", "svg", "png")} < names
