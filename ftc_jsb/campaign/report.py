"""summary.json, report.html and the scenarios of the worst cases, from the results in a campaign's folder."""

import json
from pathlib import Path
from shlex import quote
from typing import Any

from ftc_jsb.bounded_file import read_bounded_text
from ftc_jsb.campaign.case import Bases, case_of, scenario_of_case
from ftc_jsb.campaign.load import FILE, load_campaign
from ftc_jsb.campaign.page.write import page, percent
from ftc_jsb.campaign.parquet import writing
from ftc_jsb.campaign.store import PROVENANCE, RESULTS, SEARCH, SUBSET
from ftc_jsb.campaign.summary import read_table, summary
from ftc_jsb.errors import RecordingError
from ftc_jsb.scenario.load import scenario_toml

WORST = "worst"
_LARGEST = 100_000_000  # bytes; of a search of a thousand flights 1 MB


def write_campaign_report(folder: Path) -> dict[str, Any]:
    """Write `summary.json`, `report.html` and `worst/`.

    Args:
        folder: of a campaign that is complete.

    Returns:
        The contents of `summary.json`.

    Raises:
        UserError: there is no complete campaign, or the folder cannot be written.
    """
    if not (folder / FILE).is_file():
        raise RecordingError(f"{folder}: no campaign there; expected a folder with {FILE}")
    if not (folder / RESULTS).is_file():
        raise RecordingError(f"{folder}: is not complete; go on with --resume --out {folder}")
    bases = load_campaign(str(folder / FILE))
    table = read_table(folder / RESULTS)
    document = summary(bases.campaign, table)
    for name, path in (("search", folder / SEARCH), ("subset", folder / SUBSET)):
        document[name] = _read_json(path) if path.is_file() else None
    points = table.set_index(["case", "label"])["point"] if "point" in table else None
    for entry in document["worst"]:
        entry["rerun"] = f"ftc-jsb campaign rerun {quote(str(folder))} --case {entry['case']}"
        point = None
        if points is not None:
            point = tuple(points.loc[entry["case"], f"{entry['model']}-{entry['loop']}"])
        entry["file"] = _write_scenario(bases, entry, point, folder)
    document["lines"] = lines(document)
    made = _read_json(folder / PROVENANCE)
    packages = ", ".join(f"{name} {version}" for name, version in made["versions"].items())
    text = page(bases.campaign, document, table, [f"Flown: {packages}; {made['machine']}"])
    for name, contents in (
        ("summary.json", json.dumps(document, indent=2, allow_nan=False) + "\n"),
        ("report.html", text),
    ):
        with writing(folder / name) as part:
            part.write_text(contents, encoding="utf-8")
    return document


def lines(document: dict[str, Any]) -> list[str]:
    """What is printed of a summary."""
    found = []
    for label, flight in document["flights"].items():
        failed = flight["events"].get("failure")
        text = f"{label}: {flight['flown']} flights"
        if failed is not None:
            text += f", outside a limit {percent(failed)}"
        if flight["not_flown"]:
            text += f", {flight['not_flown']} not flown"
        ranked = [e["parameter"] for e in document["importance"][label] if e["value"] > e["chance"]]
        found.append(text + (f"; decided by {', '.join(ranked[:3])}" if ranked else ""))
    found += [
        f"{pair['first']} against {pair['second']}: only the first fails in {pair['only_first_fails']} "
        f"cases, only the second in {pair['only_second_fails']} of {pair['cases']}"
        for pair in document["pairs"]
    ]
    return found + _adaptive_lines(document)


def _adaptive_lines(document: dict[str, Any]) -> list[str]:
    found = []
    search, subset = document["search"], document["subset"]
    if search is not None:
        found.append(
            f"search by {search['method']}: {search['failures']} of {search['flights']} flights fail, "
            f"the first is number {search['first_failure'] or '–'}"
        )
        if "random_flights" in search:
            found.append(
                f"at random: {search['random_failures']} of {search['random_flights']}, "
                f"the first is number {search['random_first_failure'] or '–'}"
            )
    if subset is not None:
        found.append(
            f"subset simulation: probability {subset['probability']:.3g}, coefficient of variation "
            f"{subset['coefficient_of_variation']:.2f}, {subset['flights']} flights"
        )
    return found


def _write_scenario(
    bases: Bases, entry: dict[str, Any], point: tuple[float, ...] | None, folder: Path
) -> str:
    """The scenario of a worst case as a file; its path in the folder."""
    case = case_of(bases, entry["case"], point)
    scenario = scenario_of_case(case, entry["model"], entry["loop"])
    name = f"{WORST}/case-{entry['case']}.toml"
    with writing(folder / name) as part:
        part.write_text(scenario_toml(scenario), encoding="utf-8")
    return name


def _read_json(path: Path) -> dict[str, Any]:
    try:
        return dict(json.loads(read_bounded_text(path, _LARGEST)))
    except (ValueError, RecursionError) as error:
        raise RecordingError(f"{path}: cannot be read: {error}") from None
