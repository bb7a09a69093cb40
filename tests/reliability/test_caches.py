"""A damaged, full or read-only cache costs time and nothing else: what is damaged is made again."""

import errno
import os
import subprocess
import sys
import tempfile
from pathlib import Path

import platformdirs
import pytest

import ftc_jsb.verified_cache as module
from ftc_jsb.aircraft.description import load_aircraft
from ftc_jsb.errors import WriteError
from ftc_jsb.six_dof.weaving.woven_aircraft import woven_aircraft
from ftc_jsb.verified_cache import cache_folders, read_sealed, sealed_folder, write_sealed

# A kernel that calls another, compiled or loaded, and how many files of the cache there are.
KERNEL = """
import sys
from pathlib import Path
from ftc_jsb.compiled import compiled
from ftc_jsb.frames import body_rates
print(*body_rates((0.0, 0.1, 0.2), (0.01, 0.12, 0.2), 0.01))
print(sum(body_rates.stats.cache_hits.values()))
"""

DAMAGES = {
    "zeroed": lambda data: bytes(len(data)),
    "empty": lambda _: b"",
    "truncated": lambda data: data[: len(data) // 2],
    "a bit flipped": lambda data: data[:-200] + bytes([data[-200] ^ 4]) + data[-199:],
    "longer": lambda data: data + b"more",
    "another's": lambda _: b"\x80\x04K\x01.",
}


@pytest.fixture
def caches(tmp_path, monkeypatch):
    """The caches of this process in folders of this test's own: the user's, and the one that stands in."""
    monkeypatch.setattr(platformdirs, "user_cache_dir", lambda name: str(tmp_path / "cache" / name))
    monkeypatch.setattr(tempfile, "tempdir", str(tmp_path / "temporary"))
    (tmp_path / "temporary").mkdir()
    return tmp_path


def kernel(folder, limit="true"):
    """Runs the kernel in a process whose caches are in `folder`; its numbers, and cache hits."""
    places = {"XDG_CACHE_HOME": str(folder / "cache"), "TMPDIR": str(folder / "temporary")}
    (folder / "temporary").mkdir(exist_ok=True)
    shown = subprocess.run(
        ["bash", "-c", f'{limit}; exec "$@"', "-", sys.executable, "-c", KERNEL],
        env={**os.environ, **places}, capture_output=True, text=True, check=False, timeout=120,
    )  # fmt: skip
    assert shown.returncode == 0, shown.stderr
    numbers, hits = shown.stdout.splitlines()
    return numbers, int(hits)


def test_damaged_kernels_are_compiled_again(tmp_path):
    """Each damage to every file; before, a flipped bit ended the process by SIGSEGV."""
    expected, hits = kernel(tmp_path)
    assert hits == 0
    assert kernel(tmp_path) == (expected, 1)
    files = list((tmp_path / "cache").rglob("*.kernel"))
    assert files
    whole = {file: file.read_bytes() for file in files}
    for damage in DAMAGES.values():
        for file, data in whole.items():
            file.write_bytes(damage(data))
        assert kernel(tmp_path) == (expected, 0)
        assert kernel(tmp_path) == (expected, 1)


def test_kernels_stand_in_for_a_cache_that_cannot_be_written(tmp_path):
    """A file in the way of the cache, and a limit on the size of files as a full disk is one."""
    (tmp_path / "cache").write_text("in the way")
    expected, _ = kernel(tmp_path)
    assert kernel(tmp_path) == (expected, 1)
    assert [path.name for path in (tmp_path / "temporary").iterdir()] == [
        f"ftc-jsb-cache-{os.getuid()}"
    ]
    full = tmp_path / "full"
    full.mkdir()
    assert kernel(full, "ulimit -f 0; trap '' XFSZ")[0] == expected
    assert not list(full.rglob("*.part"))


def test_sealed_file_that_was_changed_is_none_and_gone(tmp_path):
    path = tmp_path / "a.kernel"
    for damage in DAMAGES.values():
        write_sealed(path, b"payload" * 100)
        assert read_sealed(path) == b"payload" * 100
        path.write_bytes(damage(path.read_bytes()))
        assert read_sealed(path) is None
        assert not path.exists()


def changes(folder):
    """Every way in which a folder may be other than it was made; each is made in turn."""
    files = sorted(path for path in folder.rglob("*") if path.is_file())
    files[0].write_bytes(files[0].read_bytes() + b"\n")
    yield "changed"
    files[-1].unlink()
    yield "lost"
    (folder / "more.xml").write_text("<more/>")
    yield "added"
    files[0].rename(files[0].with_name("renamed.xml"))
    yield "renamed"


def test_edited_woven_aircraft_is_woven_anew(caches):
    """An `f16.xml` that was edited in the cache used to be flown silently."""
    aircraft = load_aircraft("f16")
    root = woven_aircraft(aircraft, True)
    assert caches / "cache" in root.parents
    before = {path: path.read_bytes() for path in root.rglob("*") if path.is_file()}
    for _ in changes(root):
        assert woven_aircraft(aircraft, True) == root
        assert {p: p.read_bytes() for p in root.rglob("*") if p.is_file()} == before


def test_folder_that_fails_half_way_is_not_there(caches):
    def fail(folder: Path) -> None:
        (folder / "half.xml").write_text("<half/>")
        raise OSError(errno.ENOSPC, os.strerror(errno.ENOSPC))

    with pytest.raises(WriteError, match="No space left"):
        sealed_folder("aircraft/a", fail)
    assert not list(caches.rglob("*.xml"))
    folder = sealed_folder("aircraft/a", lambda new: (new / "a.xml").write_text("<a/>"))
    assert [path.name for path in folder.iterdir()] == ["a.xml"]


def test_stand_in_of_another_user_is_not_used(caches):
    """Whoever can write there could have this program load what they like."""
    _, stand_in = cache_folders()
    stand_in.chmod(0o777)
    assert list(cache_folders()) == [caches / "cache" / "ftc-jsb"]
    stand_in.rmdir()
    stand_in.symlink_to(caches)
    assert list(cache_folders()) == [caches / "cache" / "ftc-jsb"]


def test_two_processes_weave_at_once(tmp_path):
    code = (
        "from ftc_jsb.aircraft.description import load_aircraft\n"
        "from ftc_jsb.six_dof.weaving.woven_aircraft import woven_aircraft\n"
        "print(woven_aircraft(load_aircraft('f16'), True))\n"
    )
    environment = {**os.environ, "XDG_CACHE_HOME": str(tmp_path)}
    both = [
        subprocess.Popen(
            [sys.executable, "-c", code], env=environment, stdout=subprocess.PIPE, text=True
        )
        for _ in range(2)
    ]
    roots = {process.communicate(timeout=120)[0] for process in both}
    assert [process.returncode for process in both] == [0, 0]
    assert len(roots) == 1
    assert module._is_sealed(Path(roots.pop().strip()))
