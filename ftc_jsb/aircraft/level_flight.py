"""A flight condition for an aircraft that is only named: straight and level, where it was tested."""

from ftc_jsb.aircraft.description import Aircraft
from ftc_jsb.scenario.schema import Initial

USUAL_ALTITUDE = 3048.0  # [m], 10 000 ft: that of the scenarios


def level_flight(
    aircraft: Aircraft, airspeed: float | None = None, altitude: float | None = None
) -> Initial:
    """Straight and level flight.

    Args:
        aircraft: as loaded.
        airspeed: [m/s]; default: the middle of its test range, to 10 m/s.
        altitude: [m]; default: the tested one that is nearest to 10 000 ft.
    """
    if airspeed is None:
        airspeed = round(sum(aircraft.flight_test.airspeed) / 20.0) * 10.0
    if altitude is None:
        tested = aircraft.flight_test.altitude
        altitude = min(tested, key=lambda height: abs(height - USUAL_ALTITUDE))
    return Initial(airspeed=airspeed, altitude=altitude)
