"""`ftc-jsb report`: recordings that exist, and one that is none."""

from tests.cli.command import assert_refused, run


def test_report_of_recordings_and_of_a_broken_one(tmp_path):
    run("fly", "paper", "--set", "duration=3", "--out", "a", cwd=tmp_path)
    (tmp_path / "bad.nc").write_text("no")
    result = run("report", "a/flight.nc", "bad.nc", "--out", "r", cwd=tmp_path)
    assert_refused(result, "bad.nc: not a readable NetCDF file")
    assert "bad.nc: not a readable NetCDF file" in (tmp_path / "r" / "report.html").read_text()
