"""The template of docs/loops.md: a proportional loop with no knowledge of faults."""

import math

from ftc_jsb.control.protocol import Command, LoopSetup, Measurement, Reference


class MyLoop:
    """Holds the references with three proportional gains."""

    def __init__(self, setup: LoopSetup) -> None:
        self.mass = setup.mass
        self.gravity = setup.aircraft.mass.gravity
        self.gains = setup.settings.gains
        self.dt = setup.dt
        self.thrust: float | None = None

    def step(self, time: float, measurement: Measurement, reference: Reference) -> Command:
        v, path = measurement.airspeed, measurement.flight_path_angle
        if self.thrust is None:
            self.thrust = 0.3 * self.mass * self.gravity
        acceleration = reference.airspeed_rate + self.gains[0] * (reference.airspeed - v)
        self.thrust += 2.0 * self.dt * self.mass * acceleration
        climb = reference.flight_path_angle_rate + self.gains[1] * (
            reference.flight_path_angle - path
        )
        turn = reference.heading_rate + self.gains[2] * (reference.heading - measurement.heading)
        up = math.cos(path) + v * climb / self.gravity
        side = v * math.cos(path) * turn / self.gravity
        return Command(self.thrust, math.hypot(up, side), math.atan2(side, up))


class BrokenLoop(MyLoop):
    """Fails in flight, as a user's first attempt does."""

    def step(self, time: float, measurement: Measurement, reference: Reference) -> Command:
        if time > 0.5:
            raise ZeroDivisionError("division by zero")
        return super().step(time, measurement, reference)


class WrongLoop(MyLoop):
    """Returns something else."""

    def step(self, time, measurement, reference):
        return (1.0, 2.0, 3.0)


class ExplodingLoop(MyLoop):
    """Asks for what no aircraft survives."""

    def step(self, time: float, measurement: Measurement, reference: Reference) -> Command:
        return Command(0.0, -3.0 if time > 1.0 else 1.0, 0.0)


class TextLoop(MyLoop):
    """A text for a number."""

    def step(self, time, measurement, reference):
        return Command("lots", 1.0, 0.0)


class NanLoop(MyLoop):
    """Loses a number on the way."""

    def step(self, time, measurement, reference):
        return Command(40e3, 1.0, math.nan if time > 3.0 else 0.0)


class WrongEstimateLoop(MyLoop):
    """Writes where it must not."""

    def step(self, time, measurement, reference):
        return Command(40e3, 1.0, 0.0, {"airspeed": 3.0})


class PullingLoop(MyLoop):
    """Pulls 7 g at any speed."""

    def step(self, time, measurement, reference):
        return Command(40e3, 7.0, 0.0)
