"""Outer loops that misbehave in every way that a fence holds."""

import abc
import os
import signal
import sys
import warnings

import numpy as np

from ftc_jsb.control.protocol import Command
from tests.control.my_loop import MyLoop


class Wild(MyLoop, abc.ABC):
    """Misbehaves at 0.5 s, and flies on if it can."""

    def step(self, time, measurement, reference):
        if time == 0.5:
            return self.misbehave()
        return super().step(time, measurement, reference)

    @abc.abstractmethod
    def misbehave(self):
        """What it does in place of a command."""


class Exits(Wild):
    def misbehave(self):
        sys.exit(0)


class Overflows(Wild):
    def misbehave(self):
        return Command(10**400, 1.0, 0.0)


class RaisesBase(Wild):
    def misbehave(self):
        raise GeneratorExit


class Unprintable(Wild):
    def misbehave(self):
        class StrangeError(Exception):
            def __str__(self):
                raise ValueError

        raise StrangeError


class ManyDigits(Wild):
    """repr() of an int of more digits than Python writes raises."""

    def misbehave(self):
        return 10**5000


class Deep(Wild):
    def misbehave(self):
        return self.misbehave()


class SetsEverything(Wild):
    def misbehave(self):
        os.chdir("/")
        os.umask(0o777)
        os.environ["HOME"] = "/nowhere"
        np.seterr(all="raise")
        warnings.simplefilter("error")
        signal.signal(signal.SIGTERM, signal.SIG_IGN)
        sys.path.clear()
        sys.stdout = sys.stderr = None
        return Command(40e3, 1.0, 0.0)


class Enormous(MyLoop):
    """Estimates that overflow when they are squared."""

    def step(self, time, measurement, reference):
        command = super().step(time, measurement, reference)
        names = ("effectiveness_thrust_est", "effectiveness_thrust_std", "airspeed_est")
        return command._replace(estimates=dict.fromkeys(names, 1e200))


class Waits(MyLoop):
    """Tells by a file when it flies, so that a signal can be sent in flight."""

    def step(self, time, measurement, reference):
        if time == 1.0:
            with open(os.environ["FTC_JSB_TEST_FLYING"], "w"):
                pass
        return super().step(time, measurement, reference)
