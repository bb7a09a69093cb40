"""The page in a real browser, driven as a reader would: by mouse, by keyboard, on paper, on a phone."""

import re
import shutil

import pytest

CHROMIUM = next(
    filter(None, map(shutil.which, ("chromium", "chromium-browser", "google-chrome"))), None
)
pytestmark = pytest.mark.skipif(
    CHROMIUM is None, reason="no Chromium on this machine; .ci/run installs it where it can"
)
ARGUMENTS = [
    "--no-sandbox", "--disable-quic", "--disable-background-networking", "--disable-component-update",
    "--disable-sync", "--no-first-run", "--enable-unsafe-swiftshader",
]  # fmt: skip
TIMES = ("states", "errors", "controls", "effectiveness_thrust", "differences", "response")


@pytest.fixture(scope="module")
def browser():
    from playwright.sync_api import sync_playwright

    with sync_playwright() as driver:
        browser = driver.chromium.launch(executable_path=CHROMIUM, args=ARGUMENTS)
        yield browser
        browser.close()


class Opened:
    """A page of the report, with what it complained of and asked for."""

    def __init__(self, browser, written, **context):
        settings = {"viewport": {"width": 1280, "height": 900}, "offline": True} | context
        self.context = browser.new_context(**settings)
        self.page = self.context.new_page()
        self.complaints: list[str] = []
        self.requests: list[str] = []
        self.page.on("pageerror", lambda error: self.complaints.append(str(error)))
        self.page.on(
            "console",
            lambda said: self.complaints.append(said.text) if said.type == "error" else None,
        )
        self.page.on("request", lambda request: self.requests.append(request.url))
        self.url = (written.folder / "report.html").as_uri()
        self.page.goto(self.url)

    def show(self, *names):
        """Scroll charts into view, so that they are drawn."""
        for name in names or self.charts():
            self.page.locator(f"#chart-{name}").scroll_into_view_if_needed()
            self.page.wait_for_selector(f"#chart-{name} .plot[data-drawn]", timeout=20_000)

    def charts(self):
        return self.page.eval_on_selector_all(".chart", "all => all.map(c => c.dataset.chart)")

    def plot(self, name, expression):
        """JavaScript on a chart's Plotly element, `gd`."""
        return self.page.evaluate(
            f"name => {{ const gd = document.querySelector(`#chart-${{name}} .plot`); return {expression}; }}",
            name,
        )

    def cursor(self, name):
        """Time [s] at which a chart draws the cursor, from where it is on the screen; None if hidden."""
        return self.plot(
            name,
            "(() => { const m = gd.querySelector('.mark'), x = gd._fullLayout.xaxis;"
            " return m.style.display === 'none' ? null : x.p2d(parseFloat(m.style.left) - x._offset); })()",
        )


@pytest.fixture
def opened(browser, written):
    page = Opened(browser, written)
    yield page
    page.context.close()


def test_every_chart_draws_its_data_without_errors_or_requests(opened):
    """Each chart has a line of many points for every flight that it is about, on axes that hold them."""
    opened.show()
    assert set(opened.charts()) >= {
        *TIMES,
        "trajectory",
        "residuals",
        "innovations",
        "detector",
        "stability",
    }
    for name in opened.charts():
        sizes = opened.plot(
            name,
            "gd.data.map(t => [t.owners.length, Array.from(t.y).filter(Number.isFinite).length])",
        )
        lines = [count for _, count in sizes if count > 100]
        if name == "timeline":
            continue
        assert len(lines) >= 4, name
        if name != "trajectory":
            paths = opened.plot(
                name,
                "[...gd.querySelectorAll('.js-line')].filter(p => p.getAttribute('d').length > 50).length",
            )
            assert paths >= 4, name
    assert opened.complaints == []
    assert [url for url in opened.requests if not url.startswith("data:")] == [opened.url]


def test_charts_show_the_recorded_numbers(opened, written):
    """Airspeed of the JSBSim flight in the chart is the recording's, to float32."""
    opened.show("states")
    label = list(written.flights).index("jsbsim-ftc")
    x, y = opened.plot(
        "states",
        f"(() => {{ const t = gd.data.find(t => t.owners.length === 1 && t.owners[0] === {label});"
        " return [Array.from(t.x), Array.from(t.y)]; })()",
    )
    record = written.flights["jsbsim-ftc"].record
    for k in range(0, len(x), 97):
        row = round(x[k] * 100)
        assert y[k] == pytest.approx(record["airspeed"][row], rel=1e-6)


def test_time_cursor_of_one_chart_is_that_of_all(opened):
    """The mouse rests in one chart; the line is at that time in the others, and the slider says it."""
    opened.show(*TIMES)
    opened.show("states")
    box = opened.page.locator("#chart-states .plot .nsewdrag").first.bounding_box()
    opened.page.mouse.move(box["x"] + 0.5 * box["width"], box["y"] + 0.5 * box["height"])
    opened.page.wait_for_function("document.getElementById('now').textContent !== ''")
    opened.page.wait_for_timeout(100)
    now = float(opened.page.inner_text("#now").split()[0])
    assert 25.0 < now < 35.0
    for name in TIMES:
        assert opened.cursor(name) == pytest.approx(now, abs=0.05)
    assert float(opened.page.input_value("#cursor")) == pytest.approx(now, abs=0.01)


def test_time_cursor_moves_by_keyboard_and_tells_the_values(opened, written):
    opened.show("states")
    opened.page.focus("#cursor")
    opened.page.keyboard.press("End")
    for _ in range(3):
        opened.page.keyboard.press("ArrowLeft")
    assert opened.page.inner_text("#now") == "59.97 s"
    assert opened.cursor("states") == pytest.approx(59.97, abs=0.05)
    opened.page.focus("#values summary")
    opened.page.keyboard.press("Enter")
    opened.page.wait_for_selector("#values tbody tr")
    rows = opened.page.locator("#values tbody tr")
    assert rows.count() == len(written.flights)
    shown = float(rows.nth(0).locator("td").nth(1).inner_text())
    assert shown == pytest.approx(written.flights["paper-ftc"].record["airspeed"][5997], abs=0.006)


def test_flight_is_switched_off_in_every_chart_and_on_again(opened, written):
    """By keyboard. Its lines go, the others and the reference stay."""
    opened.show("states", "errors", "trajectory")
    number = list(written.flights).index("jsbsim-no-ftc")

    def lines(name):
        return opened.plot(
            name,
            f"gd.data.filter(t => t.visible && t.owners.length === 1 && t.owners[0] === {number}).length",
        )

    def others(name):
        return opened.plot(
            name, f"gd.data.filter(t => t.visible && t.owners[0] !== {number}).length"
        )

    before = [(lines(name), others(name)) for name in ("states", "errors", "trajectory")]
    assert all(mine > 0 for mine, _ in before)
    opened.page.focus(f'#chips input[data-flight="{number}"]')
    opened.page.keyboard.press("Space")
    opened.show("states", "errors", "trajectory")
    opened.page.wait_for_timeout(200)
    after = [(lines(name), others(name)) for name in ("states", "errors", "trajectory")]
    assert after == [(0, other) for _, other in before]
    opened.page.keyboard.press("Space")
    opened.show("states", "errors", "trajectory")
    opened.page.wait_for_timeout(200)
    assert [(lines(n), others(n)) for n in ("states", "errors", "trajectory")] == before


def test_zoom_of_one_chart_is_that_of_all(opened):
    """Dragged by mouse, typed in, and taken back."""
    opened.show("states", "errors")
    opened.show("states")
    box = opened.page.locator("#chart-states .plot .nsewdrag").first.bounding_box()
    middle = box["y"] + 0.5 * box["height"]
    opened.page.mouse.move(box["x"] + 0.30 * box["width"], middle)
    opened.page.mouse.down()
    opened.page.mouse.move(box["x"] + 0.60 * box["width"], middle, steps=5)
    opened.page.mouse.up()
    opened.page.wait_for_timeout(500)
    opened.show("errors")
    low, high = opened.plot("errors", "gd._fullLayout.xaxis.range")
    assert (low, high) == pytest.approx((18.0, 36.0), abs=1.0)
    assert float(opened.page.input_value("#from")) == pytest.approx(low, abs=0.01)
    opened.page.fill("#from", "5")
    opened.page.fill("#to", "15")
    opened.page.keyboard.press("Enter")
    opened.show("states")
    assert opened.plot("states", "gd._fullLayout.xaxis.range") == [5, 15]
    opened.page.click("#all")
    assert opened.plot("states", "gd._fullLayout.xaxis.range") == [0, 60]


def test_trajectory_turns_by_mouse_and_by_keyboard(opened):
    opened.show("trajectory")
    eye = "(c => [c.eye.x, c.eye.y])(gd._fullLayout.scene._scene.getCamera())"
    first = opened.plot("trajectory", eye)
    opened.page.focus("#turn")
    for _ in range(20):
        opened.page.keyboard.press("ArrowRight")
    second = opened.plot("trajectory", eye)
    assert second != pytest.approx(first, abs=0.05)
    box = opened.page.locator("#chart-trajectory .plot").bounding_box()
    opened.page.mouse.move(box["x"] + 0.5 * box["width"], box["y"] + 0.5 * box["height"])
    opened.page.mouse.down()
    opened.page.mouse.move(box["x"] + 0.7 * box["width"], box["y"] + 0.5 * box["height"], steps=8)
    opened.page.mouse.up()
    opened.page.wait_for_timeout(300)
    assert opened.plot("trajectory", eye) != pytest.approx(second, abs=0.05)


def test_page_prints_with_every_chart_in_light_colours(browser, written):
    """From a dark screen; charts that were never scrolled to are on paper, too."""
    opened = Opened(browser, written, color_scheme="dark")
    pdf = opened.page.pdf(format="A4")
    pages = len(re.findall(rb"/Type ?/Page\b", pdf))
    assert pdf.startswith(b"%PDF")
    assert pages >= 4
    for name in opened.charts():
        assert opened.plot(name, "gd.dataset.drawn") == "yes", name
    assert opened.complaints == []
    opened.context.close()


@pytest.mark.parametrize("scheme", ["light", "dark"])
def test_page_fits_a_phone_in_light_and_dark(browser, written, scheme):
    """420 px: nothing sticks out, and the first answer is on the first screen."""
    opened = Opened(browser, written, color_scheme=scheme, viewport={"width": 420, "height": 850})
    opened.show("states", "differences", "stability")
    assert opened.page.evaluate("document.documentElement.scrollWidth") <= 420
    background = opened.page.evaluate("getComputedStyle(document.body).backgroundColor")
    assert (background == "rgb(255, 255, 255)") == (scheme == "light")
    ink = opened.plot("states", "gd.querySelector('.ytick text').style.fill")
    assert (sum(map(int, re.findall(r"\d+", ink)[:3])) > 380) == (scheme == "dark")
    opened.page.evaluate("scrollTo(0, 0)")
    first = opened.page.locator(".badge").first.bounding_box()
    assert first["y"] + first["height"] < 850
    assert opened.complaints == []
    opened.context.close()


def test_everything_that_can_be_worked_can_be_reached_by_tab(opened):
    """Sections, theme, tables that scroll, flights, time, window, values, turn, files, scenario."""
    reached = set()
    for _ in range(80):
        opened.page.keyboard.press("Tab")
        reached.add(
            opened.page.evaluate(
                "(e => e.id || e.dataset.flight || e.tagName + '.' + e.className)(document.activeElement)"
            )
        )
    assert {"theme", "cursor", "from", "to", "all", "turn", "true-scale", "0", "5"} <= reached
    assert "DIV.scroll" in reached
    assert "SUMMARY." in reached


def test_no_chart_offers_an_upload(opened):
    opened.show("states")
    titles = opened.page.eval_on_selector_all(
        ".modebar-btn", "all => all.map(b => b.dataset.title + ' ' + (b.dataset.attr ?? ''))"
    )
    assert any("CSV" in title for title in titles)
    assert not [title for title in titles if "hare" in title or "loud" in title or "Edit" in title]
    assert opened.plot("states", "gd._context.plotlyServerURL") == ""


def test_a_chart_is_saved_as_svg(opened):
    opened.show("states")
    opened.page.locator("#chart-states").hover()
    with opened.page.expect_download() as waiting:
        opened.page.locator("#chart-states .modebar-btn[data-title*=SVG]").click()
    text = waiting.value.path().read_text(encoding="utf-8")
    assert waiting.value.suggested_filename == "states.svg"
    assert text.startswith("<svg")
    assert "Airspeed [m/s]" in text


def test_a_chart_is_saved_as_csv_with_every_drawn_sample(opened, written):
    opened.show("states")
    opened.page.locator("#chart-states").hover()
    with opened.page.expect_download() as waiting:
        opened.page.locator("#chart-states .modebar-btn[data-title*=CSV]").click()
    lines = waiting.value.path().read_text(encoding="utf-8").splitlines()
    assert waiting.value.suggested_filename == "states.csv"
    assert lines[0].split(",")[:3] == ["flight", "time_s", "airspeed"]
    drawn = opened.plot("states", "gd.data.filter(t => t.yaxis === 'y' && !/ref/.test(t.name))"
                                  ".reduce((sum, t) => sum + t.x.length, 0)")  # fmt: skip
    assert len(lines) - 1 == drawn


def middle_of(opened, name):
    box = opened.page.locator(f"#chart-{name} .plot .nsewdrag").first.bounding_box()
    return box["x"] + 0.5 * box["width"], box["y"] + 0.5 * box["height"]


def test_a_number_under_the_mouse_has_its_unit_and_leaves_the_curves_visible(opened, written):
    """A row for each flight, a column for each variable, outside the plot: below or above it."""
    opened.show("states", "controls")
    opened.show("states")
    opened.page.mouse.move(*middle_of(opened, "states"))
    readout = opened.page.locator("#chart-states .readout")
    readout.wait_for(state="visible")
    rows = readout.locator("tr")
    assert rows.count() == len(written.flights) + 1
    cells = rows.nth(1).locator("td").all_inner_texts()
    assert [text.split()[1] for text in cells] == ["m/s", "deg", "deg"]
    box, plot = readout.bounding_box(), opened.page.locator("#chart-states .plot").bounding_box()
    assert box["y"] >= plot["y"] + plot["height"] - 1 or box["y"] + box["height"] <= plot["y"] + 1
    assert opened.page.locator(".hoverlayer .hovertext").count() == 0
    opened.page.mouse.move(2, 2)
    readout.wait_for(state="hidden")


def test_scales_follow_a_zoom(opened, written):
    """Airspeed at 20 to 24 s: its axis holds what is flown there and little else; all again at once."""
    opened.show("states")
    whole = opened.plot("states", "gd._fullLayout.yaxis.range")
    opened.page.fill("#from", "2")
    opened.page.fill("#to", "15")
    opened.page.keyboard.press("Enter")
    low, high = opened.plot("states", "gd._fullLayout.yaxis.range")
    least, most = (
        pick(pick(flight.record["airspeed"][210:1490]) for flight in written.flights.values())
        for pick in (min, max)
    )
    assert low <= least
    assert high >= most
    assert high - low < 1.5 * (most - least) + 0.1
    assert high - low < 0.5 * (whole[1] - whole[0])
    opened.page.click("#all")
    assert opened.plot("states", "gd._fullLayout.yaxis.range") == whole


def test_timeline_has_a_bar_from_the_declaration_on(opened, written):
    opened.show("timeline")
    assert opened.plot("timeline", "gd._fullLayout.yaxis.ticktext") == ["fault", "declared"]
    delay = written.document["flights"]["paper-ftc"]["detection_delay_s"]
    bars = opened.plot(
        "timeline",
        "gd.data.filter(t => t.mode === 'lines').map(t => [t.owners[0], t.x[0], t.x[1]])",
    )
    number = list(written.flights).index("paper-ftc")
    assert [number, pytest.approx(20.0 + delay), pytest.approx(60.0)] in bars
    assert len(bars) == 2 * len(written.flights)


def test_ground_track_is_a_plan_with_north_up(opened, written):
    """A kilometre is as long to the east as to the north, and the arrow says where north is."""
    opened.show("track")
    east, north = opened.plot(
        "track",
        "[gd._fullLayout.xaxis, gd._fullLayout.yaxis].map(a => a._length / (a.range[1] - a.range[0]))",
    )
    assert east == pytest.approx(north, rel=0.01)
    assert "N" in opened.page.locator("#chart-track .annotation-text").all_text_contents()
    labels = opened.page.locator("#chart-track .plot text").all_text_contents()
    assert {"East [km]", "North [km]"} <= set(labels)


def test_envelope_panels_have_the_limits_of_each_aircraft(opened):
    """Dashed: the F-16's and the paper's; every flight is a line inside the axes."""
    opened.show("vn", "mach_altitude")
    for name in ("vn", "mach_altitude"):
        outlines = opened.plot(
            name,
            "gd.data.filter(t => t.line && t.line.dash === 'dash' && t.owners.length > 1).map(t => t.name)",
        )
        assert sorted(outlines) == ["F-16", "paper's aircraft"]


def test_position_errors_come_first_where_the_position_is_tracked(browser, helix):
    opened = Opened(browser, helix)
    flight_charts = opened.page.eval_on_selector_all(
        "#flights .chart", "all => all.map(c => c.dataset.chart)"
    )
    assert flight_charts[0] == "positions"
    opened.show("positions")
    record = helix.flights["paper-path"].record
    height = opened.plot(
        "positions", "Array.from(gd.data.find(t => t.yaxis === 'y3' && t.owners[0] === 0).y)"
    )
    flown_height = record["altitude"] - record["altitude_ref"]
    assert max(height) == pytest.approx(flown_height.max(), rel=1e-4, abs=1e-3)
    assert opened.complaints == []
    opened.context.close()


def test_noisy_models_have_panels_and_their_lines_are_no_solid_blocks(browser, noisy):
    """A column a model; a line that swings faster than a pixel is its mean in a pale band."""
    opened = Opened(browser, noisy)
    opened.show("errors")
    axes = opened.plot("errors", "gd._fullLayout._subplots.xaxis.length")
    assert axes == 2
    titles = opened.page.locator("#chart-errors .annotation-text").all_text_contents()
    assert titles == ["Point mass (identified F-16)", "Point mass (paper)"]
    points = opened.plot("errors", "Math.max(...gd.data.map(t => t.x.length))")
    width = opened.plot("errors", "gd._fullLayout.xaxis._length")
    swinging = opened.plot("errors", "gd.data.filter(t => t.fill === 'tonexty').length")
    assert swinging >= 4
    assert points < 3200
    colours = opened.plot(
        "errors", "[...new Set(gd.data.filter(t => t.of === 'line').map(t => t.line.color))].length"
    )
    assert colours == 2
    opened.page.fill("#from", "30")
    opened.page.fill("#to", "30.5")
    opened.page.keyboard.press("Enter")
    assert width > 300
    assert opened.plot("errors", "gd.data.filter(t => t.fill === 'tonexty').length") == 0
    opened.context.close()


def test_noisy_flights_print_in_less_than_5_mb(browser, noisy):
    opened = Opened(browser, noisy)
    assert len(opened.page.pdf(format="A4")) < 5e6
    assert opened.complaints == []
    opened.context.close()


def test_curves_of_many_points_are_printed_as_pictures(browser, noisy):
    """Above a number of characters, lowered here: all charts but the one in space; each has ink."""
    opened = Opened(browser, noisy)
    opened.show("states")
    opened.page.evaluate("dispatchEvent(new Event('beforeprint'))")
    assert opened.page.locator("canvas.raster").count() == 0
    opened.page.evaluate("dispatchEvent(new Event('afterprint'))")
    opened.page.evaluate(
        "document.documentElement.dataset.vectors = '1000'; dispatchEvent(new Event('beforeprint'))"
    )
    pictures = opened.page.locator("canvas.raster").count()
    assert pictures == len(opened.charts()) - 1
    inked = opened.page.evaluate(
        """[...document.querySelectorAll('canvas.raster')].filter(c =>
          c.getContext('2d').getImageData(0, 0, c.width, c.height).data.some(v => v > 0)).length"""
    )
    assert inked == pictures
    opened.page.evaluate("dispatchEvent(new Event('afterprint'))")
    assert opened.page.locator("canvas.raster").count() == 0
    opened.context.close()


@pytest.mark.parametrize("button", ["#play", "#chart-trajectory button.play"])
def test_play_moves_the_time_cursor_and_pauses(opened, button):
    """From the start; paused in the frame in which the cursor has passed 1 s, it stays where it is."""
    paused = opened.page.evaluate(
        """selector => new Promise((done) => {
          const cursor = document.getElementById("cursor"), button = document.querySelector(selector);
          cursor.value = 0;
          cursor.dispatchEvent(new Event("input"));
          button.click();
          const watch = () => {
            if (Number(cursor.value) <= 1) { requestAnimationFrame(watch); return; }
            if (button.textContent.includes("Pause")) button.click();
            done(cursor.value);
          };
          requestAnimationFrame(watch);
        })""",
        button,
    )
    assert "Play" in opened.page.locator(button).inner_text()
    opened.page.wait_for_timeout(200)
    assert opened.page.locator("#cursor").input_value() == paused


@pytest.mark.parametrize("media", ["print", "screen"])
def test_the_legend_is_whole_on_paper_and_on_a_phone(browser, written, media):
    """Every flight's entry lies on the page; on paper no tool bar does."""
    opened = Opened(browser, written, viewport={"width": 420, "height": 850})
    opened.show("states")
    opened.page.emulate_media(media=media)
    for chip in opened.page.locator(".chip").all():
        box = chip.bounding_box()
        assert box["x"] >= 0
        assert box["x"] + box["width"] <= 420
    bar = opened.page.locator("#chart-states .modebar").first
    assert (bar.evaluate("e => getComputedStyle(e).display") == "none") == (media == "print")
    opened.context.close()
