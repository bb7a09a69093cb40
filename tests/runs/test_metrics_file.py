"""metrics.json is JSON that every reader takes, or is not written."""

import json

import pytest

from ftc_jsb.errors import RecordingError
from ftc_jsb.runs.metrics_file import document, write_metrics


def test_unknown_number_is_null(tmp_path):
    path = tmp_path / "metrics.json"
    write_metrics(path, document({"paper-ftc": {"detection_delay_s": None}}))
    assert json.loads(path.read_text()) == {"flights": {"paper-ftc": {"detection_delay_s": None}}}


def test_number_that_is_not_finite_is_null_and_says_why(tmp_path):
    path = tmp_path / "metrics.json"
    write_metrics(path, document({"paper-ftc": {"peaks": [1.0, float("inf")], "k": float("nan")}}))
    written = json.loads(path.read_text(), parse_constant=pytest.fail)
    assert written["flights"]["paper-ftc"] == {
        "peaks": [1.0, None],
        "k": None,
        "not_finite": {"peaks.1": "inf: beyond the largest number", "k": "nan: undefined"},
    }


def test_file_that_cannot_be_written_is_refused(tmp_path):
    with pytest.raises(RecordingError, match="cannot be written: No such file"):
        write_metrics(tmp_path / "none" / "metrics.json", {})
