"""Kernels generated from a linearization: SymPy expressions become Numba functions on plain arrays.

A system's functions are written as a module `system.py` beside a copy of `theory/kernels/`, and the
folder is imported as a package of its own. So each system has the whole loop compiled for its sizes,
and Numba finds it on the disk in the next process.
"""

import hashlib
import importlib.util
import shutil
import sys
from collections.abc import Callable, Iterator, Sequence
from contextlib import contextmanager
from pathlib import Path
from types import ModuleType
from typing import Any, NamedTuple

import numpy as np
import numpy.typing as npt
import sympy as sp

from ftc_jsb.errors import TheoryError
from ftc_jsb.theory.linearization import Linearization
from ftc_jsb.theory.system import System
from ftc_jsb.verified_cache import find_sealed, sealed_folder

Array = npt.NDArray[np.float64]
Kernel = Callable[..., Any]
TEMPLATE = Path(__file__).parent / "kernels"
PARTS = ("system", "discrete_model", "joint_filter", "law", "closed_loop", "error_response")


class Kernels(NamedTuple):
    """Compiled functions of one system. Arguments are float arrays; the last is written to.

    x: (states,); u, u_n, k: (inputs,); p: (parameters,) in the order of `System.parameters`.
    """

    dynamics: Kernel  # (x, u, k, p, out (states,)): F(x, u, k) of (2)
    outputs: Kernel  # (x, p, out (measured,)): what is measured
    chain: Kernel  # (x, k, p, out (order,)): the x of (15)
    law_terms: Kernel  # (x, u_n, k, p, drift (n,), gain (n, m)): script F and G of (14)
    trim_gain: Kernel  # (x, u_n, k, p, out (states, inputs)): g of (6)
    propagate: Kernel  # `kernels/discrete_model.py`
    estimate: Kernel  # `kernels/joint_filter.py`
    law: Kernel  # `kernels/law.py`
    run: Kernel  # `kernels/closed_loop.py`
    respond: Kernel  # `kernels/error_response.py`
    package: str  # that holds them
    scratch: int  # length of the law's working space
    parameters: Array  # (parameters,)
    plant_parameters: Array


def generate(linearization: Linearization, plant: System | None = None) -> Kernels:
    """Write and import the kernels of a system; they compile when they are first called.

    Args:
        linearization: of the model that law and filter have.
        plant: what they fly, if it is another system; its first states are those of the model.

    Raises:
        TheoryError: a plant that does not fit the model.
    """
    if plant is not None:
        _check_plant(linearization.system, plant)
    source = _source(linearization, plant)
    package = _imported(linearization.system.name, source)
    flown = plant or linearization.system
    return imported_kernels(package, _values(linearization.system), _values(flown))


def imported_kernels(package: str, parameters: Array, plant_parameters: Array) -> Kernels:
    """Kernels of a package that `generate` has written.

    Args:
        package: its name.
        parameters: (parameters,), of the model.
        plant_parameters: likewise.

    Raises:
        ImportError: it is not there, or made with other kernels than today's.
    """
    if package not in sys.modules:
        folder = find_sealed(_place(package))
        if folder is None:
            raise ImportError(package)
        source = (folder / "system.py").read_text(encoding="utf-8")
        if not package.endswith(_digest(source)):
            raise ImportError(package)
        sys.modules[package] = _package(package, folder)
    with _no_bytecode():
        parts = {name: importlib.import_module(f"{package}.{name}") for name in PARTS}
    system = parts["system"]
    return Kernels(
        system.dynamics,
        system.outputs,
        system.chain,
        system.law_terms,
        system.trim_gain,
        parts["discrete_model"].propagate,
        parts["joint_filter"].estimate,
        parts["law"].law,
        parts["closed_loop"].run,
        parts["error_response"].respond,
        package,
        parts["law"].SCRATCH,
        parameters,
        plant_parameters,
    )


def _values(system: System) -> Array:
    return np.array(list(system.parameters.values()), dtype=float)


def _imported(name: str, source: str) -> str:
    """Name of the imported package that holds a system's source and the kernels."""
    package = f"ftc_jsb_{_identifier(name)}_{_digest(source)}"
    if package in sys.modules:
        return package

    def fill(folder: Path) -> None:
        for file in TEMPLATE.glob("*.py"):
            shutil.copy(file, folder)
        (folder / "system.py").write_text(source, encoding="utf-8")

    sys.modules[package] = _package(package, sealed_folder(_place(package), fill))
    return package


def _digest(source: str) -> str:
    """Of a system's source and of the kernels beside it."""
    digest = hashlib.sha256(source.encode())
    for file in sorted(TEMPLATE.glob("*.py")):
        digest.update(file.read_bytes())
    return digest.hexdigest()[:12]


def _place(package: str) -> str:
    """Of a package, below the cache."""
    return f"generated/{package}"


@contextmanager
def _no_bytecode() -> Iterator[None]:
    """Imports leave nothing behind: the cache holds sources only, and they are verified."""
    before, sys.dont_write_bytecode = sys.dont_write_bytecode, True
    try:
        yield
    finally:
        sys.dont_write_bytecode = before


def _package(name: str, folder: Path) -> ModuleType:
    path = folder / "__init__.py"
    spec = importlib.util.spec_from_file_location(
        name, path, submodule_search_locations=[str(folder)]
    )
    assert spec is not None
    assert spec.loader is not None
    module = importlib.util.module_from_spec(spec)
    with _no_bytecode():
        spec.loader.exec_module(module)
    return module


def _identifier(name: str) -> str:
    return "".join(letter if letter.isalnum() else "_" for letter in name)


def _check_plant(model: System, plant: System) -> None:
    """Whether a plant has what the loop gives and takes."""
    names = {
        "inputs": (model.inputs, plant.inputs),
        "number of outputs": (len(model.outputs), len(plant.outputs)),
        "number of measured": (len(model.measured), len(plant.measured)),
        "first states": (model.states, plant.states[: len(model.states)]),
    }
    for name, (expected, found) in names.items():
        if expected != found:
            raise TheoryError(f"plant {plant.name!r}: {name} {found}; the model has {expected}")


def _plant_chain(linearization: Linearization, plant: System) -> sp.Matrix:
    """As many derivatives of the plant's outputs as the model's chain has.

    Raises:
        TheoryError: an input of the plant is in one of them.
    """
    chain = []
    for output, index in zip(plant.outputs, linearization.index, strict=True):
        derivative = sp.sympify(output)
        for _ in range(index):
            chain.append(derivative)
            derivative = (
                sp.Matrix([derivative]).jacobian(list(plant.states)) * sp.Matrix(plant.dynamics)
            )[0]
        if chain[-1].free_symbols & set(plant.inputs):
            raise TheoryError(
                f"plant {plant.name!r}: an input reaches output {output} in fewer derivatives than in "
                f"the model, which has index {index}"
            )
    return sp.Matrix(chain)


def _source(linearization: Linearization, plant: System | None) -> str:
    system, approximation = linearization.system, linearization.approximation
    x, p = ("x", system.states), ("p", tuple(system.parameters))
    u, k = ("u", system.inputs), ("k", system.effectiveness)
    trim = ("u_n", approximation.trim)
    terms = (("drift", linearization.drift), ("gain", linearization.gain))
    functions = [
        _function("dynamics", (x, u, k, p), (("out", system.faulty_dynamics),)),
        _function("outputs", (x, p), (("out", sp.Matrix(system.measured)),)),
        _function("chain", (x, k, p), (("out", linearization.chain),)),
        _function("law_terms", (x, trim, k, p), terms),
        _function("trim_gain", (x, trim, k, p), (("out", approximation.g),)),
    ]
    functions += _plant_functions(linearization, plant)
    flown = plant or system
    sizes = (system.states, flown.states, system.inputs, system.outputs, system.measured)
    counts = ", ".join([*(str(len(size)) for size in sizes), str(linearization.order)])
    fallible = tuple(system.inputs.index(symbol) for symbol in system.fallible)
    header = [
        f'"""Generated from the system {system.name!r}; see ftc_jsb/theory/generated.py."""',
        "import math",
        "from ftc_jsb.compiled import compiled",
        f"STATES, PLANT_STATES, INPUTS, OUTPUTS, MEASURED, ORDER = {counts}",
        f"FALLIBLE = {fallible}",
    ]
    return "\n".join([*header, *functions]) + "\n"


def _plant_functions(linearization: Linearization, plant: System | None) -> list[str]:
    if plant is None:
        pairs = ("dynamics", "outputs", "chain")
        return ["\n".join(["", "", *(f"plant_{name} = {name}" for name in pairs)])]
    x, p = ("x", plant.states), ("p", tuple(plant.parameters))
    u, k = ("u", plant.inputs), ("k", plant.effectiveness)
    chain = _plant_chain(linearization, plant)
    return [
        _function("plant_dynamics", (x, u, k, p), (("out", plant.faulty_dynamics),)),
        _function("plant_outputs", (x, p), (("out", sp.Matrix(plant.measured)),)),
        _function("plant_chain", (x, k, p), (("out", chain),)),
    ]


def _function(
    name: str,
    arguments: Sequence[tuple[str, Sequence[sp.Symbol]]],
    results: Sequence[tuple[str, sp.Matrix]],
) -> str:
    """A function that unpacks its arrays, evaluates common subexpressions once and fills results."""
    plain: dict[sp.Symbol, sp.Symbol] = {}
    unpacking = []
    for array, symbols in arguments:
        for position, symbol in enumerate(symbols):
            local = sp.Symbol(f"{array}{position}_", real=True)
            plain[symbol] = local
            unpacking.append(f"    {local} = {array}[{position}]")
    matrices = [matrix.xreplace(plain) for _, matrix in results]
    shared, reduced = sp.cse(matrices, symbols=sp.numbered_symbols("t", real=True))
    printer = sp.printing.pycode
    body = [f"    {symbol} = {printer(value)}" for symbol, value in shared]
    for (target, _), matrix in zip(results, reduced, strict=True):
        for row in range(matrix.rows):
            for column in range(matrix.cols):
                place = f"{row}" if matrix.cols == 1 else f"{row}, {column}"
                if target == "gain" or (target == "out" and name == "trim_gain"):
                    place = f"{row}, {column}"
                body.append(f"    {target}[{place}] = {printer(matrix[row, column])}")
    names = ", ".join([*(array for array, _ in arguments), *(target for target, _ in results)])
    return "\n".join(["", "", "@compiled", f"def {name}({names}):", *unpacking, *body])
