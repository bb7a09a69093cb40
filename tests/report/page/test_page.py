"""The report of real flights: self-contained, complete, and in agreement with metrics.json."""

import json
import math
import re
from html.parser import HTMLParser
from importlib import resources

import pytest

from ftc_jsb.aircraft.point_mass_file import load_point_mass
from ftc_jsb.analysis.metrics import flight_metrics
from ftc_jsb.errors import RecordingError
from ftc_jsb.margins.condition import level_scenario
from ftc_jsb.margins.document import document
from ftc_jsb.margins.measure import CHANNELS, channel_margins
from ftc_jsb.report.findings import analyse
from ftc_jsb.report.flight_groups import flown_scenario
from ftc_jsb.report.measured_margins import read_margins
from ftc_jsb.report.page.chart_series import flight_series
from ftc_jsb.report.page.charts import charts
from ftc_jsb.report.page.envelope import outlines
from ftc_jsb.report.page.panels import looks
from ftc_jsb.report.page.write import steps, write_report
from ftc_jsb.resources import aircraft_folder
from ftc_jsb.scenario.load import load_scenario

NUMBER = re.compile(r"\d+(?:\.\d+)?")
APART = ("script", "style", "pre", "code", "nav")  # not words on the page


class Reader(HTMLParser):
    """Numbers that are quoted from metrics.json, and the text around them."""

    def __init__(self) -> None:
        super().__init__()
        self.quotes: list[tuple[dict[str, str], str]] = []
        self.loose: list[str] = []
        self._open: list[tuple[str, dict[str, str]]] = []

    def handle_starttag(self, tag, attrs):
        if tag not in ("meta", "link", "input", "line", "br"):
            self._open.append((tag, dict(attrs)))

    def handle_endtag(self, tag):
        while self._open and self._open.pop()[0] != tag:
            pass

    def handle_data(self, data):
        tags = [tag for tag, _ in self._open]
        if tags and tags[-1] == "data":
            self.quotes.append((self._open[-1][1], data))
        elif not any(tag in APART for tag in tags):
            self.loose.append(data)


def read(page: str) -> Reader:
    reader = Reader()
    reader.feed(page)
    return reader


def at(document, pointer):
    for key in pointer.split("/")[1:]:
        key = key.replace("~1", "/").replace("~0", "~")
        document = document[int(key)] if isinstance(document, list) else document[key]
    return document


def disagreeing(page: str, document) -> list[str]:
    """Quotes that are not what metrics.json has at their place, to the last digit that is shown."""
    wrong = []
    for attributes, text in read(page).quotes:
        value = at(document, attributes["data-at"])
        exact = float(attributes["data-scale"]) * value
        decimals = len(text.partition(".")[2])
        half = 0.05 * abs(exact) if "e" in text else 0.5001 * 10.0**-decimals
        if json.loads(attributes["value"]) != value or abs(float(text) - exact) > half:
            wrong.append(f"{attributes['data-at']}: {text} for {value}")
    return wrong


def unquoted(page: str, allowed: str) -> list[str]:
    """Numbers in the page's text that are neither quoted nor fixed words."""
    known = set(NUMBER.findall(allowed))
    return [n for text in read(page).loose for n in NUMBER.findall(text) if n not in known]


def fixed_words(written) -> str:
    """Text that no flight computes: the template's, the charts', the scenario's own, names and versions."""
    template = (resources.files("ftc_jsb.report.page") / "templates" / "report.html").read_text()
    drawn = charts(flight_series(written.flights, analyse(written.flights)), eventful=True)
    return " ".join(
        [
            re.sub(r"{[{%].*?[%}]}", " ", template, flags=re.S),
            *(f"{chart.title} {chart.note}" for chart in drawn),
            "Zhou et al. 2014, section 5: thrust effectiveness 1 to 0.6 at 20 s",
            "from 20 s effectiveness 0.6, 60 s from 300 m/s at 3048 m, at 100 Hz, seed 0",
            "F-16, σ ±2σ",
            "0.3",  # the accepted coefficient, a setting
            "figure1_states",
        ]
    )


def without_foot(page: str) -> str:
    """The page without the lines that name versions and the machine."""
    return re.sub(r'<p class="soft made">.*?</p>', "", page, flags=re.S)


def test_every_number_on_the_page_is_the_one_of_metrics_json(written):
    assert len(read(written.page).quotes) > 300
    assert disagreeing(written.page, written.document) == []
    assert unquoted(without_foot(written.page), fixed_words(written)) == []


def test_a_wrong_number_and_a_number_from_elsewhere_are_noticed(written):
    """The test above can fail: one quote altered in its last digit, one cell typed in by hand."""
    altered = re.sub(
        r"(\d)</data>", lambda m: f"{(int(m[1]) + 2) % 10}</data>", written.page, count=1
    )
    assert disagreeing(altered, written.document) != []
    typed = written.page.replace("<tbody>", "<tbody><tr><td>17.23</td></tr>", 1)
    assert unquoted(without_foot(typed), fixed_words(written)) == ["17.23"]


def test_metrics_json_is_that_of_the_flights(written):
    for label, flight in written.flights.items():
        mine = json.loads(json.dumps(flight_metrics(flight)))
        stored = written.document["flights"][label]
        assert {key: stored[key] for key in mine} == mine


def test_page_is_one_file_under_12_mb(written):
    """Nothing is loaded from elsewhere: no address in a tag, no style sheet, no import."""
    assert (written.folder / "report.html").stat().st_size < 12e6
    tags = re.sub(r"<script.*?</script>", "", written.page, flags=re.S)
    assert not re.search(r'(src|href)="(https?:)?//', tags)
    assert not re.search(r"<script[^>]+src=", written.page)
    assert "@import" not in tags
    ids = re.findall(r'\bid="([^"]+)"', tags)
    assert len(ids) == len(set(ids))


def test_first_screen_links_to_files_that_are_there(written):
    """Metrics, the scenario and every recording; the scenario is the one that was flown."""
    head = written.page.split('id="results"')[0]
    links = re.findall(r'href="([^#"]+)"', head.split('class="linked"')[1])
    assert links[:2] == ["metrics.json", "scenario.toml"]
    assert len(links) == 2 + len(written.flights)
    for link in links:
        assert (written.folder / link).is_file()
    loaded = load_scenario(str(written.folder / "scenario.toml"))
    assert loaded == flown_scenario(written.flights)
    assert "heading_deg = [[0.0, 0.0], " in (written.folder / "scenario.toml").read_text()


def test_fault_timeline_says_when(written):
    """Sets in, declared: 20.00 s and the detection delay later, of every flight."""
    table = written.page.split("Fault timeline</h2>")[1].split("</table>")[0]
    assert re.findall(r'scope="col">([^<]+)', table)[1:5] == [
        "Sets in",
        "Suspected",
        "Declared",
        "Isolated",
    ]
    assert len(re.findall(r"thrust <data[^>]+>20.00</data>", table)) == len(written.flights)
    for label in written.flights:
        delay = written.document["flights"][label]["detection_delay_s"]
        assert f">{20.0 + delay:.2f}</data>" in table


@pytest.mark.usefixtures("undrawn")
def test_a_false_alarm_is_told_apart_in_the_timeline(noisy):
    """Declared before the fault: false, beside the first that is not."""
    timeline = noisy.document["flights"]["identified-no-ftc"]["timeline"]
    first = next(each for each in timeline if each["event"] == "declared")
    assert first["from_s"] < 20.0
    table = noisy.page.split("Fault timeline</h2>")[1].split("</table>")[0]
    assert re.search(rf"false:  ?<data[^>]+>{first['from_s']:.2f}</data>", table)


def test_models_of_noisy_flights_have_a_panel_each_and_loops_a_colour(written, noisy):
    quiet, swinging = looks(written.flights), looks(noisy.flights)
    assert quiet.panels == [""]
    assert swinging.panels == ["Point mass (identified F-16)", "Point mass (paper)"]
    colours = {f.scenario.loop.name: swinging.by_label[k].colour for k, f in noisy.flights.items()}
    assert len(set(colours.values())) == 2


def test_limits_of_the_envelope_are_the_aircrafts(written):
    """V-n: the load factors of point_mass.toml; Mach-altitude: the range that it was fitted in."""
    found = outlines(written.flights)
    assert [(each.chart, each.name) for each in found].count(("vn", "F-16")) == 1
    f16 = {each.chart: each for each in found if each.name == "F-16"}
    assert len(f16["vn"].owners) == 4
    aircraft = load_point_mass(aircraft_folder("f16"))
    assert max(f16["vn"].y) == pytest.approx(aircraft.load_factor.maximum)
    assert min(f16["vn"].y) == pytest.approx(aircraft.load_factor.minimum)
    corner = f16["mach_altitude"]
    assert list(corner.x[:2]) == list(aircraft.valid.mach)
    assert corner.y[2] == pytest.approx(aircraft.valid.altitude[1] / 1000.0)


def test_page_tells_how_to_fly_it_again(written):
    assert "ftc-jsb compare paper" in written.page
    assert "[reference]" in written.page
    assert "seed = 0" in written.page
    assert "jsbsim 1." in written.page
    assert "cores" in written.page


def test_first_screen_answers_both_questions(written):
    """With FTC every model keeps its limits, and is helped. The other answer is the document's."""
    head = written.page.split('id="results"')[0]
    first, told = head.split("Did the point mass tell the truth?")
    tolerated, helped = first.split("Did FTC help?")
    assert re.findall(r'class="badge (\w+)">([^<]+)', tolerated) == [("good", "Yes")] * 3
    assert re.findall(r'class="badge (\w+)">([^<]+)', helped) == [("good", "Helped")] * 3
    truth = {e["model"]: e["answer"] for e in written.document["point_mass_told_the_truth"]}
    shown = re.findall(r'class="badge \w+">([^<]+)</span> <span><strong>([^<]+)', told)
    assert {model: word.lower() for word, model in shown} == truth


@pytest.mark.usefixtures("undrawn")
def test_margins_are_rows_of_the_flights_that_they_are_of(written, tmp_path):
    """A measured margins.json of the paper's aircraft: the least of the three inputs, in its column only."""
    assert "Gain margin" not in written.page
    found = level_scenario("paper", "paper")
    inputs = [channel_margins(found, channel, lambda line: None) for channel in CHANNELS]
    path = tmp_path / "margins.json"
    path.write_text(json.dumps(document(found, inputs)))
    known = read_margins(path)
    labels = ("paper-ftc", "paper-no-ftc")
    flights = {label: written.flights[label] for label in labels}
    metrics = write_report(flights, tmp_path, "ftc-jsb report", margins=[known])["flights"]
    least = min(20.0 * math.log10(each.gain) for each in inputs)
    assert metrics["paper-ftc"]["gain_margin_db"] == pytest.approx(least)
    assert metrics["paper-ftc"]["delay_margin_s"] == min(each.delay for each in inputs)
    assert "gain_margin_db" not in metrics["paper-no-ftc"]
    assert "Gain margin, least input" in (tmp_path / "report.html").read_text()


def test_file_that_holds_no_margins_is_refused(tmp_path):
    path = tmp_path / "margins.json"
    for text in ("{}", "[]", "no json"):
        path.write_text(text)
        with pytest.raises(RecordingError, match=r"expected a margins\.json"):
            read_margins(path)
    with pytest.raises(RecordingError, match="No such file"):
        read_margins(tmp_path / "none.json")


@pytest.mark.usefixtures("undrawn")
def test_scenarios_that_differ_are_told_apart_and_in_what(flown, tmp_path):
    """Two scenarios of the same name and one of another: what differs is listed, with its values."""
    flights = {
        "one": flown("paper", "duration=25"),
        "two": flown("paper", "duration=25", "fault[0].start=12"),
        "three": flown("severe", "duration=25"),
    }
    write_report(flights, tmp_path, "ftc-jsb report")
    page = (tmp_path / "report.html").read_text()
    listed = page.split("The scenarios differ")[1].split("</table>")[0]
    keys = re.findall(r'<th scope="row"><code>([^<]+)', listed)
    assert "fault[0].start" in keys
    assert "fault[0].effectiveness" in keys
    assert "duration" not in keys
    assert "paper (2)" in listed
    assert re.search(r"fault\[0\]\.start.*?20\.0.*?12\.0.*?7\.0", listed, re.S)


@pytest.mark.usefixtures("undrawn")
def test_flight_that_ended_early_and_loop_without_estimate_are_reported(flown, tmp_path):
    """Half a second with no estimator, and a departure: told at the top, dashes in the table."""
    short = flown("paper", "loop.name=integral", "duration=0.5")
    departed = flown("total-loss", "model=jsbsim", "limits={}", "initial.altitude=150")
    lost = departed._replace(
        record=departed.record[:300],
        outcome=departed.outcome._replace(status="departed", time=3.0, reason="altitude"),
    )
    write_report({"short": short, "lost": lost}, tmp_path, "ftc-jsb report", ("bad.nc: no file",))
    page = (tmp_path / "report.html").read_text()
    top = page.split('id="results"')[0]
    assert "bad.nc: no file" in top
    assert "departed: altitude" in top
    assert re.search(r"departed at <data[^>]+>3.0</data> s", page)
    document = json.loads((tmp_path / "metrics.json").read_text())
    assert document["flights"]["short"]["effectiveness_thrust_error_rms"] is None
    assert disagreeing(page, document) == []


@pytest.mark.usefixtures("undrawn")
@pytest.mark.parametrize("rows", [1, 2, 5])
def test_flight_of_a_few_samples_is_drawn(flown, tmp_path, rows):
    """What a loop that fails at once leaves behind."""
    flight = flown("paper", "model=jsbsim")
    few = flight._replace(
        record=flight.record[:rows],
        outcome=flight.outcome._replace(status="failed", time=0.0, reason="loop"),
    )
    told, flights = [], {"few": few, "all": flown("paper")}
    write_report(flights, tmp_path, "ftc-jsb report", tell=told.append)
    assert len(told) == steps(flights)  # so that the bar reaches its end
    assert told[:2] == ["analysis of few", "analysis of all"]
    assert "failed" in (tmp_path / "report.html").read_text()


@pytest.mark.usefixtures("undrawn")
def test_missing_aircraft_is_said_and_stops_nothing(flown, tmp_path):
    flight = flown("paper", "model=identified")
    scenario = flight.scenario
    gone = scenario.aircraft.model_copy(update={"name": "./gone"})
    lost = flight._replace(scenario=scenario.model_copy(update={"aircraft": gone}))
    document = write_report({"lost": lost}, tmp_path, "ftc-jsb report")
    assert document["flights"]["lost"]["model_residuals"] is None
    assert "no aircraft" in (tmp_path / "report.html").read_text()
