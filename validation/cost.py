"""What a step costs, and how time grows with the length of a flight."""

import time
from collections.abc import Iterator

import numpy as np

from ftc_jsb.aircraft.point_mass_file import load_point_mass
from ftc_jsb.control.protocol import LoopSetup
from ftc_jsb.loops.built_in import CompiledLoop
from ftc_jsb.resources import aircraft_folder
from ftc_jsb.scenario.load import load_scenario
from ftc_jsb.simulation.assembly import blank_recording
from ftc_jsb.simulation.fly import fly
from ftc_jsb.theory.generated import generate
from ftc_jsb.theory.kernels.joint_filter import FilterSettings
from ftc_jsb.theory.kernels.law import Reference, Tuning
from ftc_jsb.theory.linearization import linearize
from ftc_jsb.theory.systems import fighter_by_velocity
from validation.flights import measured


def cost_table() -> Iterator[str]:
    """What a step costs, called from Python."""
    aircraft = load_point_mass(aircraft_folder("paper"))
    mass, model = aircraft.initial_mass(0.0), aircraft.record(0.0)
    scenario = load_scenario("paper")
    record = blank_recording(scenario)
    record[:] = fly(scenario).record
    loop = CompiledLoop(LoopSetup(aircraft, mass, scenario.loop, 0.01), model, record)
    kernels = generate(linearize(fighter_by_velocity()))
    x, u, k = np.array([300.0, 0.0, 0.1]), np.array([4e4, 2.0, 0.5]), np.ones(3)
    wanted = Reference(x.copy(), x)
    tuning = Tuning(np.eye(3), np.array([1e5, 5.0, 1.0]), u)
    scratch, command = np.zeros(kernels.scratch), np.zeros(3)
    law = kernels.law
    arguments = (x, u, k, kernels.parameters, wanted, tuning, scratch, command)
    law(*arguments)
    loop.step(0)
    estimate = kernels.estimate
    noise = np.array([1e-10, 1e-10, 1e-3, 1e-10, 1e-10, 1e-10])
    given_filter = (
        np.concatenate([x, k]), np.diag(1e2 * noise), u, x.copy(), kernels.parameters,
        FilterSettings(noise, noise[:3].copy(), spread=6.0, floor=0.05, dt=0.01, extended=False),
    )  # fmt: skip
    estimate(*given_filter)
    yield "| step | µs |"
    yield "|---|---|"
    for title, function, given in (
        ("whole outer loop `ftc`: UKF, law, limits, trim filter, detector", loop.step, (1000,)),
        ("general law from generated code, fighter", law, arguments),
        ("general filter from generated code, fighter, six states", estimate, given_filter),
    ):
        times = []
        for _ in range(7):
            started = time.perf_counter()
            for _ in range(20000):
                function(*given)
            times.append((time.perf_counter() - started) / 20000 * 1e6)
        yield f"| {title} | {np.median(times):.2f} |"


def long_flights() -> Iterator[str]:
    """Time against duration: linear, and one hour of flight."""
    yield "| model | 1 min [s] | 10 min [s] | 60 min [s] | µs a step at 60 min |"
    yield "|---|---|---|---|---|"
    for model in ("paper", "jsbsim"):
        measured("nominal", f"model={model}", "duration=1")
        times = [
            measured(
                "nominal",
                f"model={model}",
                f"duration={60 * minutes}",
                "aircraft.fuel_fraction=1.0",
            )["elapsed_s"]
            for minutes in (1, 10, 60)
        ]
        step = times[2] / 360000 * 1e6
        yield f"| {model} | {times[0]:.2f} | {times[1]:.2f} | {times[2]:.2f} | {step:.1f} |"
