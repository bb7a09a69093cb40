"""What follows from a system is derived once, and anew where anything that it follows from has changed."""

import numpy as np
import pytest
import sympy as sp

from ftc_jsb.theory import derived, generated
from ftc_jsb.theory.derived import derive
from ftc_jsb.theory.system import System

X1, X2, U = sp.symbols("x1 x2 u", real=True)


@pytest.fixture
def cache(tmp_path, monkeypatch):
    """A cache of its own, in which nothing is."""
    for name in ("XDG_CACHE_HOME", "LOCALAPPDATA"):
        monkeypatch.setenv(name, str(tmp_path))
    monkeypatch.setattr("platformdirs.user_cache_dir", lambda name: str(tmp_path / name))


def made(monkeypatch):
    """How often a system is linearised from here on."""
    count = []
    linearize = derived.linearize

    def counted(system):
        count.append(system.name)
        return linearize(system)

    monkeypatch.setattr(derived, "linearize", counted)
    return count


def system(**changed):
    given = {"ranges": {U: (-2.0, 2.0)}, "dynamics": (X2, sp.sinh(U) - X1)} | changed
    return System("remembered", (X1, X2), (U,), {}, outputs=(X1,), **given)


@pytest.mark.usefixtures("cache")
def test_second_derivation_is_read(monkeypatch):
    """The same index, bounds and constants, though the system is another object."""
    count = made(monkeypatch)
    first, second = derive(system()), derive(system())
    assert count == ["remembered"]
    assert second.linearization.index == first.linearization.index == (2,)
    assert second.linearization.drift == first.linearization.drift
    assert second.bounds == first.bounds
    assert second.kernels.package == first.kernels.package
    np.testing.assert_array_equal(second.constants.curvature, first.constants.curvature)


@pytest.mark.usefixtures("cache")
@pytest.mark.parametrize(
    "changed", [{"ranges": {U: (-1.0, 1.0)}}, {"dynamics": (X2, sp.sinh(U) - 2 * X1)}]
)
def test_changed_system_is_derived_anew(monkeypatch, changed):
    derive(system())
    count = made(monkeypatch)
    derive(system(**changed))
    assert count == ["remembered"]


@pytest.mark.usefixtures("cache")
def test_kernels_of_another_version_are_not_taken(monkeypatch):
    """A change of the kernels that are copied for each system: what was generated before is no longer right."""
    package = derive(system()).kernels.package
    monkeypatch.delitem(generated.sys.modules, package)
    monkeypatch.setattr(generated, "_digest", lambda source: "of another")
    with pytest.raises(ImportError):
        generated.imported_kernels(package, np.empty(0), np.empty(0))
