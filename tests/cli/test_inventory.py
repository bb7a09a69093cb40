"""`ftc-jsb list`: what is shipped."""

from tests.cli.command import run


def test_list_flies_nothing(tmp_path):
    listed = run("list", cwd=tmp_path).stdout
    for name in ("intermittent", "total-loss", "f16", "ekf"):
        assert name in listed
    assert "paper" in run("list", "aircraft", cwd=tmp_path).stdout
    assert not list(tmp_path.iterdir())
