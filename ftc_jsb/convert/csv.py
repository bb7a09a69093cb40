"""Comma-separated text: one header line, `name [unit]`, then a line a sample."""

from pathlib import Path

from ftc_jsb.recording.flight import Flight


def write(flight: Flight, path: Path) -> None:
    """Write every variable, with digits enough to read the same numbers back."""
    from ftc_jsb.recording.dataset import to_dataset

    dataset = to_dataset(flight)
    table = dataset.to_dataframe().reset_index()
    table.columns = [f"{name} [{dataset[name].attrs['units']}]" for name in table.columns]
    table.to_csv(path, index=False, na_rep="nan")
