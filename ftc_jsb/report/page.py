"""The report: one self-contained HTML file, its figures, and the metrics beside it."""

import re
from pathlib import Path
from typing import Any

import jinja2
import markupsafe

from ftc_jsb.errors import RecordingError
from ftc_jsb.metrics import Metrics, flight_metrics, passed
from ftc_jsb.report import words
from ftc_jsb.report.figures import by_model, draw_all, model_pairs
from ftc_jsb.report.validity import compare_flights
from ftc_jsb.scenario.load import scenario_toml
from ftc_jsb.simulation.flight import Flight
from ftc_jsb.simulation.recording import versions
from ftc_jsb.simulation.session import document, write_metrics

CAPTIONS = {
    "figure1_states": """Figure 1. Airspeed, flight path angle and heading, with the references from the
    command filter.""",
    "figure2_controls": """Figure 2. Commanded thrust (what a healthy engine would deliver), load factor and
    bank angle.""",
    "tracking_errors": "Tracking errors: true value minus reference.",
    "figure3_trajectories": """Figure 3. Trajectories; the dot is where the fault sets in. The three axes are
    not to one scale.""",
    "figure4_effectiveness": """Figure 4. Estimate of the thrust effectiveness with its ±2σ band, and its
    error. In the flights without FTC the same filter runs, but the law does not listen to it. With the
    paper's Q and R the band is thinner than the line: it knows of no error of the drag and thrust models,
    and is no confidence band.""",
    "figure4_load_factor": "Figure 4 for the load factor. Grey: not observable there.",
    "figure4_bank_angle": "Figure 4 for the bank angle. Grey: not observable there.",
    "differences": """Figure 5. What each point mass predicts minus what the JSBSim aircraft did, with the
    same outer loop.""",
}


def write_report(flights: dict[str, Flight], folder: Path, command: str) -> dict[str, Metrics]:
    """Write `report.html`, `metrics.json` and `figures/` for flights by label.

    Args:
        flights: at least one.
        folder: exists and is writable.
        command: as typed, for the foot of the report.

    Returns:
        The metrics of each flight.
    """
    metrics = {label: flight_metrics(flight) for label, flight in flights.items()}
    environment = jinja2.Environment(
        loader=jinja2.PackageLoader("ftc_jsb.report", "templates"),
        autoescape=True,
        trim_blocks=True,
        lstrip_blocks=True,
        undefined=jinja2.StrictUndefined,
    )
    try:
        write_metrics(folder / "metrics.json", document(metrics))
        drawings = draw_all(flights, folder / "figures")
        page = environment.get_template("report.html").render(
            _contents(flights, metrics, drawings, command)
        )
        (folder / "report.html").write_text(page, encoding="utf-8")
    except OSError as error:
        raise RecordingError(f"{folder}: the report cannot be written: {error}") from None
    return metrics


def _contents(
    flights: dict[str, Flight],
    metrics: dict[str, Metrics],
    drawings: dict[str, str],
    command: str,
) -> dict[str, Any]:
    first = next(iter(flights.values())).scenario
    columns = [
        {
            "label": label,
            "model": words.model_title(flight.scenario),
            "scenario": "" if _same_scenario(flights) else flight.scenario.name,
            "loop": words.loop_title(flight.scenario),
            "verdict": words.verdict(metrics[label]),
            "passed": passed(metrics[label]),
        }
        for label, flight in flights.items()
    ]
    rows = [
        {
            "title": figure.title,
            "unit": figure.unit,
            "cells": [
                {
                    "text": words.shown(figure, metrics[label]),
                    "best": label in _best(figure, flights, metrics),
                }
                for label in flights
            ],
        }
        for figure in words.FIGURES
    ]
    return {
        "title": _title(flights),
        "description": first.description.strip() if _same_scenario(flights) else "",
        "columns": columns,
        "rows": rows,
        "summary": summary(flights, metrics),
        "differences": [
            {"point_mass": title, "loop": words.loop_title(one.scenario), "rows": compare_flights(one, other)}
            for title, couples in model_pairs(flights).items()
            for one, other in couples
        ],
        "figures": [
            {
                "name": name,
                "svg": _inline(text, name),
                "caption": CAPTIONS[name],
                "columns": len(model_pairs(flights) if name == "differences" else by_model(flights)),
            }
            for name, text in drawings.items()
        ],
        "scenarios": _distinct_scenarios(flights),
        "versions": versions(),
        "seed": first.seed,
        "command": command,
    }  # fmt: skip


def _same_scenario(flights: dict[str, Flight]) -> bool:
    return len({flight.scenario.name for flight in flights.values()}) == 1


def _title(flights: dict[str, Flight]) -> str:
    first = next(iter(flights.values())).scenario
    if _same_scenario(flights):
        return first.title or first.name
    names = list(dict.fromkeys(flight.scenario.name for flight in flights.values()))
    return f"{len(flights)} flights of the scenarios {', '.join(names)}"


def summary(flights: dict[str, Flight], metrics: dict[str, Metrics]) -> list[str]:
    """What a reader must know first, a sentence for each model flown with and without FTC."""
    sentences = []
    for label, flight in flights.items():
        if flight.scenario.loop.name != "ftc":
            continue
        without = f"{flight.scenario.model}-no-ftc"
        mine = metrics[label]["rmse_airspeed_mps"]
        if without not in metrics or not mine or metrics[without]["rmse_airspeed_mps"] is None:
            continue
        theirs = metrics[without]["rmse_airspeed_mps"]
        error = metrics[label]["effectiveness_thrust_error_max"]
        told = "" if error is None else f"; the effectiveness is told to within {error:.2g}"
        sentences.append(
            f"{words.model_title(flight.scenario)}: airspeed RMSE {mine:.3f} m/s with FTC, "
            f"{theirs:.2f} m/s without, {theirs / mine:.0f} times as much{told}."
        )
    return sentences


def _best(
    figure: words.Figure, flights: dict[str, Flight], metrics: dict[str, Metrics]
) -> set[str]:
    """Labels of the flights with the least value among those of the same model and scenario.

    Only where the values differ as they are shown, and among flights that were completed.
    """
    if not figure.key.startswith(("rmse", "peak_error", "effectiveness", "detection")):
        return set()
    groups: dict[tuple[str, str], dict[str, float]] = {}
    for label, values in metrics.items():
        if values[figure.key] is not None and values["status"] == "complete":
            scenario = flights[label].scenario
            groups.setdefault((scenario.name, scenario.model), {})[label] = values[figure.key]
    best = set()
    for group in groups.values():
        texts = {label: words.shown(figure, metrics[label]) for label in group}
        least = texts[min(group, key=group.__getitem__)]
        if len(set(texts.values())) > 1:
            best |= {label for label, text in texts.items() if text == least}
    return best


def _distinct_scenarios(flights: dict[str, Flight]) -> list[dict[str, str]]:
    """Scenario texts, those that differ by model and loop alone counted once."""
    texts: dict[str, list[str]] = {}
    for label, flight in flights.items():
        plain = flight.scenario.model_copy(update={"model": "paper"})
        plain = plain.model_copy(update={"loop": plain.loop.model_copy(update={"name": "ftc"})})
        texts.setdefault(scenario_toml(plain), []).append(label)
    return [{"labels": ", ".join(labels), "text": text} for text, labels in texts.items()]


def _inline(svg: str, name: str) -> markupsafe.Markup:
    """An SVG without its XML head, its ids made unique, as wide as the page lets it."""
    text = svg[svg.index("<svg") :]
    text = re.sub(r'\bid="', f'id="{name}-', text)
    text = re.sub(r'(xlink:href|href)="#', rf'\1="#{name}-', text)
    text = text.replace("url(#", f"url(#{name}-")
    return markupsafe.Markup(text)
