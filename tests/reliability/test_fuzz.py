"""Every door takes anything: what it cannot use it refuses in a sentence, at once and in little memory.

Structured: each case is a file or a message that is valid, with a few values put in the place of others.
In the suite some dozens of cases a door; `make fuzz` has 100,000 a door.
"""

import functools
import json
import os
import resource
import time
import tomllib
from pathlib import Path

import netCDF4
import numpy as np
import pytest
import tomli_w
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st
from pymavlink.dialects.v20 import common as dialect

from ftc_jsb.aircraft.description import load_aircraft
from ftc_jsb.aircraft.point_mass_file import load_point_mass
from ftc_jsb.analysis.metrics import flight_metrics
from ftc_jsb.campaign.load import load_campaign
from ftc_jsb.errors import UserError
from ftc_jsb.flightgear.lines import line_of, numbers_of
from ftc_jsb.mavlink.link.receiver import Receiver
from ftc_jsb.recording.netcdf import load, save
from ftc_jsb.report.measured_margins import read_margins
from ftc_jsb.resources import shipped
from ftc_jsb.scenario.load import load_scenario, parse_scenario

CASES = int(os.environ.get("FTC_JSB_FUZZ", "0"))  # a door; 0 as many as the suite has time for
LONGEST = 2.0  # [s] of processor time of a case
MOST_MEMORY = 1_000_000  # [kB] that the process may grow by

numbers = st.one_of(
    st.floats(), st.integers(-(2**63), 2**63 - 1), st.sampled_from([0, -1, 1e-323, 1e308, 2**31])
)
texts = st.one_of(
    st.text(max_size=40), st.sampled_from(["", "../../x", "/dev/zero", "x" * 5000, "²"])
)
values = st.recursive(
    st.one_of(numbers, texts, st.booleans()),
    lambda inner: st.one_of(
        st.lists(inner, max_size=4),
        st.dictionaries(st.text("ab²._", max_size=8), inner, max_size=3),
    ),
    max_leaves=8,
)
changes = st.lists(st.tuples(st.integers(0, 10**6), st.sampled_from("rrrda"), values), max_size=4)


def fuzzed(few):
    """A test of `few` cases in the suite, the same every time; of as many others as `make fuzz` asks for."""
    checks = [HealthCheck.too_slow, HealthCheck.function_scoped_fixture, HealthCheck.data_too_large]
    count = CASES or few
    return settings(
        max_examples=count, deadline=None, suppress_health_check=checks, derandomize=not CASES,
        database=None,
    )  # fmt: skip


def bounded(test):
    """See that each case takes less than 2 s, and the process does not grow by more than 1 GB."""

    @functools.wraps(test)
    def timed(*arguments, **options):
        began, memory = time.process_time(), resource.getrusage(resource.RUSAGE_SELF).ru_maxrss
        test(*arguments, **options)
        assert time.process_time() - began < LONGEST
        assert resource.getrusage(resource.RUSAGE_SELF).ru_maxrss - memory < MOST_MEMORY

    return timed


def places(document, found=None):
    """Every table and list of a document with each of its keys."""
    found = [] if found is None else found
    keys = list(document) if isinstance(document, dict) else range(len(document))
    for key in keys:
        found.append((document, key))
        if isinstance(document[key], dict | list):
            places(document[key], found)
    return found


def changed(document, made):
    """A copy of a document with values replaced, deleted or added."""
    copy = json.loads(json.dumps(document))
    for place, what, value in made:
        all_places = places(copy)
        if not all_places:
            break
        table, key = all_places[place % len(all_places)]
        if what == "d":
            del table[key]
        elif what == "a" and isinstance(table, dict):
            table[f"{key}x"] = value
        else:
            table[key] = value
    return copy


def refused_or_used(use):
    """What is used, or the sentence with which it is refused."""
    try:
        return use()
    except UserError as error:
        assert str(error).strip()
        assert len(str(error)) < 20_000
        return None


PAPER = tomllib.loads((shipped("scenarios") / "severe.toml").read_text())
CAMPAIGN = tomllib.loads((shipped("scenarios") / "campaigns" / "smoke.toml").read_text())
AIRCRAFT = tomllib.loads((shipped("aircraft") / "f16" / "aircraft.toml").read_text())
POINT_MASS = tomllib.loads((shipped("aircraft") / "A4" / "point_mass.toml").read_text())
MARGINS = {
    "aircraft": "f16", "model": "jsbsim", "loop": "ftc",
    "channels": {
        "thrust": {
            "gain_margin_inserted_db": 9.0, "phase_margin_deg": 60.0, "delay_margin_inserted_s": 0.2,
        },
    },
}  # fmt: skip


@fuzzed(60)
@given(changes)
@bounded
def test_scenario(made):
    refused_or_used(lambda: parse_scenario(tomli_w.dumps(changed(PAPER, made)), "s.toml"))


@fuzzed(60)
@given(st.text(max_size=200))
@bounded
def test_text_as_scenario(text):
    refused_or_used(lambda: parse_scenario(text, "s.toml"))


@fuzzed(60)
@given(st.lists(st.one_of(texts, st.tuples(texts, texts).map("=".join)), max_size=3))
@bounded
def test_overrides(overrides):
    refused_or_used(lambda: load_scenario("paper", overrides))


@fuzzed(15)
@given(changes)
@bounded
def test_campaign(tmp_path, made):
    path = tmp_path / "campaign.toml"
    path.write_text(tomli_w.dumps(changed(CAMPAIGN, made)))
    refused_or_used(lambda: load_campaign(str(path)))


@fuzzed(40)
@given(changes, changes)
@bounded
def test_aircraft(tmp_path, made, also):
    (tmp_path / "aircraft.toml").write_text(tomli_w.dumps(changed(AIRCRAFT, made)))
    (tmp_path / "point_mass.toml").write_text(tomli_w.dumps(changed(POINT_MASS, also)))
    refused_or_used(lambda: load_aircraft(str(tmp_path)))
    refused_or_used(lambda: load_point_mass(tmp_path))


@fuzzed(60)
@given(st.one_of(changes.map(lambda made: json.dumps(changed(MARGINS, made))), st.text()))
@bounded
def test_margins(tmp_path, text):
    path = tmp_path / "margins.json"
    path.write_text(text, encoding="utf-8", errors="replace")
    refused_or_used(lambda: read_margins(path))


@pytest.fixture(scope="module")
def recording(flown, tmp_path_factory):
    path = tmp_path_factory.mktemp("fuzz") / "flight.nc"
    save(flown("paper", "duration=1"), path)
    return path


columns = st.lists(
    st.tuples(st.integers(0, 10**6), st.integers(0, 100), st.floats(width=64)), max_size=3
)
said = st.dictionaries(
    st.sampled_from(["scenario", "status", "end_time_s", "reason", "commands", "versions", "machine"]),
    st.one_of(
        st.floats(), st.integers(-(2**31), 2**31),
        st.text(max_size=20).map(lambda text: text.replace("\0", "")),
    ),
    max_size=2,
)  # fmt: skip


@fuzzed(12)
@given(said, columns, st.booleans())
@bounded
def test_recording(recording, tmp_path, attributes, cells, sealed):
    """What passes the door has metrics, whatever numbers are in it."""
    path = tmp_path / "flight.nc"
    path.write_bytes(recording.read_bytes())
    with netCDF4.Dataset(path, "a") as file:
        for name, value in attributes.items():
            file.setncattr(name, value)
        names = list(file.variables)
        for column, row, value in cells:
            file.variables[names[column % len(names)]][row] = value
        for name in () if sealed else ("description_sha256", "data_sha256"):
            file.delncattr(name)
    with np.errstate(all="ignore"):
        flight = refused_or_used(lambda: load(path))
        if flight is not None:
            flight_metrics(flight)


@fuzzed(15)
@given(st.lists(st.tuples(st.integers(0, 10**6), st.integers(0, 255)), max_size=6), st.booleans())
@bounded
def test_bytes_of_a_recording(recording, tmp_path, flips, cut):
    contents = bytearray(recording.read_bytes())
    for place, value in flips:
        contents[place % len(contents)] = value
    path = tmp_path / "flight.nc"
    path.write_bytes(contents[: len(contents) // 2] if cut and flips else contents)
    refused_or_used(lambda: load(path))


frames = st.builds(
    lambda command, parameters: dialect.MAVLink_command_long_message(1, 1, command, 0, *parameters),
    st.integers(0, 2**16 - 1), st.lists(st.floats(width=32), min_size=7, max_size=7),
).map(lambda message: message.pack(dialect.MAVLink(None, 255, 190)))  # fmt: skip


@fuzzed(60)
@given(
    st.lists(st.one_of(st.binary(max_size=300), frames), max_size=5), st.booleans(), st.booleans()
)
@bounded
def test_mavlink(pieces, continues, signed):
    """Random bytes and frames, whole and not, as a stream and as datagrams, with a key and without."""
    receiver = Receiver(b"k" * 32 if signed else None)
    for piece in pieces:
        for message in receiver.messages("peer", piece, continues):
            assert not signed
            assert message.get_type()


@fuzzed(60)
@given(st.one_of(st.binary(max_size=200), st.lists(numbers, max_size=8)), st.integers(0, 8))
@bounded
def test_flightgear_line(made, count):
    """A line is refused, or has as many finite numbers as it must."""
    if isinstance(made, list):
        try:
            line = line_of([float(number) for number in made])
        except ValueError:
            return
    else:
        line = made
    found = numbers_of(line, count)
    assert found is None or (len(found) == count and np.all(np.isfinite(found)))


def test_long_lines_and_endless_files_are_bounded(tmp_path):
    began = time.process_time()
    assert numbers_of(b"1," * 10**6, 3) is None
    refused_or_used(lambda: load(Path("/dev/zero")))
    refused_or_used(lambda: read_margins(Path("/dev/zero")))
    assert time.process_time() - began < LONGEST
