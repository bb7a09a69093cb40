"""Virtual flight tests: what is flown to see drag, angle of attack, spool and response."""

import math
from collections.abc import Callable, Iterator
from typing import NamedTuple

import numpy as np

from ftc_jsb.aircraft.airplane_class import AGILE
from ftc_jsb.aircraft.description import FlightTest
from ftc_jsb.aircraft.test_range import slowest
from ftc_jsb.scenario.wind import Wind

MIXED_MARGIN = 25.0  # [m/s] above the slowest test
MIXED_BANK = math.radians(110.0)

# Commands at a time [s]: thrust fraction (0 idle, 1 maximum), load factor, flight path angle to
# hold [rad] or nan, bank angle [rad]. With a path to hold, load factor is what holds it.
Schedule = Callable[[float], tuple[float, float, float, float]]

STILL_AIR = Wind()
GUSTS = (Wind(turbulence="moderate"), Wind(turbulence="severe"))


class Manoeuvre(NamedTuple):
    """One test flight."""

    name: str
    airspeed: float  # [m/s]
    altitude: float  # [m]
    fuel_fraction: float
    duration: float  # [s]
    schedule: Schedule
    wind: Wind = STILL_AIR
    seed: int = 0  # of the turbulence


def training(test: FlightTest) -> Iterator[Manoeuvre]:
    """The flights that are fitted to."""
    high = test.airspeed[1]
    for number, altitude in enumerate(test.altitude):
        fuel = test.fuel_fraction[number % len(test.fuel_fraction)]
        slow = slowest(test, altitude)
        yield Manoeuvre("level acceleration", slow + 5.0, altitude, fuel, 50.0, _accelerate)
        yield Manoeuvre("level deceleration", 0.93 * high, altitude, fuel, 50.0, _decelerate)
        for airspeed in np.linspace(slow + 10.0, 0.93 * high, 5):
            for side in (-1.0, 1.0):
                yield Manoeuvre(
                    "wind-up turn", airspeed, altitude, fuel, 25.0,
                    _wind_up_turn(side, test.load_factor[1], 1.0 if airspeed < 0.7 * high else 0.5),
                )  # fmt: skip
            yield Manoeuvre(
                "roller coaster",
                airspeed,
                altitude,
                fuel,
                16.0,
                _roller_coaster(test.load_factor[0]),
            )
        yield Manoeuvre("climb", 0.8 * high, altitude, fuel, 20.0, _climb(math.radians(8.0)))
        yield Manoeuvre("dive", 0.75 * high, altitude, fuel, 15.0, _climb(math.radians(-6.0)))
        for seed in range(3):
            yield _mixed(test, altitude, fuel, seed=100 * number + seed)


def held_out(test: FlightTest) -> Iterator[Manoeuvre]:
    """Flights that no fit has seen: between the training altitudes, other manoeuvres, other seeds."""
    for seed in range(8):
        random = np.random.default_rng(9000 + seed)
        altitude = float(random.uniform(test.altitude[0], test.altitude[-1]))
        fuel = float(random.uniform(test.fuel_fraction[0], test.fuel_fraction[-1]))
        yield _mixed(test, altitude, fuel, seed=9000 + seed)


def training_in_gusts(test: FlightTest) -> Iterator[Manoeuvre]:
    """The flights that are fitted to for what gusts do: angle of attack and sideslip without a command."""
    for number, altitude in enumerate(test.altitude):
        fuel = test.fuel_fraction[number % len(test.fuel_fraction)]
        slow, high = slowest(test, altitude), test.airspeed[1]
        level = Manoeuvre("level acceleration", slow + 15.0, altitude, fuel, 40.0, _accelerate)
        yield _in_gusts(level, number)
        for wind in range(len(GUSTS)):
            seed = 100 * number + 50 + wind
            yield _in_gusts(_mixed(test, altitude, fuel, seed=seed), seed)
        back = Manoeuvre("level deceleration", 0.93 * high, altitude, fuel, 40.0, _decelerate)
        yield _in_gusts(back, number + 1)


def held_out_in_gusts(test: FlightTest) -> Iterator[Manoeuvre]:
    """Flights in gusts that no fit has seen: other altitudes, manoeuvres and seeds of the turbulence."""
    for seed in range(9100, 9106):
        random = np.random.default_rng(seed)
        altitude = float(random.uniform(test.altitude[0], test.altitude[-1]))
        fuel = float(random.uniform(test.fuel_fraction[0], test.fuel_fraction[-1]))
        yield _in_gusts(_mixed(test, altitude, fuel, seed=seed), seed)


def _in_gusts(manoeuvre: Manoeuvre, seed: int) -> Manoeuvre:
    """The same in moderate (even seeds) or severe turbulence."""
    wind = GUSTS[seed % len(GUSTS)]
    return manoeuvre._replace(name=f"{manoeuvre.name}, gusts", wind=wind, seed=seed)


def _accelerate(time: float) -> tuple[float, float, float, float]:
    return (1.0 if time > 2.0 else 0.5), math.nan, 0.0, 0.0


def _decelerate(time: float) -> tuple[float, float, float, float]:
    return (0.0 if time > 2.0 else 0.7), math.nan, 0.0, 0.0


def _wind_up_turn(side: float, load_factor_max: float, thrust: float) -> Schedule:
    def schedule(time: float) -> tuple[float, float, float, float]:
        load_factor = 1.05 + (load_factor_max - 1.05) * min(max(time - 1.0, 0.0) / 20.0, 1.0)
        return thrust, load_factor, math.nan, side * math.acos(1.0 / load_factor)

    return schedule


def _roller_coaster(load_factor_min: float) -> Schedule:
    def schedule(time: float) -> tuple[float, float, float, float]:
        swing = 1.0 - load_factor_min
        return 0.6, 1.0 + swing * math.sin(2.0 * math.pi * time / 8.0), math.nan, 0.0

    return schedule


def _climb(path: float) -> Schedule:
    def schedule(time: float) -> tuple[float, float, float, float]:
        return (0.9 if path > 0.0 else 0.4), math.nan, path, 0.0

    return schedule


def _mixed(test: FlightTest, altitude: float, fuel: float, seed: int) -> Manoeuvre:
    """Turns, rolls, pulls and throttle all at once, from a seeded sum of sines and steps."""
    random = np.random.default_rng(seed)
    slow, fast = slowest(test, altitude), 0.95 * test.airspeed[1]
    margin = max(0.0, min(MIXED_MARGIN, 0.2 * slow, 0.5 * (fast - slow)))
    airspeed = float(random.uniform(min(slow + margin, fast), fast))
    periods = random.uniform(4.0, 25.0, (3, 3))
    phases = random.uniform(0.0, 2.0 * math.pi, (3, 3))
    reach = min((test.load_factor[1] - 1.0) / (AGILE - 1.0), 1.0)
    pull = reach * float(random.uniform(0.5, 2.5))
    steepest = min(MIXED_BANK, 1.37 * math.acos(1.0 / test.load_factor[1]))

    def wave(row: int, time: float) -> float:
        return float(np.sin(2.0 * math.pi * time / periods[row] + phases[row]).mean())

    def schedule(time: float) -> tuple[float, float, float, float]:
        bank = steepest * wave(0, time)
        thrust = 0.55 + 0.9 * wave(1, time)
        load_factor = 1.0 / max(math.cos(bank), 0.3) + pull * wave(2, time)
        return thrust, load_factor, math.nan, bank

    return Manoeuvre("mixed", airspeed, altitude, fuel, 40.0, schedule)
