"""Kernels generated from a linearization: SymPy expressions become Numba functions on plain arrays."""

import hashlib
import sys
from collections.abc import Callable, Sequence
from types import ModuleType
from typing import Any, NamedTuple

import numpy as np
import sympy as sp

from ftc_jsb.theory.linearization import Linearization

Kernel = Callable[..., Any]


class Kernels(NamedTuple):
    """Compiled functions of one system. Arguments are float arrays; the last is written to.

    x: (states,); u, u_n, k: (inputs,); p: (parameters,) in the order of `System.parameters`.
    """

    dynamics: Kernel  # (x, u, k, p, out (states,)): F(x, u, k) of (2)
    outputs: Kernel  # (x, p, out (inputs,)): h(x)
    chain: Kernel  # (x, k, p, out (order,)): the x of (15)
    law_terms: Kernel  # (x, u_n, k, p, drift (n,), gain (n, n)): script F and G of (14)
    trim_gain: Kernel  # (x, u_n, k, p, out (states, inputs)): g of (6)
    parameters: Any  # (parameters,) default values


def generate(linearization: Linearization) -> Kernels:
    """Compile the kernels of a system; they are cached under the digest of their source."""
    source = _source(linearization)
    name = f"{linearization.system.name}_{hashlib.sha256(source.encode()).hexdigest()[:12]}"
    module = ModuleType(f"ftc_jsb_generated_{name}")
    sys.modules[module.__name__] = module  # Numba's disk cache looks for it there
    exec(compile(source, f"{name}.py", "exec"), module.__dict__)
    return Kernels(
        module.dynamics,
        module.outputs,
        module.chain,
        module.law_terms,
        module.trim_gain,
        np.array(list(linearization.system.parameters.values()), dtype=float),
    )


def _source(linearization: Linearization) -> str:
    system, approximation = linearization.system, linearization.approximation
    x = ("x", system.states)
    u = ("u", system.inputs)
    trim = ("u_n", approximation.trim)
    k = ("k", system.effectiveness)
    p = ("p", tuple(system.parameters))
    functions = [
        _function("dynamics", (x, u, k, p), (("out", system.faulty_dynamics),)),
        _function("outputs", (x, p), (("out", sp.Matrix(system.outputs)),)),
        _function("chain", (x, k, p), (("out", linearization.chain),)),
        _function(
            "law_terms",
            (x, trim, k, p),
            (("drift", linearization.drift), ("gain", linearization.gain)),
        ),
        _function("trim_gain", (x, trim, k, p), (("out", approximation.g),)),
    ]
    header = [
        f'"""Generated from the system {system.name!r}; see ftc_jsb/theory/generated.py."""',
        "import math",
        "from ftc_jsb.compiled import compiled",
    ]
    return "\n".join([*header, *functions]) + "\n"


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
    matrices = [matrix.subs(plain, simultaneous=True) for _, matrix in results]
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
