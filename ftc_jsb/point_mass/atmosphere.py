"""Air density and speed of sound: the 1976 standard atmosphere, or the paper's constant density."""

import math

from ftc_jsb.compiled import compiled

GAS_CONSTANT_AIR = 287.05287  # [J/(kg K)]
HEAT_RATIO = 1.4  # [-]
EARTH_RADIUS = 6356766.0  # [m], of the standard's geopotential altitude
GRAVITY = 9.80665  # [m/s^2]
TEMPERATURE_SEA_LEVEL = 288.15  # [K]
PRESSURE_SEA_LEVEL = 101325.0  # [Pa]
LAPSE_RATE = 0.0065  # [K/m]
TROPOPAUSE = 11000.0  # [m], geopotential


@compiled
def standard_atmosphere(altitude: float) -> tuple[float, float]:
    """Density and speed of sound at a geometric altitude.

    U.S. Standard Atmosphere 1976, NOAA-S/T 76-1562, eqs. 18, 23, 33a, 33b, 42 and 50; troposphere
    and lower stratosphere (to 20 km geopotential).

    Args:
        altitude: above mean sea level [m].

    Returns:
        Density [kg/m^3] and speed of sound [m/s].
    """
    geopotential = EARTH_RADIUS * altitude / (EARTH_RADIUS + altitude)
    exponent = GRAVITY / (GAS_CONSTANT_AIR * LAPSE_RATE)
    if geopotential < TROPOPAUSE:
        temperature = TEMPERATURE_SEA_LEVEL - LAPSE_RATE * geopotential
        pressure = PRESSURE_SEA_LEVEL * (temperature / TEMPERATURE_SEA_LEVEL) ** exponent
    else:
        temperature = TEMPERATURE_SEA_LEVEL - LAPSE_RATE * TROPOPAUSE
        pressure = (
            PRESSURE_SEA_LEVEL
            * (temperature / TEMPERATURE_SEA_LEVEL) ** exponent
            * math.exp(-GRAVITY * (geopotential - TROPOPAUSE) / (GAS_CONSTANT_AIR * temperature))
        )
    density = pressure / (GAS_CONSTANT_AIR * temperature)
    return density, math.sqrt(HEAT_RATIO * GAS_CONSTANT_AIR * temperature)
