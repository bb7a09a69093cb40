"""metrics.json is JSON that every reader takes, or is not written."""

import json

import pytest

from ftc_jsb.errors import RecordingError
from ftc_jsb.runs.metrics_file import document, write_metrics


def test_unknown_number_is_null(tmp_path):
    path = tmp_path / "metrics.json"
    write_metrics(path, document({"paper-ftc": {"detection_delay_s": None}}))
    assert json.loads(path.read_text()) == {"flights": {"paper-ftc": {"detection_delay_s": None}}}
    with pytest.raises(ValueError, match="not JSON compliant"):
        write_metrics(path, {"flights": float("nan")})


def test_file_that_cannot_be_written_is_refused(tmp_path):
    with pytest.raises(RecordingError, match="cannot be written: No such file"):
        write_metrics(tmp_path / "none" / "metrics.json", {})
