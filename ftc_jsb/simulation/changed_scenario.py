"""Which parts of a scenario may change while it is flown, and what it then is."""

from collections.abc import Sequence

from ftc_jsb.errors import ScenarioError
from ftc_jsb.loops.built_in import BUILT_IN, isolates
from ftc_jsb.scenario.load import override_scenario
from ftc_jsb.scenario.schema import Scenario
from ftc_jsb.simulation.admissible_faults import refuse_unflyable

SCHEDULED = ("airspeed", "flight_path_deg", "heading_deg", "altitude")  # of [reference]
STATES = ("name", "rate", "estimator.channels")  # of [loop]: what its states are made of


def changed_scenario(scenario: Scenario, overrides: Sequence[str]) -> Scenario:
    """The scenario that is flown from some moment on.

    Args:
        scenario: flown up to there.
        overrides: `key=value`; of [reference] its breakpoints, [[fault]], and [loop] but for what
            its states are made of.

    Raises:
        ScenarioError: an override cannot be used, or changes something that cannot change in flight.
    """
    values = scenario.model_dump(mode="json", exclude_none=True)
    changed = override_scenario(values, overrides, f"scenario {scenario.name!r}", "set")
    told = {"title": scenario.title, "description": scenario.description}
    changed = changed.model_copy(update=told)
    allowed = {
        "reference": scenario.reference.model_copy(
            update={name: getattr(changed.reference, name) for name in SCHEDULED}
        ),
        "fault": changed.fault,
        "loop": changed.loop,
    }
    for name in type(scenario).model_fields:
        before = allowed.get(name, getattr(scenario, name))
        if getattr(changed, name) != before:
            raise ScenarioError(
                f"{name}: cannot change in flight; expected keys of fault, loop or reference "
                f"({', '.join(SCHEDULED)})"
            )
    _refuse_other_states(scenario, changed)
    refuse_unflyable(changed)
    return changed


def _refuse_other_states(scenario: Scenario, changed: Scenario) -> None:
    one, other = scenario.loop, changed.loop
    if one == other:
        return
    if one.name not in BUILT_IN:
        raise ScenarioError(f"loop: the settings of {one.name!r} cannot change in flight")
    for key in STATES:
        before, after = one, other
        for part in key.split("."):
            before, after = getattr(before, part), getattr(after, part)
        if before != after:
            raise ScenarioError(f"loop.{key}: cannot change in flight")
    if isolates(other) and not isolates(one):
        raise ScenarioError(
            "loop.isolation.enabled: cannot be switched on in flight; isolation learns from the start"
        )
