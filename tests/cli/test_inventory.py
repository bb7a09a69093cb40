"""`ftc-jsb list`: what is shipped."""

import json

from tests.cli.command import run


def test_list_flies_nothing(tmp_path):
    listed = run("list", cwd=tmp_path).stdout
    for name in ("intermittent", "total-loss", "f16", "ekf"):
        assert name in listed
    assert "paper" in run("list", "aircraft", cwd=tmp_path).stdout
    assert not list(tmp_path.iterdir())


def test_list_for_machines(tmp_path):
    listed = json.loads(run("list", "loops", "--json", cwd=tmp_path).stdout)
    assert list(listed) == ["loops"]
    assert "robust" in listed["loops"]
