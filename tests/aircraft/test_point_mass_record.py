"""The MODEL record of a `point_mass.toml`: every field has its key, and what is absent stays 0."""

import numpy as np

from ftc_jsb.aircraft.point_mass_file import load_point_mass
from ftc_jsb.aircraft.point_mass_record import COUNTS, VALUES
from ftc_jsb.point_mass.model import MODEL
from ftc_jsb.resources import aircraft_folder


def test_every_field_takes_one_key():
    """A field that nobody fills would be flown as 0."""
    fields = [*VALUES, *COUNTS, "mass", "mass_start"]
    assert sorted(fields) == sorted(MODEL.names or ())


def test_rows_and_tables_fill_the_beginning_of_their_arrays():
    f16 = load_point_mass(aircraft_folder("f16"))
    model, deck = f16.record(0.5)[0], f16.thrust
    rows, columns = len(deck.mach), len(deck.altitude)
    assert (model["deck_mach_count"], model["deck_altitude_count"]) == (rows, columns)
    np.testing.assert_array_equal(model["thrust_maximum"][:rows, :columns], deck.maximum)
    assert not model["thrust_maximum"][rows:].any()
    assert not model["thrust_maximum"][:, columns:].any()
    assert model["mass"] == f16.mass.empty + 0.5 * f16.mass.fuel_capacity


def test_parts_that_a_file_lacks_stay_zero():
    """Table 1 of the paper has neither a drag table nor drag from measured angles nor a range."""
    paper = load_point_mass(aircraft_folder("paper")).record(0.0)[0]
    assert paper["constant_density"] > 0.0
    for field in ("lift_count", "measured_mach_count", "valid_mach", "drag_table"):
        assert not np.any(paper[field])
