"""What is shipped has a meaning each."""

from ftc_jsb.runs.inventory import inventory, point_mass_title


def test_everything_shipped_has_a_meaning():
    listed = inventory()
    assert list(listed) == ["scenarios", "aircraft", "loops"]
    for entries in listed.values():
        assert entries
        assert all(entries.values())


def test_aircraft_that_cannot_be_read_says_why():
    assert "no aircraft 'f99'" in point_mass_title("f99")
