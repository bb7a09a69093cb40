"""What `import ftc_jsb` offers, what it costs, and that every part of it says what it is."""

import inspect
import subprocess
import sys
from pathlib import Path

import pytest

import ftc_jsb as ftc

PINNED = [
    "Campaign", "Command", "Comparison", "Flight", "Identification", "LoopSetup", "Margins",
    "Measurement", "Moment", "Reference", "Scenario", "Sweep", "UserError",
    "campaign", "compare", "fly", "identify", "load", "margins", "scenario", "sweep",
]  # fmt: skip


def test_the_public_names_are_these():
    """A name that is added or taken away is a decision: it changes this list and the changelog."""
    assert ftc.__all__ == PINNED
    stub = (Path(ftc.__file__).with_suffix(".pyi")).read_text(encoding="utf-8")
    assert [line.split(" as ")[1] for line in stub.splitlines() if " as " in line] == PINNED


SIGNATURES = {
    "fly": ["scenario", "model", "loop", "set"],
    "compare": ["scenario", "models", "loops", "set", "progress"],
    "sweep": ["scenario", "values", "models", "loops", "set", "progress"],
    "load": ["path"],
    "scenario": ["name", "set"],
    "campaign": ["file", "folder", "workers", "scheduler", "resume", "search", "progress"],
    "identify": ["aircraft", "progress"],
    "margins": ["name", "model", "airspeed", "altitude", "progress"],
}


@pytest.mark.parametrize("name", SIGNATURES)
def test_arguments_are_these_and_documented(name):
    function = getattr(ftc, name)
    assert list(inspect.signature(function).parameters) == SIGNATURES[name]
    for parameter in SIGNATURES[name]:
        assert f"{parameter}:" in function.__doc__ or name == "load"


def test_names_of_packages_stay_callable_once_they_are_imported():
    """`ftc_jsb.scenario` is a package and a function; an import of the package must not hide the function."""
    import ftc_jsb.margins.condition
    import ftc_jsb.scenario.load

    assert ftc.scenario("paper").name == "paper"
    assert ftc_jsb.scenario.load.scenario_names()
    assert callable(ftc.margins)
    assert callable(ftc.identify)
    assert callable(ftc.campaign)


def test_import_alone_loads_nothing_heavy():
    """0.3 s is wanted; modules are counted in place of seconds, which a busy machine decides."""
    code = "import sys, ftc_jsb; print(*sys.modules)"
    loaded = subprocess.run(
        [sys.executable, "-c", code], capture_output=True, text=True, check=True
    ).stdout.split()
    heavy = {"numpy", "numba", "pydantic", "jsbsim", "matplotlib", "pandas", "xarray", "scipy"}
    assert not heavy.intersection(loaded)
    assert [name for name in loaded if name.startswith("ftc_jsb")] == ["ftc_jsb"]


def test_an_unknown_name_is_an_attribute_error():
    with pytest.raises(AttributeError, match="no attribute 'glide'"):
        ftc.glide  # noqa: B018
