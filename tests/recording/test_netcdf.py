"""A flight survives NetCDF to the bit, says what it holds, and a damaged file is refused."""

import json

import numpy as np
import pytest
import xarray

from ftc_jsb.errors import RecordingError
from ftc_jsb.recording.columns import ROW, VARIABLES
from ftc_jsb.recording.dataset import to_dataset
from ftc_jsb.recording.netcdf import load, save
from ftc_jsb.recording.provenance import machine, versions
from ftc_jsb.simulation.fly import fly


@pytest.fixture
def saved(flown, tmp_path):
    path = tmp_path / "flight.nc"
    save(flown("paper"), path)
    return path


def test_recording_is_read_back_to_the_bit(flown, saved):
    flight = load(saved)
    assert flight.scenario == flown("paper").scenario
    assert flight.outcome == flown("paper").outcome
    for name in ROW.names:
        np.testing.assert_array_equal(flight.record[name], flown("paper").record[name])


def test_scenario_inside_a_recording_flies_the_same_flight_again(saved):
    flight = load(saved)
    again = fly(flight.scenario)
    for name in ROW.names:
        np.testing.assert_array_equal(again.record[name], flight.record[name])


def test_any_netcdf_reader_finds_units_and_provenance(saved):
    with xarray.open_dataset(saved) as dataset:
        assert dataset["airspeed"].attrs["units"] == "m/s"
        assert set(dataset.variables) == {variable.name for variable in VARIABLES}
        assert all(dataset[v.name].attrs["long_name"] for v in VARIABLES)
        assert dataset.attrs["outer_loop_rate_hz"] == 100.0
        assert dataset.attrs["jsbsim_rate_hz"] == 200.0
        assert {"ftc-jsb", "jsbsim", "numba"} <= set(json.loads(dataset.attrs["versions"]))


def test_recording_says_with_what_and_where_it_was_flown(flown, saved):
    assert flown("paper").provenance is None  # flown here
    made = load(saved).provenance
    assert made.versions == versions()
    assert made.machine == machine()
    assert "core" in made.machine


def test_dataset_is_a_copy(flown):
    dataset = to_dataset(flown("paper"))
    dataset["airspeed"][:] = 0.0
    assert flown("paper").record["airspeed"][0] == 300.0


def test_what_is_no_recording_is_refused(saved, tmp_path):
    with pytest.raises(RecordingError, match="no such file"):
        load(tmp_path / "none.nc")
    text = tmp_path / "text.nc"
    text.write_text("not NetCDF")
    with pytest.raises(RecordingError, match="not a readable NetCDF file"):
        load(text)
    cut = tmp_path / "cut.nc"
    cut.write_bytes(saved.read_bytes()[: saved.stat().st_size // 2])
    with pytest.raises(RecordingError, match=r"cut\.nc"):
        load(cut)
    spoilt = bytearray(saved.read_bytes())
    for place in range(len(spoilt) // 3, len(spoilt), 997):
        spoilt[place] ^= 0xFF
    cut.write_bytes(spoilt)
    with pytest.raises(RecordingError, match=r"cut\.nc"):
        load(cut)
    other = tmp_path / "other.nc"
    xarray.Dataset({"x": 1}).to_netcdf(other)
    with pytest.raises(
        RecordingError, match="not a recording of this program: it has no 'scenario'"
    ):
        load(other)
