"""How near the estimate of thrust is to what the instruments allow: the Cramér–Rao bound on the same flights.

The effectiveness k is told by the force along the velocity, k T cos(alpha) - D over the mass. Its error is
white noise of accelerometer, vanes, pick-offs and pitot, and what each of them is off by through the flight,
which is a nuisance parameter with the prior of its data sheet (Van Trees 1968, part I, 2.4.3). With h the
sensitivities of a sample to k and to those, and R the variance of its noise, the information is
sum(h h' / R) + prior^-1; the bound is the root of the first element of its inverse. The instruments are taken
to be read at every sample and without delay, the aircraft's model to be true: nothing can do better.
"""

from collections.abc import Iterator
from concurrent.futures import ProcessPoolExecutor
from typing import Any, NamedTuple

import numpy as np
import numpy.typing as npt

from ftc_jsb.errors import UserError
from ftc_jsb.point_mass.drag import measured_drag_coefficient
from ftc_jsb.point_mass.model import at_condition, pressure_area
from ftc_jsb.scenario.load import load_scenario
from ftc_jsb.simulation.advance import advance
from ftc_jsb.simulation.assembly import assemble
from ftc_jsb.units import STANDARD_GRAVITY
from validation.envelope import AIRSPEEDS
from validation.isolation.flights import AIR, FIRST, Mission, overrides

SEEDS = 4
SETTLED = 5.0  # [s]
EVERY = 10  # samples, of which one stands for all
WINDOW = 0.5  # [s]: of `loop.estimator.response_time`, in which a loss is to be followed
STEP = np.radians(0.2)  # [rad], of differences
FASTER = 2.0  # [m/s]
Array = npt.NDArray[np.float64]


class Reached(NamedTuple):
    """Of one flight: standard deviations of the effectiveness."""

    error: float  # root mean square, of the estimate
    told: float  # by the filter, median
    soon: float  # bound within WINDOW, median
    ever: float  # bound of the whole flight


def sensitivities(settings: Any, model: Any, row: Any) -> tuple[Array, float]:
    """(7,) of the force along the velocity to k and to the biases, and the variance of its noise.

    Args:
        settings: LOOP_SETTINGS of the flight.
        model: MODEL that the loop counts on.
        row: of the recording; the truth is read.
    """
    at = at_condition(model, row["airspeed"], row["altitude"])
    angles = np.array([row["alpha"], abs(row["sideslip"]), row["elevator"], row["flap"]])

    def deceleration(airspeed: float, moved: Array) -> float:
        drag = measured_drag_coefficient(
            model, airspeed / at.sound_speed, *moved, row["pitch_rate"] / airspeed
        )
        return float(pressure_area(at, airspeed) * drag / model["mass"])

    here = deceleration(row["airspeed"], angles)
    to_angles = [
        (deceleration(row["airspeed"], angles + STEP * unit) - here) / STEP for unit in np.eye(4)
    ]
    to_angles[0] -= STANDARD_GRAVITY * row["load_factor"]
    to_airspeed = (deceleration(row["airspeed"] + FASTER, angles) - here) / FASTER
    to_thrust = row["thrust"] * np.cos(row["alpha"]) / model["mass"]
    noise = settings["acceleration_noise"] + to_airspeed**2 * settings["measurement_noise"][0]
    noise += np.square(to_angles) @ settings["angle_noise"]
    return np.array([to_thrust, 1.0, to_airspeed, *to_angles]), float(noise)


def bound(rows: list[tuple[Array, float]], prior: Array, samples: int) -> float:
    """Standard deviation of k that `samples` samples, spread over the rows, allow.

    Args:
        rows: of `sensitivities`.
        prior: (6,) standard deviations of the biases.
        samples: that there are.
    """
    information = np.diag([0.0, *(1.0 / np.maximum(prior, 1e-9) ** 2)])
    for h, noise in rows:
        information += samples / len(rows) * np.outer(h, h) / noise
    return float(np.sqrt(np.linalg.inv(information)[0, 0]))


def reached(mission: Mission) -> Reached | None:
    """Fly one without a fault; None without a trim."""
    try:
        flown = assemble(load_scenario("nominal", overrides(mission)))
    except UserError:
        return None
    advance_rows, _ = advance(flown, ())
    for i in range(flown.record.size):
        advance_rows(i, i + 1)
    flown.plant.close()
    loop: Any = flown.loop
    settings, model = loop.arrays.settings[0], loop.arrays.model[0]
    record: Any = flown.record[flown.record["time"] > SETTLED]
    told = [sensitivities(settings, model, row) for row in record[::EVERY]]
    prior = np.array(
        [settings["acceleration_bias"], settings["airspeed_bias"], *settings["angle_bias"]]
    )
    width, dt = round(WINDOW / settings["dt"]), EVERY
    soon = [
        bound(told[k : k + width // dt], prior, width)
        for k in range(0, len(told) - width // dt, width // dt)
    ]
    error = record["effectiveness_thrust_est"] - record["effectiveness_thrust"]
    return Reached(
        float(np.sqrt(np.mean(error**2))),
        float(np.median(record["effectiveness_thrust_std"])),
        float(np.median(soon)),
        bound(told, prior, record.size),
    )


def bounds(seeds: int = SEEDS, first: int = FIRST + 8000) -> Iterator[str]:
    """A line for each fighter and air."""
    yield (
        f"| fighter | turbulence | error of k̂, root mean square | σ | bound in {WINDOW} s "
        "| bound of the flight |"
    )
    yield "|---|---|---|---|---|---|"
    with ProcessPoolExecutor(2) as pool:
        for name in AIRSPEEDS:
            for air in AIR:
                flights = pool.map(reached, [Mission(name, air, first + k) for k in range(seeds)])
                found = np.array([each for each in flights if each is not None])
                cells = (f"{value:.4f}" for value in np.median(found, axis=0))
                yield f"| {name} | {air} | " + " | ".join(cells) + " |"
