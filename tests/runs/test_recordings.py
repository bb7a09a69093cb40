"""Recordings that are read together: each is told apart; one that cannot be read stops no other."""

import pytest

from ftc_jsb.errors import RecordingError
from ftc_jsb.recording.netcdf import save
from ftc_jsb.runs.recordings import labelled_recordings


@pytest.fixture
def recordings(flown, tmp_path):
    """The same flight in two folders, and another."""
    short, other = flown("paper", "duration=1"), flown("paper", "duration=1", "loop.name='no-ftc'")
    paths = []
    for folder, flight in (("a", short), ("b", short), ("c", other)):
        (tmp_path / folder).mkdir()
        paths.append(tmp_path / folder / "flight.nc")
        save(flight, paths[-1])
    return paths


def test_flights_of_one_label_are_told_apart_by_scenario_and_folder(recordings):
    flights, broken, files = labelled_recordings(recordings)
    assert list(flights) == ["paper-ftc (paper, a)", "paper-ftc (paper, b)", "paper-no-ftc"]
    assert broken == []
    assert list(files.values()) == recordings
    assert list(files) == list(flights)


def test_recording_given_twice_is_two_flights(recordings):
    flights, _, _ = labelled_recordings([recordings[0], recordings[0]])
    assert list(flights) == ["paper-ftc (paper, a)", "paper-ftc (paper, a) [1]"]


def test_recording_that_cannot_be_read_stops_no_other(recordings, tmp_path):
    flights, broken, _ = labelled_recordings([tmp_path / "none.nc", recordings[2]])
    assert list(flights) == ["paper-no-ftc"]
    assert len(broken) == 1
    assert broken[0].startswith(f"{tmp_path / 'none.nc'}: no such file")
    with pytest.raises(RecordingError, match=r"none\.nc: no such file; .*nor\.nc: no such file"):
        labelled_recordings([tmp_path / "none.nc", tmp_path / "nor.nc"])
