"""Files that the page links to: the scenarios, which are written beside it, and the recordings."""

import os
import re
from collections.abc import Mapping
from pathlib import Path
from typing import NamedTuple
from urllib.parse import quote

from ftc_jsb.atomic_file import write_text
from ftc_jsb.report.flight_groups import Flights, by_scenario, flown_scenario
from ftc_jsb.report.titles import flight_titles
from ftc_jsb.scenario.load import scenario_toml

LONGEST = 100  # characters of a list on one line
_VALUE = r"""(?:[^\[\]"'#,\n]+|"[^"\n]*"|\[[^\[\]\n]*\])"""
_LIST = re.compile(rf"\[\n((?: +{_VALUE},\n)+) *\]")


class LinkedFile(NamedTuple):
    """A link of the first screen."""

    kind: str  # "Scenario" or "Recording"
    title: str
    address: str  # relative to the page


def scenario_text(members: Flights) -> str:
    """The scenario of one group of flights as TOML, short lists on one line."""
    text, before = scenario_toml(flown_scenario(members)), ""
    while text != before:  # inner lists first
        text, before = _LIST.sub(_on_one_line, text), text
    return text


def _on_one_line(found: re.Match[str]) -> str:
    line = ", ".join(item.strip().rstrip(",") for item in found[1].splitlines())
    return f"[{line}]" if len(line) < LONGEST else found[0]


def write_scenarios(flights: Flights, folder: Path) -> list[LinkedFile]:
    """Write the scenario of each group of flights: `scenario.toml`, of several `scenario-<name>.toml`.

    Raises:
        OSError: the folder cannot be written.
    """
    groups = by_scenario(flights)
    links = []
    for name, members in groups.items():
        plain = re.sub(r"[^A-Za-z0-9._-]+", "-", name).strip("-")
        file = "scenario.toml" if len(groups) == 1 else f"scenario-{plain}.toml"
        write_text(folder / file, scenario_text(members))
        links.append(LinkedFile("Scenario", file, quote(file)))
    return links


def recording_links(
    flights: Flights, recordings: Mapping[str, Path], folder: Path
) -> list[LinkedFile]:
    """Links to the recordings that are known, as seen from the page's folder."""
    titles = flight_titles(flights)
    links = []
    for label in flights:
        if label not in recordings:
            continue
        try:
            address = os.path.relpath(recordings[label].resolve(), folder.resolve())
        except ValueError:  # on another drive
            continue
        links.append(LinkedFile("Recording", titles[label], quote(Path(address).as_posix())))
    return links
