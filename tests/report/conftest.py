"""One report of the six flights of `compare paper`, which several tests look at."""

import json
from pathlib import Path
from typing import Any, NamedTuple

import pytest

from ftc_jsb.recording.flight import Flight
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


@pytest.fixture(scope="session")
def written(flown, tmp_path_factory) -> Written:
    folder = tmp_path_factory.mktemp("report")
    flights = {
        f"{model}-{loop}": flown("paper", f"model={model}", f"loop.name={loop}")
        for model in MODELS
        for loop in LOOPS
    }
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr("ftc_jsb.report.page.write.draw_all", _draw_nothing)
        write_report(flights, folder, "ftc-jsb compare paper")
    document = json.loads((folder / "metrics.json").read_text())
    return Written(flights, folder, document, (folder / "report.html").read_text())
