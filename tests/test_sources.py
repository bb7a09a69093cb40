"""Keys of caches follow from the sources of all that a module imports."""

import ast
import importlib.util
import shutil
import subprocess
import sys
from pathlib import Path

import pytest

import ftc_jsb.sources as digests
from ftc_jsb.sources import PACKAGE, source_digest, sources

ROOT = PACKAGE.parent
SAMPLE = "ftc_jsb.simulation.sample"
CHANNELS = PACKAGE / "vocabulary" / "channels.py"
KERNELS = ("@compiled\n", "@inlined\n", "@compiled_in_memory\n")


def name_of(path: Path) -> str:
    parts = path.relative_to(ROOT).with_suffix("").parts
    return ".".join(part for part in parts if part != "__init__")


def modules_with_kernels() -> list[str]:
    texts = {path: path.read_text(encoding="utf-8") for path in PACKAGE.rglob("*.py")}
    return sorted(name_of(path) for path, text in texts.items() if any(k in text for k in KERNELS))


def imports_by_parsing(module: str) -> set[Path]:
    """Files of this package that a module and those it imports name, read from their syntax trees."""
    files = {name_of(path): path for path in PACKAGE.rglob("*.py")} | {"ftc_jsb": None}
    found: set[Path] = set()
    waiting = [files[module]]
    while waiting:
        path = waiting.pop()
        if path is None or path in found:
            continue
        found.add(path)
        for node in ast.walk(ast.parse(path.read_text(encoding="utf-8"))):
            if isinstance(node, ast.ImportFrom):
                assert node.level < 2, f"{path}: imports from above are not followed"
                base = node.module or ""
                if node.level == 1:
                    base = ".".join(part for part in (name_of(path.parent), base) if part)
                names = [base, *(f"{base}.{alias.name}" for alias in node.names)]
            elif isinstance(node, ast.Import):
                names = [alias.name for alias in node.names]
            else:
                continue
            waiting += [files[name] for name in names if name in files]
    return found


@pytest.fixture
def copy(tmp_path):
    """A copy of the package; `digest(module)` and `change(file)` of it, with nothing remembered."""
    package = tmp_path / PACKAGE.name
    shutil.copytree(PACKAGE, package, ignore=shutil.ignore_patterns("__pycache__"))

    class Copy:
        @staticmethod
        def digest(module: str) -> str:
            spec = importlib.util.spec_from_file_location("copied_sources", package / "sources.py")
            copied = importlib.util.module_from_spec(spec)
            spec.loader.exec_module(copied)
            return copied.source_digest(module)

        @staticmethod
        def change(file: str, before: str, after: str) -> None:
            text = (package / file).read_text(encoding="utf-8")
            assert before in text
            (package / file).write_text(text.replace(before, after), encoding="utf-8")

    return Copy


def test_copy_has_the_key_of_the_original(copy):
    assert copy.digest(SAMPLE) == source_digest(SAMPLE)


@pytest.mark.parametrize("module", [SAMPLE, "ftc_jsb.disturbance.faults"])
def test_constant_that_kernels_take_from_elsewhere_changes_their_key(copy, module):
    """The number of engines is compiled into kernels: with another one they must not be found again."""
    before = copy.digest(module)
    copy.change("vocabulary/channels.py", "ENGINES = ", "ENGINES = 1 + ")
    assert copy.digest(module) != before


def test_module_that_nothing_in_a_sample_imports_leaves_its_key(copy):
    before = copy.digest(SAMPLE)
    copy.change("report/page/contents.py", '"""', '"""Changed. ')
    assert copy.digest(SAMPLE) == before
    assert copy.digest("ftc_jsb.report.page.contents") != source_digest(
        "ftc_jsb.report.page.contents"
    )


def test_sample_is_made_from_the_vocabulary():
    assert CHANNELS in sources(SAMPLE)


def test_modules_with_kernels_are_the_ones_that_ask_for_the_compiler():
    """Nothing in the package calls Numba past `compiled.py` and its cache, so no kernel escapes its keys."""
    modules = modules_with_kernels()
    assert len(modules) > 25
    for path in PACKAGE.rglob("*.py"):
        text = path.read_text(encoding="utf-8")
        assert "import numba" not in text or path.name in ("compiled.py", "kernel_cache.py"), path
    for module in modules:
        assert PACKAGE / "compiled.py" in sources(module), module


@pytest.mark.parametrize("module", modules_with_kernels())
def test_sources_of_kernels_are_those_of_the_syntax_tree(module):
    assert set(sources(module)) == imports_by_parsing(module)


def test_every_module_that_a_sample_loads_is_among_its_sources():
    """What Python itself has loaded, but for the packages' own files, which hold one sentence."""
    program = f"import sys, {SAMPLE}; print(*(m for m in sys.modules if m.startswith('ftc_jsb.')))"
    shown = subprocess.run(
        [sys.executable, "-c", program], cwd=ROOT, capture_output=True, text=True, check=True
    )
    known = {name_of(path) for path in sources(SAMPLE)}
    packages = {name_of(path) for path in PACKAGE.rglob("__init__.py")}
    assert not set(shown.stdout.split()) - known - packages


def test_module_outside_the_package_is_its_file_and_what_it_takes_from_here():
    """This file imports `ftc_jsb.sources`; a module that was never imported has no sources."""
    assert sources(__name__) == sorted([Path(__file__), PACKAGE / "sources.py"])
    assert sources("no.such.module") == []


def test_file_edited_under_a_running_process_names_nothing_of_others(monkeypatch):
    """What runs may be the file as it was: kernels of it under the new one's name were flown by others."""
    before = source_digest(SAMPLE)
    monkeypatch.setattr(digests, "STARTED", 0.0)
    for remembered in (digests._contents, digests._imported):
        remembered.cache_clear()
    try:
        assert source_digest(SAMPLE) != before
    finally:
        monkeypatch.undo()
        digests._contents.cache_clear()
        digests._imported.cache_clear()
    assert source_digest(SAMPLE) == before
