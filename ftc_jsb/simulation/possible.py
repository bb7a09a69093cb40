"""Which faults a model of an aircraft can have."""

from ftc_jsb.disturbance.signals import SENSED
from ftc_jsb.point_mass.parameters import load_point_mass
from ftc_jsb.resources import PAPER_AIRCRAFT, aircraft_folder
from ftc_jsb.scenario.schema import SURFACES, Fault, Scenario
from ftc_jsb.six_dof.aircraft import load_aircraft

# A point mass turns without body rates, and has no surfaces
NOT_OF_POINT_MASSES = ("roll_rate", "pitch_rate", "yaw_rate", "elevator_position", "flap_position")


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
        if fault.kind == "stuck" and model != "jsbsim":
            return f"a stuck throttle; the model {model!r} has none, 'jsbsim' has"
    if model == "jsbsim":
        if target in ("load_factor", "bank_angle"):
            return f"{target!r} is a channel of the point masses; 'jsbsim' has surfaces"
        if target in SURFACES and not getattr(load_aircraft(name).surfaces, target):
            return f"aircraft {name!r} has no {target!r} that can fail"
    elif target in SURFACES or (target in SENSED and target in NOT_OF_POINT_MASSES):
        return f"the model {model!r} has no {target!r}; 'jsbsim' has"
    return ""
