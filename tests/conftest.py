"""Flights that many tests look at are flown once a process."""

import functools
import os
from collections.abc import Callable

import pytest
from hypothesis import settings

from ftc_jsb.recording.flight import Flight
from ftc_jsb.scenario.load import load_scenario
from ftc_jsb.simulation.fly import fly

# Kernels compile at their first call, so no deadline; the same examples every time.
settings.register_profile("ftc-jsb", deadline=None, derandomize=True)
settings.load_profile("ftc-jsb")

Flown = Callable[..., Flight]

UNCOMPILED = os.environ.get("NUMBA_DISABLE_JIT") == "1"  # `make coverage`
LONGEST_UNCOMPILED = 25.0  # [s] of flight: about half a minute of waiting


def pytest_addoption(parser: pytest.Parser) -> None:
    parser.addoption(
        "--rewrite-golden",
        action="store_true",
        help="rewrite the golden flights of tests/regression",
    )


@functools.cache
def _fly(scenario: str, overrides: tuple[str, ...]) -> Flight:
    loaded = load_scenario(scenario, overrides)
    if UNCOMPILED and loaded.duration > LONGEST_UNCOMPILED:
        pytest.skip("a long flight, with the compiler switched off")
    return fly(loaded)


@pytest.fixture(scope="session")
def flown() -> Flown:
    """Fly a shipped scenario: `flown("paper", "model='jsbsim'", ...)`; the same one only once."""
    return lambda scenario, *overrides: _fly(scenario, overrides)
