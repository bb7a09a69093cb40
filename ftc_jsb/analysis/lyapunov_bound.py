"""The proof of section 4.2 along a flight of the paper's aircraft: predicted, and whether it obeys.

The prediction knows the scenario: references, faults as they are written there, the filter's
settings, Table 1. It flies the loop of section 3, which is told state and fault, and takes from the
flight that it judges nothing but the first error.
"""

from functools import lru_cache
from typing import Any, NamedTuple

import numpy as np
import numpy.typing as npt

from ftc_jsb.analysis.fighter_constants import fighter
from ftc_jsb.errors import TheoryError
from ftc_jsb.recording.flight import Flight
from ftc_jsb.scenario.schema import Scenario
from ftc_jsb.simulation.fly import fly
from ftc_jsb.theory.error_envelope import FilterModel, Nominal, error_envelope, response
from ftc_jsb.theory.gains import Gains, given_gains
from ftc_jsb.theory.kernels.joint_filter import FilterSettings
from ftc_jsb.theory.lyapunov import (
    Assumptions,
    Flown,
    LyapunovBound,
    disturbance_bound,
    lyapunov_bound,
)
from ftc_jsb.theory.proof import EFFECTIVENESS_FLOOR, FLOOR, step_bound
from ftc_jsb.vocabulary.channels import CHANNELS, TRACKED

Array = npt.NDArray[np.float64]
TRACK_VELOCITY = ("ftc", "no-ftc", "oracle", "ekf")  # whose error obeys e' = (A - B K) e + B d
FEWEST = 3  # samples
FIXED = 1e-20  # variance of an effectiveness that the filter has no state for
ERROR_SCALE = np.array(
    [1.0, np.radians(1.0), np.radians(1.0)]
)  # 1 m/s, 1 deg, 1 deg: (40) adds them


def proof_along(flight: Flight) -> LyapunovBound | None:
    """The proof's quantities; None for a flight that the proof is not about, or one too short.

    It is about the model that its law has: the paper's point mass, without sensors' errors and wind.
    """
    scenario = flight.scenario
    loop = scenario.loop
    if scenario.model != "paper" or loop.name not in TRACK_VELOCITY or min(loop.gains) <= 0.0:
        return None
    whole = round(scenario.duration * loop.rate) + 1
    if flight.record.size < FEWEST or flight.record.size != whole or flight.commands:
        return None
    try:
        return flight_stability(flight)
    except TheoryError:
        return None


def flight_stability(flight: Flight, young: float = 0.5) -> LyapunovBound:
    """V(t) and its bound along a flight of the model `paper`, errors scaled by 1 m/s and 1 deg.

    Args:
        flight: with the gains of its scenario.
        young: mu_1 as a part of its upper limit.

    Raises:
        TheoryError: the loop of section 3 does not fly the scenario to its end.
    """
    record, scenario = flight.record, flight.scenario
    assumptions = _assumptions(flight)
    wanted = _columns(record, [f"{name}_ref_rate" for name in TRACKED])
    rate = np.abs(np.gradient(wanted, flight.row_period, axis=0))
    known = fighter()
    k = np.diag(scenario.loop.gains)
    bound = disturbance_bound(known.constants, k, assumptions, rate, flight.row_period)
    gains: Gains = given_gains(np.zeros((3, 3)), np.eye(3), k)
    return lyapunov_bound(
        _flown(record, scenario),
        bound / ERROR_SCALE,
        assumptions,
        (np.zeros((3, 3)), np.eye(3)),
        gains,
        young,
    )


def _flown(record: npt.NDArray[Any], scenario: Scenario) -> Flown:
    command = _columns(record, ["thrust_cmd", "load_factor_demand", "bank_angle_demand"])
    state, reference = _columns(record, TRACKED), _columns(record, [f"{n}_ref" for n in TRACKED])
    truth = _columns(record, [f"effectiveness_{name}" for name in CHANNELS])
    if scenario.loop.name == "oracle":
        known = np.concatenate([state, truth], axis=1)
    else:
        names = [f"{name}_est" for name in TRACKED]
        told = np.ones_like(truth)
        if scenario.loop.name != "no-ftc":
            told = _columns(record, [f"effectiveness_{name}_est" for name in CHANNELS])
            told[np.isnan(told)] = 1.0
        known = np.concatenate([_columns(record, names), told], axis=1)
        known[:, :3] = np.where(np.isnan(known[:, :3]), state, known[:, :3])
    held = (record["thrust_saturated"] > 0) | (record["load_factor_saturated"] > 0)
    unlimited = np.where(held[:, None], np.inf, command)
    trim = _columns(record, [f"trim_input_{name}" for name in CHANNELS])
    error = (state - reference) / ERROR_SCALE
    return Flown(record["time"], error, state, truth, known, unlimited, command, trim)


def _assumptions(flight: Flight) -> Assumptions:
    scenario, known = flight.scenario, fighter()
    as_oracle = scenario.loop.model_copy(update={"name": "oracle"})
    told = scenario.model_copy(update={"loop": as_oracle})
    nominal = _expected(told.model_dump_json())
    if len(nominal.truth) != flight.record.size:
        raise TheoryError("the loop of section 3 does not fly this scenario to its end")
    envelope = nominal.envelope.copy()
    if scenario.loop.name == "no-ftc":
        envelope[:, 3:] = 1.0 - nominal.truth + EFFECTIVENESS_FLOOR
    return Assumptions(envelope, nominal.step, np.zeros(3), known.low, known.high)


class _Expected(NamedTuple):
    """What is expected of a scenario, whichever loop flies it."""

    truth: Array  # (rows, 3), effectiveness
    envelope: Array  # (rows, 6), of x^ - x and k^ - k
    step: Array  # (rows, 3), of u - u_n


@lru_cache(maxsize=4)
def _expected(text: str) -> _Expected:
    """From a flight of section 3 of a scenario (as JSON), and one whose law never hears of a loss."""
    scenario = Scenario.model_validate_json(text)
    loop, known = scenario.loop, fighter()
    unknowing = loop.model_copy(update={"name": "no-ftc"})
    nominal = [fly(scenario), fly(scenario.model_copy(update={"loop": unknowing}))]
    rows = min(len(each.record) for each in nominal)
    flown = [_flown(each.record[:rows], scenario) for each in nominal]
    model = _filter_of_all_channels(scenario)
    floor = np.concatenate([FLOOR * (known.high - known.low)[:3], [EFFECTIVENESS_FLOOR] * 3])
    truth = flown[0].effectiveness
    responses = [response(model, Nominal(each.state, each.command), truth) for each in flown]
    envelope = error_envelope(responses, floor, noisy=False)
    scale = np.maximum(np.abs(known.low), np.abs(known.high))[3:]
    steps = [np.abs(each.command - each.trim) for each in flown]
    return _Expected(truth, envelope, step_bound(steps, loop.trim_filter, 1.0 / loop.rate, scale))


def _filter_of_all_channels(scenario: Scenario) -> FilterModel:
    """The scenario's filter, each effectiveness in its state; those not estimated do not move."""
    estimator, loop, kernels = scenario.loop.estimator, scenario.loop, fighter().kernels
    q, p0 = np.full(6, FIXED), np.full(6, FIXED)
    places = [0, 1, 2, *(3 + CHANNELS.index(channel) for channel in estimator.channels)]
    q[places], p0[places] = estimator.process_noise, estimator.initial_covariance
    settings = FilterSettings(
        q,
        np.array(estimator.measurement_noise, float),
        float(len(q)),
        loop.effectiveness_floor if estimator.bounded else 0.0,
        1.0 / loop.rate,
        loop.name == "ekf",
    )
    return FilterModel(kernels.respond, kernels.parameters, (0, 1, 2), settings, p0)


def _columns(record: npt.NDArray[Any], names: Any) -> Array:
    return np.stack([record[name] for name in names], axis=1)


def stability_metrics(proof: LyapunovBound | None) -> dict[str, Any] | None:
    """lambda, phi, the ball, bound and largest error, scaled by 1 m/s and 1 deg."""
    if proof is None:
        return None
    return {
        "decay_rate_per_s": proof.rate,
        "disturbance": proof.disturbance,
        "ball_radius": proof.radius,
        "predicted_error": float(proof.predicted.max()),
        "largest_error": float(proof.error.max()),
        "bound_obeyed": proof.obeyed,
        "assumptions_broken": list(proof.broken),
    }
