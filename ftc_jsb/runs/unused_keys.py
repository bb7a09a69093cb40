"""Keys that were set for a flight which does not read them."""

from collections.abc import Callable, Sequence
from typing import NamedTuple

from ftc_jsb.loops.built_in import BUILT_IN, tuned_by_sensors
from ftc_jsb.scenario.loop import Loop

_LoopRule = Callable[[Loop], bool]


class _Readers(NamedTuple):
    """Who reads the keys that begin so."""

    key: str
    models: tuple[str, ...] = ("paper", "identified", "jsbsim")
    loop: _LoopRule = lambda _: True


def _protected(loop: Loop) -> bool:
    return BUILT_IN[loop.name].protected


def _robust(loop: Loop) -> bool:
    return BUILT_IN[loop.name].robust


def _estimating(loop: Loop) -> bool:
    return loop.name != "integral"


_READERS = (
    _Readers("aircraft.flight_control", models=("jsbsim",)),
    _Readers("aircraft", models=("identified", "jsbsim")),
    _Readers("simulation.jsbsim_steps", models=("jsbsim",)),
    _Readers("simulation.point_mass_steps", models=("paper", "identified")),
    _Readers("sensors.inner_loop", models=("jsbsim",)),
    _Readers("loop.integral_gains", loop=lambda loop: loop.name == "integral"),
    _Readers("loop.path_gains", loop=lambda loop: loop.name == "path"),
    _Readers("loop.priority", loop=_protected),
    _Readers("loop.drag_correction", loop=_protected),
    _Readers("loop.bank_share", loop=_protected),
    _Readers("loop.feedback", loop=lambda loop: not _robust(loop)),
    _Readers("loop.response_lead", loop=lambda loop: not _robust(loop)),
    _Readers("loop.lead_filter", loop=lambda loop: not _robust(loop)),
    _Readers(
        "loop.estimator.measurement_noise",
        loop=lambda loop: _estimating(loop) and not tuned_by_sensors(loop),
    ),
    _Readers("loop.estimator.response_time", loop=tuned_by_sensors),
    _Readers("loop.estimator", loop=_estimating),
    _Readers("loop.detector", loop=_estimating),
)


def unused_keys(
    overrides: Sequence[str], models: Sequence[str], loops: Sequence[Loop]
) -> list[str]:
    """A sentence for each override that no flight reads; a loop of the user's own may read any key of [loop].

    Args:
        overrides: `key=value`.
        models: that are flown.
        loops: [loop] of each that is flown.
    """
    found = []
    for key in dict.fromkeys(override.partition("=")[0].strip() for override in overrides):
        for readers in _READERS:
            if key != readers.key and not key.startswith((f"{readers.key}.", f"{readers.key}[")):
                continue
            if not set(models) & set(readers.models):
                found.append(f"--set {key}: not read by the model {', '.join(models)}")
            elif not any(loop.name not in BUILT_IN or readers.loop(loop) for loop in loops):
                names = ", ".join(loop.name for loop in loops)
                found.append(f"--set {key}: not read by the loop {names}")
            break
    return found
