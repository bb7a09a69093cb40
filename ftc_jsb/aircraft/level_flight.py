"""A flight condition for an aircraft that is only named: straight and level, where it was tested."""

from ftc_jsb.aircraft.description import Aircraft
from ftc_jsb.aircraft.test_range import usual_altitude
from ftc_jsb.scenario.schema import Initial


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
        altitude = usual_altitude(aircraft.flight_test)
    return Initial(airspeed=airspeed, altitude=altitude)
