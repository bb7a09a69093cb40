"""One report of the six flights of `compare paper`, which several tests look at."""

import json
from pathlib import Path
from typing import Any, NamedTuple

import pytest

from ftc_jsb.recording.flight import Flight
from ftc_jsb.recording.netcdf import save
from ftc_jsb.report.page.write import write_report

MODELS = ("paper", "identified", "jsbsim")
LOOPS = ("ftc", "no-ftc")


class Written(NamedTuple):
    flights: dict[str, Flight]
    folder: Path
    document: dict[str, Any]
    page: str


def _draw_nothing(flights, folder) -> list[str]:
    return ["figure1_states"]


@pytest.fixture
def undrawn(monkeypatch) -> None:
    """Figures for print take seconds; tests of the page do without them."""
    monkeypatch.setattr("ftc_jsb.report.page.write.draw_all", _draw_nothing)


def _write(flights: dict[str, Flight], folder: Path, command: str) -> Written:
    recordings = {label: folder / f"{label}.nc" for label in flights}
    for label, flight in flights.items():
        save(flight, recordings[label])
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr("ftc_jsb.report.page.write.draw_all", _draw_nothing)
        write_report(flights, folder, command, recordings=recordings)
    document = json.loads((folder / "metrics.json").read_text())
    return Written(flights, folder, document, (folder / "report.html").read_text())


@pytest.fixture(scope="session")
def written(flown, tmp_path_factory) -> Written:
    """Every model and loop of the scenario `paper`."""
    flights = {
        f"{model}-{loop}": flown("paper", f"model={model}", f"loop.name={loop}")
        for model in MODELS
        for loop in LOOPS
    }
    return _write(flights, tmp_path_factory.mktemp("report"), "ftc-jsb compare paper")


@pytest.fixture(scope="session")
def noisy(flown, tmp_path_factory) -> Written:
    """Two models in turbulence, through tactical sensors."""
    flights = {
        f"{model}-{loop}": flown("turbulence", f"model={model}", f"loop.name={loop}")
        for model in ("identified", "paper")
        for loop in LOOPS
    }
    return _write(flights, tmp_path_factory.mktemp("noisy"), "ftc-jsb compare turbulence")


@pytest.fixture(scope="session")
def helix(flown, tmp_path_factory) -> Written:
    """The position loop beside the paper's."""
    flights = {
        f"paper-{loop}": flown("helix", "model=paper", f"loop.name={loop}")
        for loop in ("path", "ftc")
    }
    return _write(flights, tmp_path_factory.mktemp("helix"), "ftc-jsb compare helix")
