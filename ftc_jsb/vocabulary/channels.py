"""What an aircraft is commanded and moved by, and what follows its reference: channels of the outer
loop, tracked variables, engines, control surfaces.
"""

from typing import Literal

Channel = Literal["thrust", "load_factor", "bank_angle"]
CHANNELS: tuple[Channel, ...] = ("thrust", "load_factor", "bank_angle")
THRUST, LOAD_FACTOR, BANK_ANGLE = range(len(CHANNELS))  # their numbers in the kernels
TRACKED: tuple[str, ...] = (
    "airspeed",
    "flight_path_angle",
    "heading",
)  # y of the paper, the filter's too
ENGINES = 4  # the most that an aircraft may have
SURFACES: tuple[str, ...] = ("elevator", "aileron", "rudder")
