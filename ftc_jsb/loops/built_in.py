"""The built-in outer loops: what makes one differ from another, as settings of one compiled kernel."""

import math
from collections.abc import Callable
from functools import cached_property, partial
from typing import Any, NamedTuple

import numpy as np
import numpy.typing as npt

from ftc_jsb.compiled import direct
from ftc_jsb.control.outer_loop import outer_loop_step
from ftc_jsb.control.protocol import LoopSetup
from ftc_jsb.control.records import (
    ASSUMED_HEALTHY,
    ESTIMATED,
    EXTENDED,
    LOOP_SETTINGS,
    LOOP_STATE,
    NO_ESTIMATOR,
    TRUE,
    UNSCENTED,
    LoopArrays,
)
from ftc_jsb.disturbance.sensors import sensor_errors
from ftc_jsb.estimation.process import OUTPUTS
from ftc_jsb.loops.isolation_settings import isolation_settings
from ftc_jsb.loops.tuning import PATH_CHANNELS, biases, covariances
from ftc_jsb.scenario.loop import Loop
from ftc_jsb.vocabulary.channels import CHANNELS


class Kind(NamedTuple):
    """What makes one built-in loop differ from another."""

    meaning: str
    estimator: int = UNSCENTED
    effectiveness: int = ESTIMATED  # where the law takes it from
    integral: bool = False
    path: bool = False  # tracks position
    robust: bool = False  # covariances from the sensors, accelerometer, errors of the estimate
    protected: bool = True  # upright, inside the envelope, speed first, measured drag paid for


BUILT_IN = {
    "ftc": Kind("UKF estimate in the paper's law (20), with protections that the paper has not"),
    "no-ftc": Kind(
        "as ftc, effectiveness 1 in the law: the same filter and protections",
        effectiveness=ASSUMED_HEALTHY,
    ),
    "law": Kind(
        "the paper's alone: UKF (34), law (20), trim filter (10), nothing added", protected=False
    ),
    "law-no-ftc": Kind(
        "the paper's alone without FTC: effectiveness 1 in the law",
        effectiveness=ASSUMED_HEALTHY,
        protected=False,
    ),
    "oracle": Kind("as ftc, the true effectiveness in the law", effectiveness=TRUE),
    "integral": Kind(
        "as no-ftc, no estimator, integral action", NO_ESTIMATOR, ASSUMED_HEALTHY, integral=True
    ),
    "ekf": Kind("as ftc, with an extended Kalman filter", EXTENDED),
    "robust": Kind(
        "as ftc, for real sensors and turbulence: filter tuned by both, accelerometer", robust=True
    ),
    "path": Kind("as ftc, tracking position: the path that the references make", path=True),
}
RESERVE = 5.0  # [m/s] of airspeed that `robust` spends before it gives up climb and turn
SLOW_ROLL = 1.5  # [rad/s]
PATH_FIRST = 0.75  # share of an aircraft that rolls fast


class CompiledLoop:
    """One of the built-in loops: the compiled kernel with its settings."""

    def __init__(self, setup: LoopSetup, model: npt.NDArray[Any], record: npt.NDArray[Any]) -> None:
        """Args: a loop in BUILT_IN and what it is built from; (1,) MODEL; recording."""
        possible = isolates(setup.settings) and model[0]["measured_mach_count"] > 0
        settings, state = loop_settings(setup, model), np.zeros(1, LOOP_STATE)
        self.arrays = LoopArrays(settings, model, state, True if possible else None)
        channels = setup.settings.estimator.channels
        filters = self.arrays.state[0]["observer"]["filter"]
        filters["count"] = OUTPUTS + len(channels)
        for index, channel in enumerate(channels):
            filters["channel"][index] = CHANNELS.index(channel)
        self._record = record

    @cached_property
    def _step(self) -> Callable[[int], Any]:
        given = (self.arrays, self._record)
        return partial(direct(outer_loop_step, *given, 0), *given)

    def step(self, i: int) -> None:
        """One sample."""
        self._step(i)


def loop_settings(setup: LoopSetup, model: npt.NDArray[Any]) -> npt.NDArray[Any]:
    """[loop] of a scenario as (1,) LOOP_SETTINGS of the built-in loop that it names."""
    loop, dt = setup.settings, setup.dt
    kind = BUILT_IN[loop.name]
    estimator, detector = loop.estimator, loop.detector
    settings = np.zeros(1, LOOP_SETTINGS)
    s = settings[0]
    s["dt"] = dt
    s["estimator"] = kind.estimator
    s["effectiveness"] = kind.effectiveness
    s["gains"] = loop.gains
    s["integral_gains"] = loop.integral_gains if kind.integral else 0.0
    s["track_path"] = kind.path
    s["path_gains"] = loop.path_gains
    if kind.protected:
        s["bank_share"] = bank_share(loop, model)
        s["drag_correction"] = loop.drag_correction
        s["speed_first"] = loop.priority == "speed"
        given = loop.airspeed_reserve
        s["airspeed_reserve"] = given if given is not None else RESERVE if kind.robust else 0.0
        s["upright"] = model[0]["constant_density"] == 0.0  # any aircraft but the paper's
    s["trim_share"] = 1.0 - math.exp(-loop.trim_filter * dt)  # (10), exact for a held command
    s["effectiveness_floor"] = loop.effectiveness_floor
    s["effectiveness_most"] = 1.0 if kind.robust else math.inf
    if loop.response_lead and not kind.robust:  # a lead makes gusts larger
        for axis in range(2):  # a second-order lag is late by 2 z / w
            frequency = model[0]["response_frequency"][axis]
            if frequency > 0.0:
                s["lead"][axis] = 2.0 * model[0]["response_damping"][axis] / frequency
    s["lead_filter"] = loop.lead_filter
    s["lead_share"] = 1.0 - math.exp(-s["lead_filter"] * dt)
    size = len(estimator.process_noise)
    s["process_noise"][:size] = estimator.process_noise
    s["measurement_noise"] = estimator.measurement_noise
    s["initial_covariance"][:size] = estimator.initial_covariance
    tuned = covariances(sensor_errors(setup.sensors), dt)
    if tuned_by_sensors(loop):
        s["process_noise"][:3], s["measurement_noise"] = tuned.process, tuned.measurement
        for place, channel in enumerate(estimator.channels, OUTPUTS):
            if channel != "thrust":  # whose Q follows from the response time
                s["process_noise"][place] = PATH_CHANNELS * dt
        s["initial_covariance"][:3] = tuned.measurement
        s["response_time"] = estimator.response_time
    if kind.robust or estimator.accelerometer:
        s["acceleration_noise"] = tuned.acceleration
        s["angle_noise"] = tuned.angles
        off = biases(sensor_errors(setup.sensors))
        s["acceleration_bias"], s["airspeed_bias"] = off.acceleration, off.airspeed
        s["angle_bias"] = off.angles
    s["feedback"] = kind.robust or loop.feedback == "estimated"
    s["spread"] = estimator.spread
    if estimator.gate:
        from scipy.stats import chi2

        s["gate"] = chi2.ppf(estimator.gate_probability, df=3)
        s["gate_patience"] = estimator.gate_patience
    s["bounded"] = estimator.bounded
    s["detector_margin"] = detector.margin
    s["detector_sigmas"] = detector.sigmas
    s["detector_hold"] = detector.hold
    comparable = model[0]["measured_mach_count"] > 0
    s["isolation"] = isolation_settings(
        sensor_errors(setup.sensors), isolates(loop) and comparable, loop.isolation.false_alarms, dt
    )
    return settings


def isolates(loop: Loop) -> bool:
    """Whether a built-in loop is asked to isolate faults: by its settings, else by its kind."""
    return BUILT_IN[loop.name].robust if loop.isolation.enabled is None else loop.isolation.enabled


def bank_share(loop: Loop, model: npt.NDArray[Any]) -> float:
    """How far the load factor serves the path alone until bank has come.

    An aircraft that rolls slowly would lose more heading by waiting than it gains on its path.

    Args:
        loop: its setting comes first.
        model: (1,) MODEL; its roll rate decides where there is none.
    """
    if loop.bank_share is not None:
        return loop.bank_share
    rate = model[0]["bank_rate_max"]  # [rad/s]; 0 = no limit
    return 0.0 if 0.0 < rate < SLOW_ROLL else PATH_FIRST


def tuned_by_sensors(loop: Loop) -> bool:
    """Whether the covariances of a loop follow from the sensors, and not from its settings."""
    kind = BUILT_IN.get(loop.name)
    return loop.estimator.tuning == "sensors" or (kind is not None and kind.robust)
