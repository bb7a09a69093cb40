import pytest

from ftc_jsb.aircraft.description import load_aircraft
from ftc_jsb.export.flightgear.aircraft_folder import export_flightgear
from ftc_jsb.scenario.schema import AircraftChoice


@pytest.fixture(scope="session")
def exported(tmp_path_factory):
    """Folder of the F-16 as FlightGear flies it."""
    where = tmp_path_factory.mktemp("flightgear")
    export_flightgear(load_aircraft("f16"), AircraftChoice(), where)
    return where / "f16-ftc"
