"""A file is there whole or not at all: whatever fails, whenever the process dies, whoever else writes."""

import errno
import os
import signal
import subprocess
import sys
from pathlib import Path

import pytest

from ftc_jsb.atomic_file import (
    PART,
    atomic_contents,
    atomic_file,
    atomic_folder,
    remove_parts,
    write_text,
)
from ftc_jsb.errors import WriteError


def write_half(way, where):
    """Begin to write by one of the ways, and fail."""
    with way(where) as new:
        (new / "a.txt" if new.is_dir() else new).write_text("half")
        raise ZeroDivisionError


def failing(number):
    def fail(*_arguments, **_named):
        raise OSError(number, os.strerror(number))

    return fail


@pytest.mark.parametrize("call", ["fsync", "replace"])
@pytest.mark.parametrize("number", [errno.ENOSPC, errno.EIO])
def test_failing_disk_leaves_the_old_file_and_nothing_else(tmp_path, monkeypatch, call, number):
    path = tmp_path / "a.txt"
    write_text(path, "old")
    monkeypatch.setattr(os, call, failing(number))
    with pytest.raises(WriteError, match=os.strerror(number)):
        write_text(path, "new")
    monkeypatch.undo()
    assert path.read_text() == "old"
    assert list(tmp_path.iterdir()) == [path]


def test_work_that_raises_leaves_the_old_file(tmp_path):
    path = tmp_path / "a.txt"
    write_text(path, "old")
    with pytest.raises(ZeroDivisionError):
        write_half(atomic_file, path)
    assert path.read_text() == "old"
    assert list(tmp_path.iterdir()) == [path]


def test_finished_file_is_not_replaced_unasked(tmp_path):
    """Also not by one that was begun before it was there."""
    path = tmp_path / "a.txt"
    mine = atomic_file(path, replace=False)
    mine.__enter__().write_text("mine")
    write_text(path, "another's")
    with pytest.raises(WriteError, match="exists"):
        mine.__exit__(None, None, None)
    assert path.read_text() == "another's"
    assert list(tmp_path.iterdir()) == [path]


def test_two_who_write_one_file_do_not_see_each_others(tmp_path):
    path = tmp_path / "a.txt"
    with atomic_file(path) as first, atomic_file(path) as second:
        assert first != second
        first.write_text("first")
        second.write_text("second")
    assert path.read_text() == "first"  # the last to finish


def test_killed_process_leaves_no_file_of_that_name(tmp_path):
    path = tmp_path / "a.txt"
    code = (
        "import os, signal, sys; from pathlib import Path\n"
        "from ftc_jsb.atomic_file import atomic_file\n"
        "with atomic_file(Path(sys.argv[1])) as part:\n"
        "    part.write_text('half'); os.kill(os.getpid(), signal.SIGKILL)\n"
    )
    died = subprocess.run([sys.executable, "-c", code, str(path)], check=False)
    assert died.returncode == -signal.SIGKILL
    assert not path.exists()
    assert [left.suffix for left in tmp_path.iterdir()] == [PART]
    remove_parts(tmp_path)
    assert not list(tmp_path.iterdir())


def test_folder_comes_whole_or_not_at_all(tmp_path):
    path = tmp_path / "woven"
    with pytest.raises(ZeroDivisionError):
        write_half(atomic_folder, path)
    assert not list(tmp_path.iterdir())
    with atomic_folder(path) as new:
        (new / "a.xml").write_text("<a/>")
    assert [file.relative_to(tmp_path) for file in tmp_path.rglob("*.xml")] == [Path("woven/a.xml")]


def test_folder_of_another_process_is_kept(tmp_path):
    path = tmp_path / "woven"
    with atomic_folder(path) as new:
        (new / "a.xml").write_text("mine")
        path.mkdir()
        (path / "a.xml").write_text("another's")
    assert (path / "a.xml").read_text() == "another's"
    assert list(tmp_path.iterdir()) == [path]


def test_contents_of_a_folder_change_together_or_not(tmp_path):
    write_text(tmp_path / "a.txt", "old")
    with pytest.raises(ZeroDivisionError):
        write_half(atomic_contents, tmp_path)
    assert (tmp_path / "a.txt").read_text() == "old"
    with atomic_contents(tmp_path) as new:
        (new / "sub").mkdir()
        (new / "sub" / "b.txt").write_text("b")
        (new / "a.txt").write_text("new")
    assert {p.name for p in tmp_path.iterdir()} == {"a.txt", "sub"}
    assert (tmp_path / "a.txt").read_text() == "new"
