"""TacView's text format ACMI 2.2: position and attitude in time, faults as bookmarks.

The format fixes the units: degrees, metres, m/s. A recording has no date, so the flight is at noon
of the first day of 1970.
"""

import math
from collections.abc import Iterator
from pathlib import Path
from typing import Any

from ftc_jsb.analysis.fault_steps import fault_steps
from ftc_jsb.analysis.geodesy import over_the_ground
from ftc_jsb.recording.flight import Flight
from ftc_jsb.vocabulary.quantities import DEGREES

RATE = 25.0  # Hz at most; TacView interpolates
AIRCRAFT = "101"  # identity of the object, hexadecimal
REFERENCE_TIME = "1970-01-01T12:00:00Z"
PROPERTIES = (  # property, variable of the recording, factor to the unit that the format fixes
    ("TAS", "airspeed", 1.0),  # m/s
    ("Mach", "mach", 1.0),
    ("AOA", "alpha", DEGREES),  # deg
    ("AOS", "sideslip", DEGREES),  # deg
)


def write(flight: Flight, path: Path) -> None:
    """Write one aircraft, at most 25 times a second of flight."""
    with path.open("w", encoding="utf-8", newline="\n") as file:
        for line in _lines(flight):
            file.write(line + "\n")


def _lines(flight: Flight) -> Iterator[str]:
    scenario = flight.scenario
    yield "FileType=text/acmi/tacview"
    yield "FileVersion=2.2"
    yield f"0,ReferenceTime={REFERENCE_TIME}"
    yield f"0,Title={_text(scenario.title or scenario.name)}"
    yield f"0,DataSource={_text('ftc-jsb, model ' + scenario.model)}"
    yield "0,DataRecorder=ftc-jsb"
    name = Path(scenario.aircraft.name).name
    yield "#0"
    yield f"{AIRCRAFT},Name={_text(name)},Type=Air+FixedWing,Pilot={_text(flight.label)}"
    record = flight.record
    step = max(math.ceil(1.0 / (flight.row_period * RATE) - 1e-9), 1)
    faults = set(fault_steps(record["effectiveness_thrust"], scenario).tolist())
    longitude, latitude = _places(flight)
    for i in sorted({*range(0, record.size, step), *faults, record.size - 1}):
        row = record[i]
        if not math.isfinite(longitude[i] + latitude[i] + row["altitude"]):
            continue
        yield f"#{row['time']:.4g}" if row["time"] < 1.0 else f"#{row['time']:.3f}"
        attitude = "|".join(_degrees(row[axis]) for axis in ("roll", "pitch", "yaw"))
        place = f"{longitude[i]:.8f}|{latitude[i]:.8f}|{row['altitude']:.3f}"
        yield f"{AIRCRAFT},T={place}|{attitude}{_properties(row)}"
        if i in faults:
            effectiveness = row["effectiveness_thrust"]
            yield f"0,Event=Bookmark|{AIRCRAFT}|Thrust effectiveness {effectiveness:.3g}"


def _places(flight: Flight) -> tuple[Any, Any]:
    """Longitude and latitude [deg], (rows,) each, of the way over the tangent plane (WGS 84)."""
    initial, record = flight.scenario.initial, flight.record
    origin = (initial.latitude_deg, initial.longitude_deg, initial.altitude)
    latitude, longitude = over_the_ground(
        record["north"], record["east"], record["altitude"], origin
    )
    return longitude, latitude


def _properties(row: Any) -> str:
    """What else the recording knows of this row; throttle beyond military is afterburner."""
    known = [(name, factor * row[variable]) for name, variable, factor in PROPERTIES]
    known += [
        ("Throttle", min(row["throttle"], 1.0)),
        ("Afterburner", max(row["throttle"] - 1.0, 0.0)),
    ]
    return "".join(f",{name}={value:.6g}" for name, value in known if math.isfinite(value))


def _degrees(angle: float) -> str:
    """An angle in degrees within a turn; nothing where it is not known."""
    return f"{math.degrees(math.remainder(angle, math.tau)):.5f}" if math.isfinite(angle) else ""


def _text(text: str) -> str:
    """A text property: commas and line ends are escaped."""
    return text.replace(",", "\\,").replace("\n", "\\\n")
