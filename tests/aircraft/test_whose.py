"""A point mass or an inner loop that belongs to another aircraft is refused by name."""

import shutil

import pytest

from ftc_jsb.aircraft.description import load_aircraft
from ftc_jsb.errors import AircraftError
from ftc_jsb.resources import aircraft_folder
from ftc_jsb.scenario.load import load_scenario
from ftc_jsb.simulation.fly import fly


def folder_of(tmp_path, aircraft: str, inner_loop: str, point_mass: str):
    """An aircraft folder with files of several aircraft."""
    folder = tmp_path / "mine"
    folder.mkdir()
    for name, file in (
        (aircraft, "aircraft.toml"),
        (inner_loop, "inner_loop.xml"),
        (point_mass, "point_mass.toml"),
    ):
        shutil.copy(aircraft_folder(name) / file, folder)
    return folder


@pytest.mark.parametrize("model", ["identified", "jsbsim"])
def test_point_mass_of_another_aircraft(model, tmp_path):
    folder = folder_of(tmp_path, "A4", "A4", "T38")
    with pytest.raises(AircraftError, match=r"the point mass of 'T38', not of 'A4'"):
        fly(load_scenario("nominal", [f"model={model}", f"aircraft.name='{folder}'"]))


def test_point_mass_of_another_aircraft_that_does_not_say_whose(tmp_path):
    """By area, mass and engines, which JSBSim knows."""
    folder = folder_of(tmp_path, "A4", "A4", "T38")
    path = folder / "point_mass.toml"
    path.write_text(path.read_text().replace('jsbsim_model = "T38"\n', ""))
    with pytest.raises(AircraftError, match=r"T-38.*15\.79 m2, 2 engines.*'A4' has.*24\.15 m2"):
        fly(load_scenario("nominal", ["model=jsbsim", f"aircraft.name='{folder}'"]))


def test_inner_loop_of_another_aircraft(tmp_path):
    folder = folder_of(tmp_path, "A4", "T38", "A4")
    with pytest.raises(AircraftError, match=r"the inner loop of 'T38', not of 'A4'"):
        fly(load_scenario("nominal", ["model=jsbsim", f"aircraft.name='{folder}'"]))


@pytest.mark.parametrize(
    ("key", "value", "says"),
    [
        ("airspeed", "[200.0, 120.0]", "flight_test.airspeed: expected two increasing"),
        ("altitude", "[3048.0, 762.0]", "flight_test.altitude: expected increasing"),
        ("fuel_fraction", "[0.2, 1.4]", "flight_test.fuel_fraction: expected numbers from 0 to 1"),
        ("load_factor", "[2.0, 6.0]", "flight_test.load_factor: expected one below"),
    ],
)
def test_impossible_test_range_is_named(key, value, says, tmp_path):
    folder = folder_of(tmp_path, "A4", "A4", "A4")
    path = folder / "aircraft.toml"
    lines = path.read_text().splitlines()
    lines = [f"{key} = {value}" if line.startswith(f"{key} = ") else line for line in lines]
    path.write_text("\n".join(lines))
    with pytest.raises(AircraftError, match=says):
        load_aircraft(str(folder))
