"""FlightGear's FGNetFDM packets of rows: where the aircraft is, and how it lies."""

import math
import struct
from typing import Any

from ftc_jsb.scenario.schema import Initial

VERSION = 24
# Network byte order: version, padding; longitude, latitude [rad], altitude [m]; height, attitude, alpha,
# sideslip [rad]; rates and speeds; accelerations; stall, slip; engines; tanks; wheels; clock, offset,
# visibility [m]; surfaces.
PACKET = struct.Struct("!II3d6f11f3f2fI4I36fI4fI3I9fIif10f")
VISIBILITY = 40_000.0  # [m]


def packet(row: Any, initial: Initial) -> bytes:
    """Packet of a row; a point mass has the attitude of its flight path, its angle of attack and its bank.

    Args:
        row: of a recording.
        initial: [initial] of its scenario: the origin of north and east.
    """
    import pymap3d

    north, east = float(row["north"]), float(row["east"])
    latitude, longitude, _ = pymap3d.enu2geodetic(
        east, north, 0.0, initial.latitude_deg, initial.longitude_deg, initial.altitude
    )
    attitude = [_finite(row[name]) for name in ("roll", "pitch", "yaw")]
    angles = [_finite(row[name]) for name in ("alpha", "sideslip")]
    altitude = _finite(row["altitude"])
    numbers: list[float] = [VERSION, 0, math.radians(longitude), math.radians(latitude), altitude]
    numbers += [altitude, attitude[0], attitude[1], attitude[2] % (2.0 * math.pi), *angles]
    numbers += [0.0] * (11 + 3 + 2) + [0] * 5 + [0.0] * 36 + [0] + [0.0] * 4 + [0] * 4 + [0.0] * 9
    # The clock is 0: FlightGear 2020.3 goes by its own (see viewer.start_line).
    return PACKET.pack(*numbers, 0, 0, VISIBILITY, *[0.0] * 10)


def _finite(value: Any) -> float:
    return float(value) if math.isfinite(value) else 0.0
