"""A MATLAB file: the variables in a struct, their units and meanings in two others."""

from pathlib import Path

from ftc_jsb.recording.flight import Flight


def write(flight: Flight, path: Path) -> None:
    """Write `flight.airspeed`, `units.airspeed`, `meanings.airspeed`, …, and `attributes.scenario`."""
    from scipy.io import savemat

    from ftc_jsb.recording.dataset import to_dataset

    dataset = to_dataset(flight)
    names = [str(name) for name in dataset.variables]
    contents = {
        "flight": {name: dataset[name].to_numpy() for name in names},
        "units": {name: dataset[name].attrs["units"] for name in names},
        "meanings": {name: dataset[name].attrs["long_name"] for name in names},
        "attributes": {str(name): value for name, value in dataset.attrs.items()},
    }
    savemat(
        str(path), contents, appendmat=False, long_field_names=True, do_compression=True,
        oned_as="column",
    )  # fmt: skip
