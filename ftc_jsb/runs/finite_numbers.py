"""Numbers for files: what is not finite is null, with the reason beside it. NaN and Infinity are no JSON."""

import math
from typing import Any

NOT_FINITE = "not_finite"  # key of the reasons in a document


def finite(document: dict[str, Any]) -> dict[str, Any]:
    """A document with null for every number that is not finite, and, if there are any, the reasons.

    Args:
        document: tables, lists and values, as JSON has them.

    Returns:
        A copy; under "not_finite" the reason for each, by its dotted key.
    """
    reasons: dict[str, str] = {}
    known: dict[str, Any] = _known(document, (), reasons)
    return {**known, NOT_FINITE: reasons} if reasons else known


def _known(value: Any, path: tuple[str, ...], reasons: dict[str, str]) -> Any:
    if isinstance(value, dict):
        return {key: _known(entry, (*path, str(key)), reasons) for key, entry in value.items()}
    if isinstance(value, list | tuple):
        return [_known(entry, (*path, str(i)), reasons) for i, entry in enumerate(value)]
    if isinstance(value, float) and not math.isfinite(value):
        why = "nan: undefined" if math.isnan(value) else f"{value}: beyond the largest number"
        reasons[".".join(path)] = why
        return None
    return value
