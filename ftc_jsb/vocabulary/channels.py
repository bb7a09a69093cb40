"""What an aircraft is commanded and moved by: channels of the outer loop, engines, control surfaces."""

from typing import Literal

Channel = Literal["thrust", "load_factor", "bank_angle"]
CHANNELS: tuple[Channel, ...] = ("thrust", "load_factor", "bank_angle")
THRUST, LOAD_FACTOR, BANK_ANGLE = range(len(CHANNELS))  # their numbers in the kernels
ENGINES = 4  # the most that an aircraft may have
SURFACES: tuple[str, ...] = ("elevator", "aileron", "rudder")
