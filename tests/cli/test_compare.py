"""`ftc-jsb compare`: what it writes, and its exit code."""

from tests.cli.command import run


def test_compare_writes_everything_and_is_0_whatever_the_verdicts(tmp_path):
    result = run(
        "compare", "paper", "--out", "c", "--set", "duration=25", "--set", "compare.models=['paper']",
        "--set", "limits.error_airspeed=[-0.1,0.1]", cwd=tmp_path,
    )  # fmt: skip
    assert result.returncode == 0, result.stderr
    names = {p.name for p in (tmp_path / "c").iterdir()}
    assert names == {
        "report.html",
        "metrics.json",
        "scenario.toml",
        "figures",
        "paper-ftc.nc",
        "paper-no-ftc.nc",
    }
    assert "limit broken" in (tmp_path / "c" / "report.html").read_text()
