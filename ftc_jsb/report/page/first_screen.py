"""The first screen: what was flown, whether the fault was tolerated, whether the point mass told the truth."""

from typing import Any, NamedTuple

from markupsafe import Markup

from ftc_jsb.analysis.ftc_effect import HELPED, HURT, NO_DIFFERENCE
from ftc_jsb.analysis.verdict import passed, reservations
from ftc_jsb.recording.flight import Flight
from ftc_jsb.report.fault_times import fault_times
from ftc_jsb.report.flight_groups import Flights, by_scenario
from ftc_jsb.report.page.linked_numbers import linked_number
from ftc_jsb.report.page.scenario_facts import air_and_sensors, fault_sentences
from ftc_jsb.report.titles import loop_title, model_title
from ftc_jsb.report.verdicts import verdict

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


def linked_verdict(document: Document, label: str) -> Markup:
    """How a flight ended and what else is to be said of it, its numbers linked to metrics.json."""
    metrics = document["flights"][label]
    words, time_at = verdict(metrics)
    found = Markup("{}").format(words)
    if time_at is not None:
        time = linked_number(document, ("flights", label, *time_at), 1)
        found += Markup(" at {} s").format(time)
    for said in reservations(metrics):
        number = linked_number(document, ("flights", label, *said.place), said.digits, said.factor)
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
    order = {"flightgear": 0, "jsbsim": 1, "identified": 2, "paper": 3}
    labels = [k for k, f in members.items() if f.scenario.loop.name not in INTOLERANT]
    return sorted(labels, key=lambda label: order[members[label].scenario.model])


def _tolerated(label: str, members: Flights, document: Document) -> Answer:
    scenario = members[label].scenario
    subject = model_title(scenario)
    if scenario.loop.name != "ftc":
        subject += f", {loop_title(scenario)}"
    good = passed(document["flights"][label])
    sentence = Markup("{}; airspeed RMSE {} m/s").format(
        linked_verdict(document, label),
        linked_number(document, ("flights", label, "rmse_airspeed_mps"), 3),
    )
    sentence += _given_up(label, document)
    return Answer(GOOD if good else BAD, "Yes" if good else "No", subject, sentence)


def _helped(index: int, members: Flights, document: Document) -> Answer:
    """Whether FTC helped, of a pair of flights, with the numbers that say so."""
    pair = document["ftc_helped"][index]
    place = ("ftc_helped", index)
    kind = {HELPED: GOOD, NO_DIFFERENCE: HALF, HURT: BAD}[pair["answer"]]
    scenario = members[pair["with_ftc"]].scenario
    sentence = Markup("airspeed RMSE: {} {} m/s, {} {} m/s ({})").format(
        loop_title(scenario),
        linked_number(document, (*place, "rmse_airspeed_with_mps"), 3),
        loop_title(members[pair["without_ftc"]].scenario),
        linked_number(document, (*place, "rmse_airspeed_without_mps"), 2),
        linked_verdict(document, pair["without_ftc"]),
    )
    return Answer(kind, pair["answer"].capitalize(), model_title(scenario), sentence)


def _given_up(label: str, document: Document) -> Markup:
    """What inside the limits was not flown as asked for, for want of thrust."""
    found = Markup("")
    for key, name, unit in (
        ("peak_climb_given_up_deg", "of path", "deg"),
        ("peak_turn_given_up_deg_s", "of turn", "deg/s"),
        ("peak_airspeed_given_up_mps", "of airspeed", "m/s"),
    ):
        if (document["flights"][label].get(key) or 0.0) >= LEAST_GIVEN_UP:
            most = linked_number(document, ("flights", label, key), 1)
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
        linked_number(document, (*place, "decides", "rms"), 3),
        entry["decides"]["unit"],
        linked_number(document, (*place, "decides", "times_agreed"), 1),
        linked_number(document, (*place, "decides", "agreed"), 1),
        entry["decides"]["unit"],
    )
    for part, name in (("motion", "motion and commands"), ("tracking_errors", "tracking errors")):
        coefficient = linked_number(document, (*place, part, "theil"), 2)
        title = entry[part]["title"].lower()
        text += Markup("; largest U of {} {} ({})").format(name, coefficient, title)
    return Answer(kind, entry["answer"].capitalize(), entry["model"], text)
