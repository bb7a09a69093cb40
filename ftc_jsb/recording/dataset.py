"""A flight as an xarray dataset."""

from typing import TYPE_CHECKING, Any

from ftc_jsb.recording.columns import VARIABLES
from ftc_jsb.recording.description import attributes
from ftc_jsb.recording.flight import Flight

if TYPE_CHECKING:
    import xarray


def to_dataset(flight: Flight) -> "xarray.Dataset":
    """Every variable along `time`, with `units` and `long_name`; the scenario in the attributes."""
    import xarray

    variables: dict[str, Any] = {}
    for variable in VARIABLES:
        described = {"units": variable.unit, "long_name": variable.meaning}
        variables[variable.name] = ("time", flight.record[variable.name].copy(), described)
    return xarray.Dataset(
        {name: content for name, content in variables.items() if name != "time"},
        coords={"time": variables["time"]},
        attrs=attributes(flight),
    )
