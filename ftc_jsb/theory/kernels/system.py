"""The least system: x' = k u, y = x; `theory/generated.py` writes this module for any other."""

from ftc_jsb.compiled import compiled
from ftc_jsb.vocabulary.kernel_types import Matrix, Vector

STATES, PLANT_STATES, INPUTS, OUTPUTS, MEASURED, ORDER = 1, 1, 1, 1, 1, 1
FALLIBLE = (0,)  # inputs whose effectiveness is estimated


@compiled
def dynamics(x: Vector, u: Vector, k: Vector, p: Vector, out: Vector) -> None:
    """F(x, u, k) of (2)."""
    out[0] = k[0] * u[0]


@compiled
def outputs(x: Vector, p: Vector, out: Vector) -> None:
    """What is measured of the model."""
    out[0] = x[0]


@compiled
def chain(x: Vector, k: Vector, p: Vector, out: Vector) -> None:
    """The x of (15): each tracked output and its derivatives below the index."""
    out[0] = x[0]


@compiled
def law_terms(x: Vector, u_n: Vector, k: Vector, p: Vector, drift: Vector, gain: Matrix) -> None:
    """Script F and G of (14)."""
    drift[0] = 0.0
    gain[0, 0] = k[0]


@compiled
def trim_gain(x: Vector, u_n: Vector, k: Vector, p: Vector, out: Matrix) -> None:
    """The g of (6)."""
    out[0, 0] = k[0]


@compiled
def plant_dynamics(x: Vector, u: Vector, k: Vector, p: Vector, out: Vector) -> None:
    """F of the plant, which may be another system than the model."""
    out[0] = k[0] * u[0]


@compiled
def plant_outputs(x: Vector, p: Vector, out: Vector) -> None:
    """What is measured of the plant."""
    out[0] = x[0]


@compiled
def plant_chain(x: Vector, k: Vector, p: Vector, out: Vector) -> None:
    """Tracked outputs of the plant, with as many derivatives as the model's `chain`."""
    out[0] = x[0]
