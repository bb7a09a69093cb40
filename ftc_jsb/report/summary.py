"""The first screen: what was flown, whether the fault was tolerated, whether the point mass told the truth."""

from collections.abc import Mapping
from typing import Any, NamedTuple

from markupsafe import Markup

from ftc_jsb.analysis.ftc_effect import HELPED, HURT, NO_DIFFERENCE
from ftc_jsb.analysis.verdict import LOST, passed, reservations
from ftc_jsb.recording.flight import Flight
from ftc_jsb.report.display_names import (
    air_and_sensors,
    fault_sentences,
    limit_title,
    loop_title,
    model_title,
)
from ftc_jsb.report.fault_marks import fault_times
from ftc_jsb.report.flight_groups import by_scenario
from ftc_jsb.report.quoted_numbers import quote

Flights = Mapping[str, Flight]
Document = dict[str, Any]
INTOLERANT = ("no-ftc", "law-no-ftc")  # loops that take every actuator for healthy
LEAST_GIVEN_UP = 0.1  # [deg] or [deg/s]: less is not worth a word
GOOD, HALF, BAD = "good", "half", "bad"


class Answer(NamedTuple):
    """A line of the first screen."""

    kind: str  # GOOD, HALF or BAD
    word: str
    subject: str
    sentence: Markup


class Screen(NamedTuple):
    """The first screen of one scenario."""

    name: str
    flown: list[str]
    faulty: bool
    tolerated: list[Answer]
    helped: list[Answer]
    truth: list[Answer]


def first_screen(flights: Flights, document: Document) -> list[Screen]:
    """A screen for each scenario."""
    return [
        Screen(
            name,
            _flown(next(iter(members.values()))),
            any(map(fault_times, members.values())),
            [_tolerated(label, members, document) for label in _judged(members)],
            [
                _helped(index, members, document)
                for index, pair in enumerate(document["ftc_helped"])
                if pair["with_ftc"] in members
            ],
            [
                _truth(index, document)
                for index, entry in enumerate(document["point_mass_told_the_truth"])
                if entry["scenario"] == name
            ],
        )
        for name, members in by_scenario(flights).items()
    ]


def verdict(document: Document, label: str) -> Markup:
    """How a flight ended, its time quoted, and what else is to be said of it."""
    metrics = document["flights"][label]
    found = Markup(metrics["verdict"])
    if metrics["status"] != "complete":
        end = quote(document, ("flights", label, "end_time_s"), 1)
        found = Markup("{} at {} s").format(metrics["status"], end)
    elif metrics["verdict"] == LOST:
        at = quote(document, ("flights", label, "loss_of_control_time_s"), 1)
        found = Markup("{}: {} from {} s").format(LOST, metrics["loss_of_control"], at)
    elif metrics["limits_broken"]:
        at = quote(document, ("flights", label, "limits_broken", 0, "time"), 1)
        name = limit_title(metrics["limits_broken"][0]["name"])
        found = Markup("limit broken: {} at {} s").format(name, at)
    for said in reservations(metrics):
        number = quote(document, ("flights", label, *said.place), said.digits, said.factor)
        found += Markup("; {}{}{}").format(said.before, number, said.after)
    return found


def _flown(flight: Flight) -> list[str]:
    """What the scenario asks for, in its own numbers."""
    scenario = flight.scenario
    start = scenario.initial
    facts = fault_sentences(scenario)
    if not facts:
        facts = ["Faults injected in flight" if fault_times(flight) else "No fault"]
    facts += air_and_sensors(scenario)
    facts.append(
        f"{scenario.duration:g} s from {start.airspeed:g} m/s at {start.altitude:g} m, "
        f"outer loop at {scenario.loop.rate:g} Hz, seed {scenario.seed}"
    )
    return facts


def _judged(members: Flights) -> list[str]:
    """Flights that should tolerate the fault, the 6-DOF aircraft first."""
    order = {"jsbsim": 0, "identified": 1, "paper": 2}
    labels = [k for k, f in members.items() if f.scenario.loop.name not in INTOLERANT]
    return sorted(labels, key=lambda label: order[members[label].scenario.model])


def _tolerated(label: str, members: Flights, document: Document) -> Answer:
    scenario = members[label].scenario
    subject = model_title(scenario)
    if scenario.loop.name != "ftc":
        subject += f", {loop_title(scenario)}"
    good = passed(document["flights"][label])
    sentence = Markup("{}; airspeed RMSE {} m/s").format(
        verdict(document, label), quote(document, ("flights", label, "rmse_airspeed_mps"), 3)
    )
    sentence += _given_up(label, document)
    return Answer(GOOD if good else BAD, "Yes" if good else "No", subject, sentence)


def _helped(index: int, members: Flights, document: Document) -> Answer:
    """Whether FTC helped, of a pair of flights, with the numbers that say so."""
    pair = document["ftc_helped"][index]
    place = ("ftc_helped", index)
    kind = {HELPED: GOOD, NO_DIFFERENCE: HALF, HURT: BAD}[pair["answer"]]
    scenario = members[pair["with_ftc"]].scenario
    sentence = Markup("airspeed RMSE {} m/s with {}, {} m/s with {} ({})").format(
        quote(document, (*place, "rmse_airspeed_with_mps"), 3),
        loop_title(scenario),
        quote(document, (*place, "rmse_airspeed_without_mps"), 2),
        loop_title(members[pair["without_ftc"]].scenario),
        verdict(document, pair["without_ftc"]),
    )
    return Answer(kind, pair["answer"].capitalize(), model_title(scenario), sentence)


def _given_up(label: str, document: Document) -> Markup:
    """What inside the limits was not flown as asked for, for want of thrust."""
    found = Markup("")
    for key, name, unit in (
        ("peak_climb_given_up_deg", "of path", "deg"),
        ("peak_turn_given_up_deg_s", "of turn", "deg/s"),
    ):
        if (document["flights"][label].get(key) or 0.0) >= LEAST_GIVEN_UP:
            most = quote(document, ("flights", label, key), 1)
            found += Markup(", up to {} {} {} given up").format(most, unit, name)
    return found


def _truth(index: int, document: Document) -> Answer:
    entry = document["point_mass_told_the_truth"][index]
    place = ("point_mass_told_the_truth", index)
    kind = {"yes": GOOD, "in part": HALF, "no": BAD}[entry["answer"]]
    same = "same verdicts as JSBSim" if entry["same_verdict"] else "not the verdicts of JSBSim"
    text = Markup("{}; {} differs by {} {} RMS, {} times the {} {} agreed").format(
        same,
        entry["decides"]["title"],
        quote(document, (*place, "decides", "rms"), 3),
        entry["decides"]["unit"],
        quote(document, (*place, "decides", "times_agreed"), 1),
        quote(document, (*place, "decides", "agreed"), 1),
        entry["decides"]["unit"],
    )
    for part, name in (("motion", "motion and commands"), ("tracking_errors", "tracking errors")):
        coefficient = quote(document, (*place, part, "theil"), 2)
        title = entry[part]["title"].lower()
        text += Markup("; largest U of {} {} ({})").format(name, coefficient, title)
    return Answer(kind, entry["answer"].capitalize(), entry["model"], text)
