"""Every number that a report shows, as `metrics.json` holds it; and the series behind its charts."""

from collections.abc import Callable, Sequence
from typing import Any, NamedTuple

import numpy as np

from ftc_jsb.analysis.command_following import command_following_metrics
from ftc_jsb.analysis.fault_timeline import fault_timeline
from ftc_jsb.analysis.ftc_effect import effects
from ftc_jsb.analysis.lyapunov_bound import proof_along, stability_metrics
from ftc_jsb.analysis.metrics import Metrics, flight_metrics
from ftc_jsb.analysis.model_residuals import Residuals, flight_residuals, residual_metrics
from ftc_jsb.analysis.validity import compare_flights, judge
from ftc_jsb.errors import UserError
from ftc_jsb.report.flight_groups import Flights, by_scenario, loop_pairs, model_pairs
from ftc_jsb.report.measured_margins import MeasuredMargins, margins_of
from ftc_jsb.report.shown_metrics import SHOWN_METRICS
from ftc_jsb.report.titles import model_title
from ftc_jsb.runs.finite_numbers import finite
from ftc_jsb.theory.lyapunov import LyapunovBound


class Findings(NamedTuple):
    """What is found in a set of flights."""

    document: dict[str, Any]  # the contents of metrics.json
    residuals: dict[str, Residuals]  # by label; left out where they cannot be had
    proofs: dict[str, LyapunovBound]  # likewise
    problems: list[str]  # what could not be found, and why


def analyse(
    flights: Flights,
    margins: Sequence[MeasuredMargins] = (),
    tell: Callable[[str], None] = lambda _: None,
) -> Findings:
    """Analyse flights one by one and against each other; what fails is said and stops nothing else.

    Args:
        flights: by label.
        margins: measured apart, for the flights that they are of.
        tell: told which flight is begun.
    """
    problems: list[str] = []
    residuals: dict[str, Residuals] = {}
    proofs: dict[str, LyapunovBound] = {}
    metrics: dict[str, Metrics] = {}
    for label, flight in flights.items():
        tell(f"analysis of {label}")
        entry = {**flight_metrics(flight), **margins_of(flight, margins)}
        entry["response"] = command_following_metrics(flight)
        try:
            residuals[label] = flight_residuals(flight)
            entry["model_residuals"] = residual_metrics(flight, residuals[label])
        except UserError as error:
            entry["model_residuals"] = None
            problems.append(f"{label}: no residuals of its models: {error}")
        proof = proof_along(flight)
        if proof is not None and np.isfinite(proof.value).all():
            proofs[label] = proof
        entry["timeline"] = [stretch._asdict() for stretch in fault_timeline(flight)]
        entry["stability"] = stability_metrics(proofs.get(label))
        metrics[label] = finite(entry)
    validity = _validity(flights, metrics)
    document = {
        "flights": metrics,
        "ftc_helped": effects(flights, metrics),
        "with_and_without": [_ratio(a, b, metrics) for a, b in loop_pairs(flights)],
        "validity": validity,
        "point_mass_told_the_truth": _truth(flights, validity),
    }
    return Findings(finite(document), residuals, proofs, problems)


def _ratio(tolerant: str, plain: str, metrics: dict[str, Metrics]) -> dict[str, Any]:
    """Every judged number without FTC over that with it; None where there is none or a zero."""
    ratios = {}
    for metric in SHOWN_METRICS:
        if not metric.judged:
            continue
        above, below = metrics[plain].get(metric.key), metrics[tolerant].get(metric.key)
        ratios[metric.key] = None if above is None or not below else above / below
    return {"with_ftc": tolerant, "without_ftc": plain, "ratio": ratios}


def _validity(flights: Flights, metrics: dict[str, Metrics]) -> list[dict[str, Any]]:
    return [
        {
            "point_mass": one,
            "jsbsim": other,
            "same_verdict": metrics[one]["verdict"] == metrics[other]["verdict"],
            "variables": compare_flights(flights[one], flights[other]),
        }
        for one, other in model_pairs(flights)
    ]


def _truth(flights: Flights, validity: list[dict[str, Any]]) -> list[dict[str, Any]]:
    """One answer a scenario and point mass, over all its loops."""
    answers = []
    for name, members in by_scenario(flights).items():
        models: dict[str, list[dict[str, Any]]] = {}
        for pair in validity:
            if pair["point_mass"] in members:
                title = model_title(flights[pair["point_mass"]].scenario)
                models.setdefault(title, []).append(pair)
        agreement = next(iter(members.values())).scenario.compare.agreement
        answers += [
            {"scenario": name, "model": title, **judge(pairs, agreement)}
            for title, pairs in models.items()
        ]
    return answers
