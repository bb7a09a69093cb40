"""Flights one after the other, as `fly` flies each: point masses share the memory of one recording."""

import time

import numpy as np

from ftc_jsb.loops.built_in import BUILT_IN
from ftc_jsb.recording.columns import ROW
from ftc_jsb.recording.flight import Flight, Outcome
from ftc_jsb.scenario.schema import Scenario
from ftc_jsb.simulation.admissible_faults import refuse_unflyable
from ftc_jsb.simulation.advance import advance
from ftc_jsb.simulation.assembly import assemble, fill_blank, point_mass_of
from ftc_jsb.simulation.departure import FLYING, REASONS
from ftc_jsb.simulation.fly import fly


class Series:
    """Flies scenarios of any kind in turn.

    A point mass with a built-in loop runs no code of the user's, so that nothing has to be fenced in, and
    flies in the memory that the flight before it had. Any other scenario is flown by `fly`.
    """

    def __init__(self) -> None:
        """Nothing flown yet."""
        self._memory = np.empty(0, ROW)

    def fly(self, scenario: Scenario) -> Flight:
        """The flight of `fly`, the same to the bit; its recording is valid until the next flight.

        Raises:
            UserError: as `fly`.
        """
        if scenario.model == "jsbsim" or scenario.loop.name not in BUILT_IN:
            return fly(scenario)
        refuse_unflyable(scenario)
        rows = scenario.samples + 1
        if self._memory.size < rows:
            self._memory = np.empty(rows, ROW)
        record = self._memory[:rows]
        fill_blank(record, scenario, point_mass_of(scenario).thrust.engines)
        advance_rows, length = advance(assemble(scenario, record=record), ())
        outcome = Outcome("complete", scenario.duration, "")
        dt, flown = 1.0 / scenario.loop.rate, 0
        started = time.perf_counter()
        while flown < rows:  # a signal comes between two stretches
            last, reason = advance_rows(flown, min(flown + length, rows))
            flown = last + 1
            if reason != FLYING:
                outcome = Outcome("departed", last * dt, REASONS[reason])
                break
        factor = flown * dt / (time.perf_counter() - started)
        return Flight(scenario, record[:flown], outcome, factor)
