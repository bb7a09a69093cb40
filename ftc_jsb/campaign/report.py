"""placeholder."""

from pathlib import Path
from typing import Any


def write_campaign_report(folder: Path) -> dict[str, Any]:
    """Placeholder."""
    return {"lines": []}
