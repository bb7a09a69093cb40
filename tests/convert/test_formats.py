"""Recordings in other programs' formats, read back by the usual readers of each."""

import json
import math
import subprocess
import sys

import numpy as np
import pandas
import pytest
from pyarrow import parquet
from scipy.io import loadmat

from ftc_jsb.convert import FORMATS, convert
from ftc_jsb.recording.columns import VARIABLES
from ftc_jsb.recording.netcdf import save


@pytest.fixture(scope="module")
def flight(flown):
    return flown("paper", "model=jsbsim", "duration=25")


def test_csv_read_by_numpy_and_pandas_is_the_recording_to_the_bit(flight, tmp_path):
    convert(flight, "csv", tmp_path / "f.csv")
    table = pandas.read_csv(tmp_path / "f.csv")
    plain = np.loadtxt(tmp_path / "f.csv", delimiter=",", skiprows=1)
    assert list(table.columns) == [f"{v.name} [{v.unit}]" for v in VARIABLES]
    for column, variable in enumerate(VARIABLES):
        np.testing.assert_array_equal(plain[:, column], flight.record[variable.name])
        read = table[f"{variable.name} [{variable.unit}]"].to_numpy(dtype=float)
        # pandas before version 3 reads the last digit of a float loosely
        np.testing.assert_allclose(read, flight.record[variable.name], rtol=1e-15)


def test_mat_read_by_scipy_is_the_recording_to_the_bit(flight, tmp_path):
    convert(flight, "mat", tmp_path / "f.mat")
    read = loadmat(tmp_path / "f.mat", simplify_cells=True)
    for variable in VARIABLES:
        np.testing.assert_array_equal(read["flight"][variable.name], flight.record[variable.name])
        assert read["units"][variable.name] == variable.unit
    assert "[reference]" in read["attributes"]["scenario"]


def test_parquet_read_by_pandas_and_pyarrow_is_the_recording_with_units(flight, tmp_path):
    convert(flight, "parquet", tmp_path / "f.parquet")
    table = pandas.read_parquet(tmp_path / "f.parquet")
    schema = parquet.read_schema(tmp_path / "f.parquet")
    for variable in VARIABLES:
        np.testing.assert_array_equal(table[variable.name], flight.record[variable.name])
        assert schema.field(variable.name).metadata[b"units"].decode() == variable.unit
    assert "scenario" in {key.decode() for key in schema.metadata}
    assert json.loads(schema.metadata[b"versions"])["ftc-jsb"]


def test_acmi_read_by_a_tacview_reader_is_the_flown_path(flight, tmp_path, capsys):
    """Place to 0.1 m, attitude to 1e-4 deg, true airspeed to 1 mm/s."""
    from pyacmi import Acmi

    convert(flight, "acmi", tmp_path / "f.acmi")
    text = (tmp_path / "f.acmi").read_text(encoding="utf-8")
    assert text.splitlines()[:2] == ["FileType=text/acmi/tacview", "FileVersion=2.2"]
    assert "0,Event=Bookmark|101|Thrust effectiveness 0.6" in text
    read = Acmi()
    read.load_acmi(str(tmp_path / "f.acmi"))
    capsys.readouterr()
    assert list(read.objects) == ["101"]
    data = read.objects["101"].data
    times = np.array(list(data["Longitude"]))
    assert times[-1] == pytest.approx(25.0)
    assert np.diff(times).max() == pytest.approx(0.04, abs=1e-6)
    rows = np.rint(times * 100).astype(int)
    record = flight.record[rows]
    for name, variable, tolerance in (
        ("Roll", "roll", 1e-4),
        ("Pitch", "pitch", 1e-4),
        ("Yaw", "yaw", 1e-4),
    ):
        degrees = np.array(list(data[name].values()))
        assert np.abs(degrees - np.degrees(record[variable])).max() < tolerance
    assert np.abs(np.array(list(data["Altitude"].values())) - record["altitude"]).max() < 1e-3
    # Way over the ground from place to place on a sphere of the ellipsoid's own radii at 47 deg
    latitude, longitude = (np.radians(list(data[n].values())) for n in ("Latitude", "Longitude"))
    a, e2 = 6_378_137.0, 0.00669437999014  # m, WGS 84
    start = math.radians(flight.scenario.initial.latitude_deg)
    prime = a / math.sqrt(1.0 - e2 * math.sin(start) ** 2) + flight.scenario.initial.altitude
    meridian = (
        a * (1.0 - e2) / (1.0 - e2 * math.sin(start) ** 2) ** 1.5 + flight.scenario.initial.altitude
    )
    north, east = (
        meridian * (latitude - start),
        prime * math.cos(start) * (longitude - longitude[0]),
    )
    # 7 km away the plane and the sphere part by some metres: (north / R)^2 and tan(47 deg) east / R
    assert np.abs(north - record["north"]).max() < 2.0
    assert np.abs(east - record["east"]).max() < 3.0


def test_point_mass_without_throttle_and_flight_of_one_row_are_converted(flown, tmp_path):
    flight = flown("paper", "duration=1")
    for name, kind in FORMATS.items():
        if name == "tlog":
            continue
        for rows in (1, flight.record.size):
            short = flight._replace(record=flight.record[:rows])
            convert(short, name, tmp_path / f"{rows}{kind.suffix}")
            assert (tmp_path / f"{rows}{kind.suffix}").stat().st_size > 0
    assert "Throttle" not in (tmp_path / "101.acmi").read_text()


def test_command_writes_beside_the_recording_and_over_nothing(flight, tmp_path):
    save(flight, tmp_path / "flight.nc")
    command = [sys.executable, "-m", "ftc_jsb", "convert", "flight.nc", "--to"]

    def run(*arguments):
        return subprocess.run(
            [*command, *arguments], cwd=tmp_path, capture_output=True, text=True, check=False
        )

    assert run("csv").returncode == 0
    before = (tmp_path / "flight.csv").read_bytes()
    again = run("csv")
    assert again.returncode == 2
    assert "--force" in again.stderr
    assert (tmp_path / "flight.csv").read_bytes() == before
    unknown = run("xls")
    assert unknown.returncode == 2
    assert "acmi" in unknown.stderr
    assert "parquet" in unknown.stderr
    assert "Traceback" not in unknown.stderr
    assert {path.name for path in tmp_path.iterdir()} == {"flight.nc", "flight.csv"}
