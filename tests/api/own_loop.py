"""A loop of a user's own that holds the trim of level flight."""

import ftc_jsb as ftc


class Hold:
    def __init__(self, setup):
        self._weight = 9.81 * setup.mass

    def step(self, time, measurement, reference):
        return ftc.Command(0.2 * self._weight, 1.0, 0.0)
