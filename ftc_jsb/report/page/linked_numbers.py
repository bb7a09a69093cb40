"""Numbers on the page, each linked to its place in `metrics.json`."""

import json
from typing import Any, NamedTuple

import markupsafe

from ftc_jsb.report.shown_metrics import number_text

Path = tuple[str | int, ...]


class LinkedNumber(NamedTuple):
    """A number as it is shown, and where it comes from."""

    text: str
    value: Any  # as in metrics.json; None is unknown
    at: str  # JSON pointer (RFC 6901)
    scale: float  # from metrics.json to what is shown

    def __html__(self) -> markupsafe.Markup:
        """The number in a `data` element that says where it is in metrics.json."""
        if self.value is None:
            return markupsafe.Markup("–")
        return markupsafe.Markup('<data value="{}" data-at="{}" data-scale="{}">{}</data>').format(
            json.dumps(self.value), self.at, repr(self.scale), self.text
        )


def linked_number(
    document: dict[str, Any], path: Path, digits: int, scale: float = 1.0, rounded: bool = False
) -> LinkedNumber:
    """A number of the document; a dash where it is null or there is none."""
    value: Any = document
    for key in path:
        if value is not None:
            value = value[key] if isinstance(key, int) else value.get(key)
    at = "".join(f"/{str(key).replace('~', '~0').replace('/', '~1')}" for key in path)
    text = number_text(None if value is None else scale * value, digits, rounded)
    return LinkedNumber(text, value, at, scale)
