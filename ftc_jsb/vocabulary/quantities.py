"""How each variable of a flight is shown to a reader: title, unit, and the factor from the recording's unit.

The recording holds SI units and radians. Tables, charts, figures and `metrics.json` show what is
written here, and only here.
"""

import math
from typing import Any, NamedTuple

KILO = 1e-3  # kN in a newton, km in a metre
DEGREES = math.degrees(1.0)  # deg in a radian


class Quantity(NamedTuple):
    """A variable as it is shown."""

    name: str  # of the column in the recording
    key: str  # in metrics.json, with its unit; "" where it is not there
    title: str
    unit: str  # as shown; "" has no dimension
    factor: float = 1.0  # from the recording's unit to the one that is shown
    narrow: str = ""  # title where there is little room, if it is another

    def shown(self, values: Any) -> Any:
        """Recorded values, of any shape, in the unit that is shown."""
        return self.factor * values

    @property
    def short_title(self) -> str:
        """`Bank`: the title where there is little room."""
        return self.narrow or self.title

    @property
    def heading(self) -> str:
        """`Bank angle [deg]`; without brackets where there is no dimension."""
        return with_unit(self.title, self.unit)

    @property
    def axis_label(self) -> str:
        """`Load factor [-]`: of an axis, which always has a unit."""
        return f"{self.title} [{self.unit or '-'}]"

    @property
    def short_axis_label(self) -> str:
        """`Bank [deg]`: the same where there is little room."""
        return f"{self.short_title} [{self.unit or '-'}]"


def with_unit(title: str, unit: str) -> str:
    """A title and its unit in brackets; without brackets where there is no dimension."""
    return f"{title} [{unit}]" if unit else title


_ALL = (
    Quantity("airspeed", "airspeed_mps", "Airspeed", "m/s"),
    Quantity("flight_path_angle", "flight_path_deg", "Flight path", "deg", DEGREES),
    Quantity("heading", "heading_deg", "Heading", "deg", DEGREES),
    Quantity("acceleration", "", "Acceleration", "m/s^2"),
    # `analysis.tracking.tracking_errors` makes these in the units of [limits]
    Quantity("error_airspeed", "error_airspeed_mps", "Airspeed error", "m/s"),
    Quantity("error_flight_path_deg", "error_flight_path_deg", "Path error", "deg"),
    Quantity("error_heading_deg", "error_heading_deg", "Heading error", "deg"),
    Quantity("thrust", "thrust_kn", "Thrust", "kN", KILO),
    Quantity("thrust_cmd", "thrust_command_kn", "Thrust command", "kN", KILO, "Thrust cmd."),
    Quantity("load_factor", "load_factor", "Load factor", ""),
    Quantity("load_factor_cmd", "", "Load factor command", ""),
    Quantity("bank_angle", "bank_deg", "Bank angle", "deg", DEGREES, "Bank"),
    Quantity("bank_angle_cmd", "", "Bank command", "deg", DEGREES),
    Quantity("alpha", "alpha_deg", "Angle of attack", "deg", DEGREES),
    Quantity("sideslip", "sideslip_deg", "Sideslip", "deg", DEGREES),
    Quantity("climb_given_up", "climb_given_up_deg", "Climb given up for want of thrust", "deg", DEGREES),
    Quantity("airspeed_given_up", "airspeed_given_up_mps", "Airspeed given up for want of thrust", "m/s"),
    Quantity("turn_given_up", "turn_given_up_deg_s", "Turn given up for want of thrust", "deg/s", DEGREES),
    Quantity("north", "", "North", "km", KILO),
    Quantity("east", "", "East", "km", KILO),
    Quantity("altitude", "", "Altitude", "km", KILO),
    Quantity("position", "position_m", "Position", "m"),  # distance between two places
)  # fmt: skip

QUANTITIES: dict[str, Quantity] = {quantity.name: quantity for quantity in _ALL}
