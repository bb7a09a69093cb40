"""Folders for results: writable, empty unless forced, gone again if nothing came of it."""

import pytest

from ftc_jsb.errors import RecordingError
from ftc_jsb.runs.output_folder import output_folder


def test_two_results_of_one_second_have_two_folders(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    with (
        output_folder(None, "paper", False) as first,
        output_folder(None, "paper", False) as second,
    ):
        assert first != second
        assert first.parent == second.parent
        assert first.is_dir()
        assert second.is_dir()


def test_folder_in_which_nothing_was_left_is_removed(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    with output_folder(None, "paper", False):
        pass
    with output_folder(tmp_path / "mine", "paper", False):
        pass
    assert not list(tmp_path.iterdir())


def test_folder_of_the_user_stays(tmp_path):
    mine = tmp_path / "mine"
    mine.mkdir()
    with output_folder(mine, "paper", False):
        pass
    assert mine.is_dir()


def test_message_names_the_key(tmp_path):
    (tmp_path / "thesis.txt").write_text("mine")
    with (
        pytest.raises(RecordingError, match=r"^DIR .*: is not empty"),
        output_folder(tmp_path, "f16", False, "DIR"),
    ):
        pass
