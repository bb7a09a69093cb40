"""Digests of a recording: of what it says of itself, and of its rows. What is not as it was written shows."""

import hashlib
from collections.abc import Mapping
from typing import Any

import numpy as np
import numpy.typing as npt

DESCRIPTION, DATA = "description_sha256", "data_sha256"  # attributes of the file
ADDED = ("history", "NCO")  # attributes that other programs add to a file, whatever they do with it


def sealed(attributes: Mapping[str, Any], record: npt.NDArray[Any]) -> dict[str, Any]:
    """Attributes of a file with the digests of rows and attributes.

    Args:
        attributes: texts and numbers.
        record: (rows,) of `columns.ROW`, as they are in the file.
    """
    with_data = {**attributes, DATA: data_digest(record)}
    return {**with_data, DESCRIPTION: description_digest(with_data)}


def description_digest(attributes: Mapping[str, Any]) -> str:
    """SHA-256 of attributes, whatever order they stand in; numbers by their value."""
    digest = hashlib.sha256()
    for name in sorted(attributes):
        value = attributes[name]
        said = value if isinstance(value, str) else repr(float(value))
        for text in (name, said):
            part = text.encode("utf-8", "surrogatepass")
            digest.update(b"%d " % len(part) + part)
    return digest.hexdigest()


def data_digest(record: npt.NDArray[Any]) -> str:
    """SHA-256 of a recording's columns, each by its name and its numbers."""
    digest = hashlib.sha256()
    for name in record.dtype.names or ():
        digest.update(name.encode() + b" ")
        digest.update(np.ascontiguousarray(record[name], dtype="<f8").data)
    return digest.hexdigest()
