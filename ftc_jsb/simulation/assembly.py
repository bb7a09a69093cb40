"""What a flight is made of: aircraft, plant, loop, command filter, sensors, and a blank recording."""

import math
from typing import Any, NamedTuple

import numpy as np
import numpy.typing as npt

from ftc_jsb.aircraft.point_mass_file import PointMass, load_point_mass
from ftc_jsb.aircraft.wrong_model import wrong_model
from ftc_jsb.control.altitude_hold import altitude_hold
from ftc_jsb.control.command_filter import command_filter
from ftc_jsb.control.protocol import LoopSetup
from ftc_jsb.disturbance.faults import fault_records, schedule
from ftc_jsb.disturbance.sensors import Instruments, sensor_record
from ftc_jsb.disturbance.weather import wind_record
from ftc_jsb.errors import ScenarioError
from ftc_jsb.loops.registry import RecordedLoop, build_loop
from ftc_jsb.recording.columns import ROW, numbers
from ftc_jsb.resources import PAPER_AIRCRAFT, aircraft_folder
from ftc_jsb.scenario.reference import climb_of, filter_lag, raw_commands
from ftc_jsb.scenario.schema import Scenario
from ftc_jsb.simulation.plant import Plant
from ftc_jsb.simulation.sample import LoopInputs

OUTPUTS = ("airspeed", "flight_path_angle", "heading")  # y of the paper


class Assembly(NamedTuple):
    """What a flight is made of, at rest at its start."""

    record: npt.NDArray[Any]  # (rows,) of ROW
    plant: Plant
    loop: RecordedLoop
    inputs: LoopInputs
    setup: LoopSetup
    model: npt.NDArray[Any]  # (1,) MODEL that the loop counts on


def assemble(
    scenario: Scenario,
    plant: Plant | None = None,
    record: npt.NDArray[Any] | None = None,
) -> Assembly:
    """Plant, loop, command filter and instruments of a scenario, bound to a blank recording.

    Args:
        scenario: to be flown.
        plant: in place of the model's own.
        record: a blank recording of the same references, in place of a new one.

    Raises:
        UserError: one of them cannot be had.
    """
    aircraft = point_mass_of(scenario)
    if record is None:
        record = blank_recording(scenario, aircraft.thrust.engines)
    fuel = scenario.aircraft.fuel_fraction
    model = aircraft.record(fuel)
    dt = 1.0 / scenario.loop.rate
    if plant is None:
        plant = build_plant(scenario, _flown_point_mass(scenario).record(fuel), dt)
    setup = LoopSetup(aircraft, aircraft.initial_mass(fuel), scenario.loop, dt, scenario.sensors)
    first = [float(record[0][f"{name}_cmd_raw"]) for name in OUTPUTS]
    start = (0.0, 0.0, scenario.initial.altitude)
    reference = scenario.reference
    shape = reference.filter_frequency, reference.filter_damping
    filters = command_filter(*shape, dt, first, start)
    hold = altitude_hold(*climb_of(reference), filter_lag(reference))
    loop = build_loop(setup, model, record)
    plant.reset(record)
    faults = fault_records(scenario.fault)
    sensors = sensor_record(scenario.sensors, scenario.seed, record, scenario.fault)
    instruments = Instruments(sensors, faults, record, numbers(record))
    return Assembly(record, plant, loop, LoopInputs(instruments, filters, hold), setup, model)


def point_mass_of(scenario: Scenario) -> PointMass:
    """The point mass that the outer loop of this scenario counts on, [model_error] included.

    Raises:
        AircraftError: no such aircraft.
    """
    return wrong_model(_flown_point_mass(scenario), scenario.model_error)


def _flown_point_mass(scenario: Scenario) -> PointMass:
    name = PAPER_AIRCRAFT if scenario.model == "paper" else scenario.aircraft.name
    return load_point_mass(aircraft_folder(name))


def build_plant(scenario: Scenario, model: npt.NDArray[Any], dt: float) -> Plant:
    """The plant of `scenario.model`."""
    simulation = scenario.simulation
    if scenario.model == "flightgear":
        raise ScenarioError(
            "model 'flightgear' is flown in FlightGear: ftc-jsb plugin SCENARIO --flightgear"
        )
    if scenario.model == "jsbsim":
        from ftc_jsb.six_dof.plant import JsbsimPlant

        return JsbsimPlant(
            scenario.aircraft,
            scenario.initial,
            dt,
            simulation.jsbsim_steps,
            wind=scenario.wind,
            seed=scenario.seed,
            measured=scenario.sensors.reach_inner_loop,
            point_mass=_flown_point_mass(scenario),
        )
    from ftc_jsb.simulation.point_mass_plant import PointMassPlant

    wind = wind_record(scenario.wind, scenario.initial.altitude, scenario.seed, dryden=True)
    return PointMassPlant(model, wind, scenario.initial, dt, simulation.point_mass_steps)


def blank_recording(scenario: Scenario, engines: int = 1) -> npt.NDArray[Any]:
    """Recording with time, raw commands and faults filled in, the rest nan.

    (rows,) of ROW: one row a sample and one for the end. What is scheduled, commands and faults,
    stands in the recording before the flight; whoever changes it in flight rewrites the rows to come.
    """
    record = np.empty(scenario.samples + 1, ROW)
    fill_blank(record, scenario, engines)
    return record


def fill_blank(record: npt.NDArray[Any], scenario: Scenario, engines: int) -> None:
    """Make memory of (rows,) ROW, whatever stood there, a blank recording of `scenario`."""
    numbers(record).fill(math.nan)
    record["time"] = np.arange(record.size) / scenario.loop.rate
    commands = raw_commands(scenario.reference, record["time"])
    record["airspeed_cmd_raw"] = commands[:, 0]
    record["flight_path_angle_cmd_raw"] = commands[:, 1]
    record["heading_cmd_raw"] = commands[:, 2]
    record["altitude_cmd_raw"] = commands[:, 3]
    schedule(fault_records(scenario.fault), engines, record)
