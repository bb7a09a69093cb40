"""Kernels as kernels call them: no machine code of their own, and the same numbers from the disk."""

import os
import subprocess
import sys

import numba
import numpy as np
import pytest

from ftc_jsb.called_kernel import CalledLibrary
from ftc_jsb.compiled import compile_called, compiled

pytestmark = pytest.mark.skipif(bool(numba.config.DISABLE_JIT), reason="nothing is compiled")


@compiled
def _halved(value: float) -> float:
    if value < 0.0:
        raise ValueError("negative")
    return 0.5 * value


@compiled
def _quartered(value: float) -> float:
    return _halved(_halved(value))


def test_kernel_that_kernels_call_has_no_machine_code():
    """Python calls it all the same: then it is compiled for Python."""
    assert str(compile_called(_halved, 1.0)) == "float64"
    library = _halved.called.overloads[next(iter(_halved.called.overloads))].library
    assert isinstance(library, CalledLibrary)
    assert library.get_pointer_to_function("any") == 0
    assert _halved(3.0) == 1.5
    assert _quartered(3.0) == 0.75


def test_error_of_a_called_kernel_reaches_python():
    with pytest.raises(ValueError, match="negative"):
        _quartered(-1.0)


LINKED = """
from numba.core import event
from ftc_jsb.compiled import compile_called
from ftc_jsb.frames import body_rates
from ftc_jsb.compiled import direct
given = ((0.0, 0.1, 0.2), (0.01, 0.12, 0.2), 0.01)
compile_called(body_rates, *given)
print(sum(body_rates.called.stats.cache_hits.values()), *direct(body_rates, *given)(*given))
"""


def test_called_kernel_is_loaded_from_the_disk(tmp_path):
    told = []
    for _ in range(2):
        shown = subprocess.run(
            [sys.executable, "-c", LINKED],
            env={**os.environ, "XDG_CACHE_HOME": str(tmp_path)},
            capture_output=True, text=True, check=True, timeout=120,
        )  # fmt: skip
        told.append(shown.stdout.split())
    assert [hits for hits, *_ in told] == ["0", "1"]
    assert told[0][1:] == told[1][1:]
    assert np.isfinite(np.array(told[0][1:], dtype=float)).all()
