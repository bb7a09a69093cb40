"""`ftc_jsb/Track-v0`: track references while thrust is lost, as a Gymnasium environment."""

import math
from collections.abc import Mapping
from typing import Any, SupportsFloat

import gymnasium
import numpy as np
import numpy.typing as npt
from gymnasium.spaces import Box

from ftc_jsb.environment.sampled_flight import SampledFlight
from ftc_jsb.environment.vectors import (
    COMPONENTS,
    LARGEST,
    Vector,
    action_command,
    action_ranges,
    observation,
)
from ftc_jsb.recording.flight import Flight
from ftc_jsb.scenario.faults import Fault
from ftc_jsb.scenario.keys import with_value
from ftc_jsb.scenario.load import load_scenario, scenario_of
from ftc_jsb.scenario.schema import Scenario
from ftc_jsb.simulation.departure import FLYING, REASONS

ID = "ftc_jsb/Track-v0"
GOOD = (5.0, math.radians(2.0), math.radians(4.0))  # errors [m/s, rad, rad] that cost 40 %
LEAST_LEFT, MOST_LEFT = 0.4, 0.9  # effectiveness that a random loss of thrust leaves
FIRST, LAST = 0.1, 0.6  # parts of the flight between which it sets in


def register() -> None:
    """Make `ftc_jsb/Track-v0` known to Gymnasium; once is enough."""
    if ID not in gymnasium.registry:
        gymnasium.register(ID, entry_point="ftc_jsb.environment.track:Track")


class Track(gymnasium.Env[Vector, Vector]):
    """Track the references of a scenario.

    Observation: (11,) float32, `vectors.COMPONENTS` over their scales, within +-20, always finite.
    Action: (3,) float32 within +-1: thrust (0 to the aircraft's largest), load factor (0 is 1 g, +-1
    the limits of the structure), bank angle (+-80 deg).
    Reward: 0 to 1 a step, exp(-sum of (error / GOOD)^2 / 2) of the true errors.
    Terminated: the flight departed (`info["reason"]`). Truncated: the scenario's end.
    """

    metadata: dict[str, Any] = {"render_modes": []}  # noqa: RUF012

    def __init__(
        self,
        scenario: str = "paper",
        model: str = "paper",
        hold: int = 5,
        fault_probability: float = 0.8,
        values: Mapping[str, Any] | None = None,
        render_mode: None = None,
    ) -> None:
        """What is flown.

        Args:
            scenario: name or path.
            model: `paper`, `identified` or `jsbsim`.
            hold: samples for which an action is held: 5 are 0.05 s.
            fault_probability: of an episode with a random loss of thrust, in place of the scenario's
                faults; 0 flies the scenario's own.
            values: by dotted key, in place of the scenario's.
            render_mode: there is none.

        Raises:
            UserError: no such scenario, model or key.
            ValueError: `hold` or `fault_probability` out of range.
        """
        if hold < 1 or not 0.0 <= fault_probability <= 1.0:
            raise ValueError("expected hold of 1 or more and fault_probability of 0 to 1")
        self._base = _with_values(load_scenario(scenario), {"model": model, **(values or {})})
        self._hold = hold
        self._probability = fault_probability
        self._flying: SampledFlight | None = None
        self.observation_space = Box(-LARGEST, LARGEST, (len(COMPONENTS),), np.float32)
        self.action_space = Box(-1.0, 1.0, (3,), np.float32)
        self.render_mode = render_mode

    def reset(
        self, *, seed: int | None = None, options: dict[str, Any] | None = None
    ) -> tuple[Vector, dict[str, Any]]:
        """A new episode.

        Args:
            seed: of this and the following episodes: the same seed, the same flights to the bit.
            options: values by dotted key that this episode has, a fault of its own included.
        """
        super().reset(seed=seed)
        self.close()
        scenario = _with_values(self._drawn(), options or {})
        self._flying = SampledFlight(scenario)
        self._ranges = action_ranges(self._flying.setup)
        return self._seen(), self._info()

    def step(
        self, action: npt.ArrayLike
    ) -> tuple[Vector, SupportsFloat, bool, bool, dict[str, Any]]:
        """Hold an action for `hold` samples."""
        flying = self._flight()
        command = action_command(action, self._ranges)
        for _ in range(self._hold):
            if not flying.step(command) or flying.over:
                break
        terminated = flying.reason != FLYING
        reward = 0.0 if terminated else self._reward()
        return self._seen(), reward, terminated, flying.over and not terminated, self._info()

    def recorded(self) -> Flight:
        """The episode so far, as `fly` would have recorded it."""
        return self._flight().flight()

    def close(self) -> None:
        """Release the aircraft."""
        if self._flying is not None:
            self._flying.close()
            self._flying = None

    def _flight(self) -> SampledFlight:
        if self._flying is None:
            raise gymnasium.error.ResetNeeded("call reset() before step()")
        return self._flying

    def _drawn(self) -> Scenario:
        """The scenario with a seed, and perhaps a loss of thrust, of this episode."""
        draw = self.np_random
        changes: dict[str, Any] = {"seed": int(draw.integers(2**31))}
        faulty, left, when = draw.random(), draw.uniform(LEAST_LEFT, MOST_LEFT), draw.random()
        if self._probability > 0.0:
            start = round(self._base.duration * (FIRST + (LAST - FIRST) * when), 2)
            loss = Fault(effectiveness=round(left, 3), start=start)
            changes["fault"] = (loss,) if faulty < self._probability else ()
        return self._base.model_copy(update=changes)

    def _seen(self) -> Vector:
        flying = self._flight()
        return observation(flying.measurement, flying.reference)

    def _reward(self) -> float:
        value = self._flight().value
        names = ("airspeed", "flight_path_angle", "heading")
        errors = [
            (value(name) - value(f"{name}_ref")) / good
            for name, good in zip(names, GOOD, strict=True)
        ]
        return math.exp(-0.5 * sum(error * error for error in errors))

    def _info(self) -> dict[str, Any]:
        flying = self._flight()
        return {
            "time": flying.value("time"),
            "effectiveness_thrust": flying.value("effectiveness_thrust"),
            "reason": REASONS.get(flying.reason, ""),
        }


def _with_values(scenario: Scenario, values: Mapping[str, Any]) -> Scenario:
    """A scenario with other values, by dotted key.

    Raises:
        ScenarioError: no such key, or a value out of its range.
    """
    contents = scenario.model_dump(mode="json", exclude_none=True)
    for key, value in values.items():
        contents = with_value(contents, key, value)
    return scenario_of(contents, f"values of {scenario.name!r}")
