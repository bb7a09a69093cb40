"""The paper's Figures 1 and 2, and the tracking errors: variables over time."""

import numpy as np
from matplotlib.figure import Figure

from ftc_jsb.report.figures.panels import Flights, Row, kilo, panels, same


def states(flights: Flights) -> Figure:
    """Figure 1: airspeed, flight path angle and heading with their references."""
    rows = (
        Row("airspeed", "Airspeed [m/s]", same),
        Row("flight_path_angle", "Flight path [deg]", np.degrees),
        Row("heading", "Heading [deg]", np.degrees),
    )
    return panels(flights, rows, reference=True)


def tracking(flights: Flights) -> Figure:
    """Tracking errors: airspeed, flight path angle and heading minus their references."""
    rows = (
        Row("error_airspeed", "Airspeed error [m/s]", same),
        Row("error_flight_path_deg", "Path error [deg]", same),
        Row("error_heading_deg", "Heading error [deg]", same),
    )
    return panels(flights, rows, reference=False)


def controls(flights: Flights) -> Figure:
    """Figure 2: commanded thrust, and load factor and bank angle as flown."""
    rows = (
        Row("thrust_cmd", "Thrust cmd. [kN]", kilo),
        Row("load_factor", "Load factor [-]", same),
        Row("bank_angle", "Bank angle [deg]", np.degrees),
    )
    return panels(flights, rows, reference=False)
