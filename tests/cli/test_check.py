"""`ftc-jsb check`: a scenario seen through without flying."""

from tests.cli.command import run


def test_check_flies_nothing(tmp_path):
    result = run("check", "paper", cwd=tmp_path)
    assert result.returncode == 0
    assert "loop no-ftc: found" in result.stdout
    assert not list(tmp_path.iterdir())
