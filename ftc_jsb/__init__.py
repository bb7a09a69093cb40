"""Fault-tolerant flight control of Zhou et al. (2014) on a point mass and on JSBSim fighters.

The public API (docs/python.md). It is imported when it is used: `import ftc_jsb` alone loads nothing.
"""

import inspect
import sys
from importlib import import_module
from types import ModuleType
from typing import Any

__version__ = "0.1.0"

__all__ = [
    "Campaign",
    "Command",
    "Comparison",
    "Flight",
    "Identification",
    "LoopSetup",
    "Margins",
    "Measurement",
    "Moment",
    "Reference",
    "Scenario",
    "Sweep",
    "UserError",
    "campaign",
    "compare",
    "fly",
    "identify",
    "load",
    "margins",
    "scenario",
    "sweep",
]

_API = f"{__name__}.api"
_ALSO_PACKAGES = ("campaign", "identify", "margins", "scenario")  # functions of the API, too


def _public(name: str) -> Any:
    return getattr(import_module(_API), name)


class _CallablePackage(ModuleType):
    """A package that has the name of a function of the API: called, it is that function."""

    def __call__(self, *arguments: Any, **named: Any) -> Any:
        return self._function(*arguments, **named)

    @property
    def _function(self) -> Any:
        return _public(self.__name__.rpartition(".")[2])

    @property
    def __doc__(self) -> str | None:  # type: ignore[override]
        return str(self._function.__doc__)

    @property
    def __signature__(self) -> inspect.Signature:
        return inspect.signature(self._function)


class _Package(ModuleType):
    """This package: an import of a package below it sets an attribute here, which must stay callable."""

    def __setattr__(self, name: str, value: Any) -> None:
        if name in _ALSO_PACKAGES and isinstance(value, ModuleType):
            value.__class__ = _CallablePackage
        super().__setattr__(name, value)


sys.modules[__name__].__class__ = _Package


def __getattr__(name: str) -> Any:
    if name in _ALSO_PACKAGES:
        return import_module(f"{__name__}.{name}")
    if name in __all__:
        return _public(name)
    raise AttributeError(f"module {__name__!r} has no attribute {name!r}")


def __dir__() -> list[str]:
    return sorted({*globals(), *__all__})
