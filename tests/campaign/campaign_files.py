"""Campaigns of short flights of the paper's point mass, as files in a test's folder."""

from pathlib import Path

SMALL = """
name = "small"
scenarios = ["paper"]
models = ["paper"]
loops = ["ftc", "no-ftc"]
cases = 12
seed = 3
overrides = { duration = 8.0 }

[[dispersion]]
key = "fault[0].effectiveness"
distribution = "uniform"
low = 0.2
high = 1.0

[[dispersion]]
key = "fault[0].start"
distribution = "truncated-normal"
mean = 3.0
deviation = 1.0
low = 2.0
high = 6.0

[[dispersion]]
key = "sensors.profile"
distribution = "choice"
values = ["perfect", "tactical"]
"""


def campaign_file(folder: Path, text: str = SMALL, **changes: str) -> Path:
    """Write a campaign; `changes` replace lines that begin with `key =`, or stand before the first section."""
    lines = text.splitlines()
    for key, value in changes.items():
        found = [i for i, line in enumerate(lines) if line.startswith(f"{key} =")]
        if found:
            lines[found[0]] = f"{key} = {value}"
        else:
            lines.insert(1, f"{key} = {value}")
    path = folder / "small.toml"
    path.write_text("\n".join(lines) + "\n", encoding="utf-8")
    return path
