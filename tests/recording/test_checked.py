"""What opens as NetCDF is no recording yet: each field that may be wrong is refused, in one sentence."""

import shutil

import netCDF4
import numpy as np
import pytest

from ftc_jsb.errors import RecordingError
from ftc_jsb.recording.columns import ROW
from ftc_jsb.recording.integrity import DATA, DESCRIPTION
from ftc_jsb.recording.netcdf import load, save


@pytest.fixture(scope="module")
def whole(flown, tmp_path_factory):
    path = tmp_path_factory.mktemp("recording") / "flight.nc"
    save(flown("paper", "duration=1"), path)
    return path


def changed(whole, tmp_path, change, digests=False):
    """A copy of a recording, changed by the library as any program would, without its digests or with them."""
    path = tmp_path / "changed.nc"
    shutil.copy(whole, path)
    with netCDF4.Dataset(path, "a") as file:
        file.set_auto_maskandscale(False)
        change(file)
        if not digests:
            for name in {DATA, DESCRIPTION} & set(file.ncattrs()):
                file.delncattr(name)
    return path


def rewritten(whole, tmp_path, rows=None, change=lambda name, values: values, **attributes):
    """A recording of the same attributes with other columns, without digests."""
    path = tmp_path / "rewritten.nc"
    with netCDF4.Dataset(whole) as old, netCDF4.Dataset(path, "w") as new:
        old.set_auto_maskandscale(False)
        said = {name: old.getncattr(name) for name in old.ncattrs()}
        new.setncatts({k: v for k, v in {**said, **attributes}.items() if "sha256" not in k})
        new.createDimension("time", old.dimensions["time"].size if rows is None else rows)
        for name, column in old.variables.items():
            values = change(name, column[:])
            if values is not None:
                new.createVariable(name, values.dtype, "time", zlib=True)[:] = values[:rows]
    return path


@pytest.mark.parametrize(
    ("name", "value", "said"),
    [
        ("end_time_s", "3 s", r"end_time_s: expected a number.*'3 s'"),
        ("end_time_s", np.nan, "end_time_s: .*finite"),
        ("end_time_s", -1.0, "end_time_s: .*greater than or equal to 0"),
        ("end_time_s", 1e300, "end_time_s: 1e\\+300 s; expected 0 to 1"),
        ("end_time_s", np.array([1.0, 2.0]), "end_time_s"),
        ("status", "fine", "status: .*'complete', 'ended'"),
        ("status", 1, "status"),
        ("reason", 7, "reason: .*valid string"),
        ("versions", "[1, 2]", "versions: "),
        ("versions", "{", "versions: "),
        ("machine", 5, "machine: "),
        ("scenario", "name = 5", "name"),
        ("scenario", "[" * 10_000, "scenario inside the recording"),
        ("scenario", "a" + ".a" * 20_000 + " = 1", "scenario inside the recording"),
        ("commands", "[", "commands: "),
        ("commands", '[{"row": 7000000, "command": {"kind": "end"}}]', "rows must increase"),
    ],
)
def test_attribute_that_is_wrong_is_named(whole, tmp_path, name, value, said):
    path = changed(whole, tmp_path, lambda file: file.setncattr(name, value))
    with pytest.raises(RecordingError, match=said) as refused:
        load(path)
    assert str(refused.value).startswith(str(path))


def test_columns_and_rows_are_checked_before_they_are_read(whole, tmp_path):
    with pytest.raises(RecordingError, match=r": 0 rows; expected 1 to 101"):
        load(rewritten(whole, tmp_path, rows=0))
    with pytest.raises(RecordingError, match="it has no 'altitude'"):
        load(rewritten(whole, tmp_path, change=lambda n, v: None if n == "altitude" else v))
    with pytest.raises(RecordingError, match="'altitude': expected numbers of 64 bits"):
        load(
            rewritten(whole, tmp_path, change=lambda n, v: v.astype(int) if n == "altitude" else v)
        )
    path = tmp_path / "huge.nc"
    with netCDF4.Dataset(whole) as old, netCDF4.Dataset(path, "w") as new:
        new.setncatts({k: old.getncattr(k) for k in old.ncattrs() if "sha256" not in k})
        new.createDimension("time", 10**10)
        for name in ROW.names:
            new.createVariable(name, float, "time", chunksizes=[1000])
    with pytest.raises(RecordingError, match="10000000000 rows; expected 1 to 101"):
        load(path)
    other = tmp_path / "other.nc"
    with netCDF4.Dataset(other, "w") as new:
        with netCDF4.Dataset(whole) as old:
            new.setncatts({k: old.getncattr(k) for k in old.ncattrs() if "sha256" not in k})
        new.createDimension("time", 101)
        new.createDimension("altitude", 7)
        for name in ROW.names:
            new.createVariable(name, float, "altitude" if name == "altitude" else "time")
    with pytest.raises(RecordingError, match=r"along 'time' .got float64 along altitude"):
        load(other)


@pytest.mark.parametrize("spoil", ["nan", "sorted", "late"])
def test_time_runs_as_in_a_flight(whole, tmp_path, spoil):
    def spoilt(file):
        times = file.variables["time"][:]
        times[50:] = {"nan": np.nan, "sorted": times[50:][::-1], "late": times[50:] + 0.3}[spoil]
        file.variables["time"][:] = times

    with pytest.raises(RecordingError, match=r"row 50: time is .* s; expected 0\.5"):
        load(changed(whole, tmp_path, spoilt))


def test_what_was_changed_since_is_said_to_be_damaged(whole, tmp_path):
    def other_number(file):
        file.variables["airspeed"][3] = 299.0

    with pytest.raises(RecordingError, match=r"damaged.*its rows are not those that were written"):
        load(changed(whole, tmp_path, other_number, digests=True))

    def other_word(file):
        file.setncattr("machine", file.getncattr("machine").replace("cores", "corew"))

    with pytest.raises(RecordingError, match=r"damaged.*its attributes are not those"):
        load(changed(whole, tmp_path, other_word, digests=True))
    load(changed(whole, tmp_path, lambda file: None))  # of before there were digests
    load(changed(whole, tmp_path, lambda f: f.setncattr("history", "ncks"), digests=True))


def test_flipped_bits_are_found_or_change_nothing(whole, tmp_path):
    """Each of 150 files with one flipped bit is refused, or what is read is what was written."""
    contents, path = whole.read_bytes(), tmp_path / "flipped.nc"
    before, places = load(whole), np.random.default_rng(1).integers(0, len(contents), 150)
    refused = 0
    for number, place in enumerate(places):
        flipped = bytearray(contents)
        flipped[place] ^= 1 << number % 8
        path.write_bytes(flipped)
        try:
            now = load(path)
        except RecordingError as error:
            assert str(error).count(str(path)) == 1
            refused += 1
        else:
            assert (now.scenario, now.outcome) == (before.scenario, before.outcome)
            assert now.record.tobytes() == before.record.tobytes()
    assert refused > 30
