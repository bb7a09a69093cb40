"""Fit of the drag polar, the angle of attack and the drag from measured angles."""

from collections.abc import Sequence
from typing import Any, NamedTuple

import numpy as np
import numpy.typing as npt

from ftc_jsb.identify.regression import Array, hats, product, rough, solve
from ftc_jsb.point_mass.atmosphere import standard_atmosphere
from ftc_jsb.units import STANDARD_GRAVITY

MACH_STEP = 0.05
ANGLES_MACH_STEP = (
    0.025  # of the drag from angles: what is left there is the drag rise between knots
)
LIFT_STEP = 0.025
ALPHA_STEP = np.radians(1.0)
ELEVATOR_STEP = np.radians(12.5)
END_SHARE = 0.3  # of a step by which data must go beyond the last regular knot to get one more
BREAK_WIDTH = 0.002  # [-], half the distance of the knots of a break
RIDGE = 1e-5  # of relative drag: decides only what no flight has seen
SMOOTH = 1e-3  # of the polar across Mach knots: what no flight has seen is like its neighbours
ANGLES_SMOOTH = 1e-4  # likewise of the drag from angles, which flights cover densely


class Sample(NamedTuple):
    """Columns of the test flights that the fits need; (samples,) each, SI and rad."""

    lift: Array
    drag: Array  # C_D
    mach: Array
    alpha: Array
    sideslip: Array
    elevator: Array
    flap: Array
    pitch_rate: Array  # q / V


def sample(records: list[npt.NDArray[Any]], area: float) -> Sample:
    """Drag and lift coefficients along test flights, every 5th sample after the first 0.2 s."""
    rows = np.concatenate([record[20::5] for record in records])
    density = np.array([standard_atmosphere(h)[0] for h in rows["altitude"]])
    pressure_area = 0.5 * density * rows["airspeed"] ** 2 * area
    normal = rows["load_factor"] * rows["mass"] * STANDARD_GRAVITY
    return Sample(
        (normal - rows["thrust"] * np.sin(rows["alpha"])) / pressure_area,
        rows["drag"] / pressure_area,
        rows["mach"],
        rows["alpha"],
        rows["sideslip"],
        rows["elevator"],
        rows["flap"],
        rows["pitch_rate"] / rows["airspeed"],
    )


def knots(values: Array, step: float) -> Array:
    """Multiples of `step` inside the values' range (of 99.8 %), and none beyond it."""
    low, high = np.percentile(values, (0.1, 99.9))
    return np.arange(np.ceil(low / step), np.floor(high / step) + 1) * step


def knots_to_the_ends(values: Array, step: float) -> Array:
    """As `knots`, with the ends of the values' range as first and last."""
    low, high = float(values.min()), float(values.max())
    inner = knots(values, step)
    inner = inner[(inner > low + 0.3 * step) & (inner < high - 0.3 * step)]
    return np.concatenate([[low], inner, [high]])


def mach_knots(values: Array, breaks: Sequence[float], step: float = MACH_STEP) -> Array:
    """Mach knots, with a pair of them close to each Mach number at which flaps switch."""
    regular = knots(values, step)
    low, high = np.percentile(values, (1.0, 99.0))
    ends = [low] if regular[0] - low > END_SHARE * step else []
    ends += [high] if high - regular[-1] > END_SHARE * step else []
    regular = np.sort(np.concatenate([regular, ends]))
    pairs = np.array([m + side * BREAK_WIDTH for m in breaks for side in (-1.0, 1.0)])
    near = [np.min(np.abs(m - pairs), initial=np.inf) for m in regular]
    return np.sort(np.concatenate([regular[np.array(near) > 2.0 * BREAK_WIDTH], pairs]))


def between(data: Sample, mach: Array, lift: Array | None = None) -> Sample:
    """The samples between the outermost knots: those beyond would be laid to the charge of the ends."""
    use = (data.mach >= mach[0]) & (data.mach <= mach[-1])
    if lift is not None:
        use &= (data.lift >= lift[0]) & (data.lift <= lift[-1])
    return Sample(*(column[use] for column in data))


def _parabolas(values: Array, terms: int) -> Array:
    return np.stack([values**power for power in range(terms)], axis=1)


class Polar(NamedTuple):
    """Drag polar: a parabola for each Mach knot, and a table on top."""

    mach: Array
    lift: Array
    parabola: Array  # (mach, 3)
    table: Array  # (mach, lift)

    def predict(self, data: Sample) -> Array:
        """C_D of samples."""
        return np.asarray(
            _polar_design(data, self.mach, self.lift)
            @ np.concatenate([self.parabola.ravel(), self.table.ravel()])
        )


def _polar_design(data: Sample, mach: Array, lift: Array) -> Array:
    at_mach = hats(data.mach, mach)
    return np.hstack(
        [
            product(at_mach, _parabolas(data.lift, 3)),
            product(at_mach, hats(data.lift, lift)),
        ]
    )


def fit_polar(data: Sample, breaks: Sequence[float]) -> Polar:
    """C_D(C_L, Mach), least squares of the relative residual.

    Args:
        data: samples whose drag is that without sideslip.
        breaks: Mach numbers at which flaps switch.
    """
    mach, lift = mach_knots(data.mach, breaks), knots(data.lift, LIFT_STEP)
    data = between(data, mach, lift)
    m, n = len(mach), len(lift)
    level = 1.0 / np.mean(data.drag)
    parabola_part = np.hstack([rough(m, 3), np.zeros((max(m - 2, 0) * 3, m * n))])
    table_part = np.hstack([np.zeros((m * n, m * 3)), np.eye(m * n)])
    solution = solve(
        _polar_design(data, mach, lift),
        data.drag,
        1.0 / data.drag,
        [SMOOTH * level * parabola_part, 10.0 * RIDGE * level * table_part],
    )
    return Polar(mach, lift, solution[: 3 * m].reshape(m, 3), solution[3 * m :].reshape(m, n))


def fit_alpha(data: Sample, mach: Array) -> Array:
    """Angle of attack [rad] over (Mach, powers 0..3 of C_L): (mach, 4)."""
    data = between(data, mach)
    design = product(hats(data.mach, mach), _parabolas(data.lift, 4))
    weight = np.full(len(data.alpha), 1.0 / np.radians(1.0))
    penalty = 100.0 * SMOOTH / np.radians(1.0) * 1e-2 * rough(len(mach), 4)
    return solve(design, data.alpha, weight, [penalty]).reshape(len(mach), 4)


class AnglesDrag(NamedTuple):
    """Drag coefficient from measured angles: the terms of `drag.measured_drag_coefficient`."""

    mach: Array
    alpha: Array
    elevator: Array
    mach_alpha: Array
    alpha_elevator: Array
    pitch_rate: Array
    flap: float
    sideslip: Array
    sideslip_squared: float

    def predict(self, data: Sample) -> Array:
        """C_D of samples."""
        return np.asarray(
            _angles_design(data, self.mach, self.alpha, self.elevator)
            @ np.concatenate(
                [
                    self.mach_alpha.ravel(),
                    self.alpha_elevator.ravel(),
                    self.pitch_rate,
                    self.sideslip,
                    [self.flap, self.sideslip_squared],
                ]
            )
        )

    def of_sideslip(self, data: Sample) -> Array:
        """The part of C_D that sideslip makes."""
        slope = hats(data.alpha, self.alpha) @ self.sideslip
        return np.asarray(slope * np.abs(data.sideslip) + self.sideslip_squared * data.sideslip**2)


def _angles_design(data: Sample, mach: Array, alpha: Array, elevator: Array) -> Array:
    at_alpha = hats(data.alpha, alpha)
    return np.hstack(
        [
            product(hats(data.mach, mach), at_alpha),
            product(at_alpha, hats(data.elevator, elevator)),
            at_alpha * data.pitch_rate[:, None],
            at_alpha * np.abs(data.sideslip)[:, None],
            data.flap[:, None],
            data.sideslip[:, None] ** 2,
        ]
    )


def fit_angles_drag(data: Sample, breaks: Sequence[float]) -> AnglesDrag:
    """C_D from Mach, alpha, elevator, pitch rate, flap and sideslip, relative residual."""
    mach = mach_knots(data.mach, breaks, ANGLES_MACH_STEP)
    alpha = knots_to_the_ends(data.alpha, ALPHA_STEP)
    data = between(data, mach)
    elevator = knots_to_the_ends(data.elevator, ELEVATOR_STEP)
    m, n, k = len(mach), len(alpha), len(elevator)
    sizes = np.cumsum([m * n, n * k, n, n, 1, 1])
    level = 1.0 / np.mean(data.drag)
    smooth = np.zeros(((m - 2) * n, sizes[-1]))
    smooth[:, : m * n] = rough(m, n)
    solution = solve(
        _angles_design(data, mach, alpha, elevator),
        data.drag,
        1.0 / data.drag,
        [ANGLES_SMOOTH * level * smooth, RIDGE * np.eye(sizes[-1])],
    )
    table, elevator_table, pitch_rate, sideslip, flap, squared = np.split(solution, sizes[:-1])
    return AnglesDrag(
        mach, alpha, elevator, table.reshape(m, n), elevator_table.reshape(n, k), pitch_rate,
        float(flap[0]), sideslip, float(squared[0]),
    )  # fmt: skip


def relative_residual(predicted: Array, data: Sample) -> Array:
    """(C_D predicted - C_D flown) / C_D flown."""
    return (predicted - data.drag) / data.drag
