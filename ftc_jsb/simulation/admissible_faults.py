"""Which faults a model of an aircraft can have."""

from ftc_jsb.aircraft.description import load_aircraft
from ftc_jsb.aircraft.point_mass_file import load_point_mass
from ftc_jsb.errors import ScenarioError
from ftc_jsb.resources import PAPER_AIRCRAFT, aircraft_folder
from ftc_jsb.scenario.faults import Fault
from ftc_jsb.scenario.schema import Scenario
from ftc_jsb.vocabulary.channels import SURFACES
from ftc_jsb.vocabulary.signals import SENSED

# A point mass turns without body rates, and has no surfaces
SIX_DOF = ("jsbsim", "flightgear")
NOT_OF_POINT_MASSES = (
    "roll_rate",
    "pitch_rate",
    "yaw_rate",
    "elevator_position",
    "flap_position",
    "aileron_position",
    "rudder_position",
)


def impossible(scenario: Scenario, fault: Fault) -> str:
    """Why `scenario.model` cannot have a fault; empty if it can.

    Raises:
        AircraftError: no such aircraft.
    """
    model, target = scenario.model, fault.target
    name = PAPER_AIRCRAFT if model == "paper" else scenario.aircraft.name
    if target.startswith("engine"):
        engines = load_point_mass(aircraft_folder(name)).thrust.engines
        if int(target[7:-1]) >= engines:
            return f"no {target!r}; aircraft {name!r} has {engines}, counted from engine[0]"
        if fault.kind == "stuck" and model not in SIX_DOF:
            return f"a stuck throttle; the model {model!r} has none, 'jsbsim' has"
    if model == "flightgear" and target in SENSED:
        return "a fault of a sensor; what another program flies is measured without fault"
    if model in SIX_DOF:
        if target in ("load_factor", "bank_angle"):
            return f"{target!r} is a channel of the point masses; 'jsbsim' has surfaces"
        if target in SURFACES and not getattr(load_aircraft(name).surfaces, target):
            return f"aircraft {name!r} has no {target!r} that can fail"
    elif target in SURFACES or (target in SENSED and target in NOT_OF_POINT_MASSES):
        return f"the model {model!r} has no {target!r}; 'jsbsim' has"
    return ""


SLOWEST_JSBSIM = 80.0  # [Hz]: the inner loop's bandwidth of 36 1/s with a margin


def refuse_unflyable(scenario: Scenario) -> None:
    """See that the model can have the scenario's faults.

    Raises:
        ScenarioError: it cannot.
    """
    for index, fault in enumerate(scenario.fault):
        reason = impossible(scenario, fault)
        if reason:
            raise ScenarioError(f"fault[{index}].target: {reason}")
    frames = scenario.loop.rate * scenario.simulation.jsbsim_steps
    if scenario.model == "jsbsim" and frames < SLOWEST_JSBSIM:
        raise ScenarioError(
            f"loop.rate x simulation.jsbsim_steps: {frames:g} Hz; the inner loop needs at least "
            f"{SLOWEST_JSBSIM:g} Hz"
        )
