"""Published trajectories of the check cases, reduced to what the simulations of the memorandum span.

`python -m validation.check_cases.published FOLDER` makes `published.csv` of the files `Atmos_…_sim_….csv`,
which nescacademy.nasa.gov published and github.com/nasa/simupy-flight keeps in NESC_data.
"""

import sys
from pathlib import Path
from typing import Any

import numpy as np
import numpy.typing as npt

from ftc_jsb.units import FOOT
from validation.check_cases.cases import CASES, Case

TABLE = Path(__file__).with_name("published.csv")
EQUATORIAL, POLAR = 6378137.0, 6356752.314245  # [m], WGS-84
KNOT = 1852.0 / 3600.0  # [m/s]
LAST = 30  # [s], a row a second
QUANTITIES = ("north", "east", "altitude", "airspeed", "roll_rate", "pitch_rate", "yaw_rate")
RATES = ("Roll", "Pitch", "Yaw")


def reduced(folder: Path) -> npt.NDArray[np.float64]:
    """(rows, 2 + 2 quantities): case, time [s], least and most of each quantity over all. SI, rad."""
    rows = []
    for case in CASES:
        files = sorted(folder.glob(f"Atmos_{case.number:02d}_*/*.csv"))
        flights = np.stack([_seconds(case, path) for path in files])
        both = np.stack([np.nanmin(flights, axis=0), np.nanmax(flights, axis=0)], axis=2)
        for second, row in enumerate(both.reshape(LAST + 1, -1)):
            rows.append([case.number, second, *row])
    return np.array(rows)


def _seconds(case: Case, path: Path) -> npt.NDArray[np.float64]:
    """(seconds, quantities) of one published file; nan where it has none."""
    table = np.genfromtxt(path, delimiter=",", names=True)
    at = [int(np.argmin(np.abs(table["time"] - second))) for second in range(LAST + 1)]
    rows = table[at]
    north, east = _tangent_plane(case, rows)
    altitude = rows["altitudeMsl_ft"] * FOOT
    columns = [north, east, altitude, _column(rows, "trueAirspeed_nmi_h", KNOT)]
    columns += [
        _column(rows, f"bodyAngularRateWrtEi_deg_s_{axis}", np.pi / 180.0) for axis in RATES
    ]
    return np.stack(columns, axis=1)


def _column(rows: npt.NDArray[Any], name: str, unit: float) -> npt.NDArray[np.float64]:
    names = rows.dtype.names or ()
    return np.asarray(rows[name] * unit if name in names else np.full(rows.size, np.nan))


def _tangent_plane(case: Case, rows: npt.NDArray[Any]) -> tuple[npt.NDArray[Any], ...]:
    """North and east [m] of latitude and longitude 0, in the plane that touches the Earth there."""
    if case.planet is None:
        equatorial, polar = EQUATORIAL, POLAR
    else:
        equatorial = polar = case.planet.radius * FOOT
    latitude, longitude = np.radians(rows["latitude_deg"]), np.radians(rows["longitude_deg"])
    altitude = rows["altitudeMsl_ft"] * FOOT
    squared = 1.0 - (polar / equatorial) ** 2
    normal = equatorial / np.sqrt(1.0 - squared * np.sin(latitude) ** 2)
    east = (normal + altitude) * np.cos(latitude) * np.sin(longitude)
    north = (normal * (1.0 - squared) + altitude) * np.sin(latitude)
    return north, east


def main(folder: str) -> None:
    """Write the table."""
    names = [f"{name}_{end}" for name in QUANTITIES for end in ("least", "most")]
    header = ",".join(["case", "time", *names])
    np.savetxt(TABLE, reduced(Path(folder)), "%.10g", ",", header=header, comments="")


if __name__ == "__main__":
    main(*sys.argv[1:])
