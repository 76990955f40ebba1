"""My surface in a browser: a file or an example, its answers, reports and refusals."""

import re
from dataclasses import replace
from urllib.parse import urljoin

import pytest

import roughline as rl
from lab.drawn_plots import source
from lab.looks import asked, cut_off, faint
from lab.measured_driven import (
    CONNECTED,
    EXAMPLE,
    LINE_SCAN,
    READY,
    SHOWN,
    answers,
    choose,
    fill,
    line_of,
    press,
)

BODIES = ("of few points", "an example")


@pytest.fixture(scope="module")
def few_points(tmp_path_factory):
    """A file of 16 x 16 points, which is soon prepared and pressed."""
    surface = rl.SelfAffine(hurst=0.7, length=2e-4, rms_height=2e-7).surface(16, 3)
    path = tmp_path_factory.mktemp("few points") / "few.nc"
    rl.write(replace(surface, unit="m"), path)
    return path


@pytest.fixture
def prepared(tab, few_points):
    """Open the view with what is set, and bring a file of few points or an example."""

    def opened(body, query, example):
        page = tab(f"?view=measured&v=1{query}{'' if body in BODIES[:1] else example}")
        if body in BODIES[:1]:
            page.wait_for_selector(CONNECTED)
            page.set_input_files("#measured [data-file]", few_points)
        page.wait_for_selector('#measured [data-result="file"]')
        return page

    return opened


@pytest.fixture(scope="module")
def measured(pages):
    """Return one page of the view."""
    page = pages.open("?view=measured")
    page.wait_for_selector(CONNECTED)
    return page


def test_a_click_before_plots_can_be_drawn_is_not_lost(tab):
    late = ("**/bokeh-api.min.js", lambda page: page.click(LINE_SCAN))
    page = tab("?view=measured", late)
    page.wait_for_selector(READY)


def test_nothing_can_be_clicked_before_it_is_listened_to(tab):
    seen = []
    inert = "() => document.querySelector('main:not([hidden])').inert"
    late = ("**/measured.js", lambda page: seen.append(page.evaluate(inert)))
    page = tab("?view=measured", late)
    page.click(LINE_SCAN)
    page.wait_for_selector(READY)
    assert seen == [True]


def test_a_step_that_is_opened_while_a_file_comes_stays_open(tab, few_points):
    """And all fold when the file is deleted."""
    step = "#measured-step-preparation > summary"
    page = tab("?view=measured", ("**/upload*", lambda page: page.click(step)))
    page.wait_for_selector(CONNECTED)
    page.set_input_files("#measured [data-file]", few_points)
    page.wait_for_selector('[data-table="measured-prepared"] tbody tr', state="attached")
    assert page.locator("#measured .step[open]").count() == 3  # file, preparation, bodies
    page.click("[data-forget-file]")
    page.wait_for_selector("#measured-step-preparation:not([open])")
    page.wait_for_selector("#measured-step-bodies:not([open])")


@pytest.mark.parametrize(("example", "plot"), [(LINE_SCAN, "stiffness"), (EXAMPLE, "contact")])
def test_an_example_is_answered_for(tab, example, plot):
    page = tab("?view=measured")
    page.click(example)
    page.wait_for_selector(READY)
    press(page, loads="2 MPa")
    assert re.search(r"N/m|Pa", answers(page))
    assert "Steel on copper" in page.inner_text('[data-words="answers-lead"]')
    assert page.is_visible(f"#plot-measured-{plot}")
    fill(page, first="E=70 GPa nu=0.33")
    notes = page.locator('[data-list="bodies-notes"] li', has_text="E=70 GPa nu=0.33")
    notes.first.wait_for()


STEPS = ("preparation", "bodies", "answers")


def is_open(page, step):
    return page.get_attribute(f"#measured-step-{step}", "open") is not None


def test_steps_that_wait_are_one_line_which_opens_by_key_and_by_touch(pages):
    page = pages.open("?view=measured", has_touch=True)
    page.wait_for_selector(CONNECTED)
    for step, line in zip(STEPS, ("tilt removed", "steel on copper", "choose a file"), strict=True):
        folded = page.locator(f"#measured-step-{step}")
        assert folded.bounding_box()["height"] < 70
        assert line in folded.locator("summary").first.inner_text()
    page.focus("#measured-step-preparation > summary")
    page.keyboard.press("Enter")
    assert page.is_visible("#measured-low_pass-text")
    fill(page, low_pass="2 um")
    line_of(page, "preparation").filter(has_text="low pass 2 um").wait_for()
    page.locator("#measured-step-bodies > summary").tap()
    assert page.is_visible("#measured-first-text")
    page.reload()
    page.wait_for_selector(CONNECTED)
    assert [is_open(page, step) for step in STEPS] == [True, True, False]
    assert page.input_value("#measured-low_pass-text") == "2 um"
    page.context.close()


def test_what_is_grave_stands_above_the_figures_and_the_press_shows_its_answer(tab):
    page = tab("?view=measured")
    page.set_viewport_size({"width": 1600, "height": 1000})
    page.click(LINE_SCAN)
    page.wait_for_selector(READY)
    assert [is_open(page, step) for step in STEPS] == [False, True, False]
    window = page.viewport_size["height"]
    assert page.locator("[data-press]").bounding_box()["y"] < window - 30
    page.click("[data-press]")
    grave = page.locator("#measured .grave[role=alert]")
    grave.filter(has_text="it yields, and a line has no yield").wait_for()
    figures = page.locator('[data-figures="answers"] dl')
    assert grave.bounding_box()["y"] < figures.bounding_box()["y"] < window
    groups = page.locator("#measured [data-remarks] details")
    assert groups.count() >= 2
    assert groups.locator("ul:visible").count() == 0
    page.click("#measured [data-remarks] summary:has-text('What was done to the data')")
    assert page.locator("#measured [data-remarks] li:visible").count() > 0
    assert faint(page) == []


@pytest.mark.parametrize("body", BODIES)
def test_walk_to_what_leaks_which_is_asked_in_a_fold_and_shown_on_the_map(prepared, body):
    page = prepared(body, "&loads=50+MPa", "&example=ground&resample=64")
    assert not page.is_visible("#measured-fluid-text")
    page.click("summary:has-text('a fluid in the gap')")
    press(page, fluid="helium", inlet="6 bar", seal="20 mm .. 24 mm")
    answers = page.locator('[data-table="measured-answers"]')
    answers.filter(has_text="leak rate").wait_for()  # with nearly two hundred small contacts
    assert not page.locator("#measured .error:visible").filter(has_text="a").count()
    assert asked(page, "nameless", "measured") == []
    assert asked(page, "undescribed", "measured") == []
    page.select_option("#measured [data-choice=measured-contact]", "flux")
    assert "in contact" in page.inner_text('[data-caption="measured-contact"]')
    assert len(source(page, "contact rings")[0]) == 1
    assert "flux" in page.inner_text("#measured-contact .scale")
    assert faint(page) == []
    press(page, fluid="", inlet="", seal="")
    page.wait_for_function(
        """() => document.querySelector('[data-choice="measured-contact"]').value === "area" """
    )
    assert "flux" not in page.inner_text("#measured [data-choice=measured-contact]")


def test_why_answers_are_not_known_better_unfolds_to_bars_at_any_width(prepared):
    page = prepared(BODIES[0], "&loads=2+MPa&grid_error=yes", "")
    page.click(READY)
    fold = page.locator("#measured details.why")
    fold.locator("summary", has_text="Why it is not known better").click()
    assert "Independent causes add in squares" in fold.inner_text()
    known = fold.locator("tbody", has=page.locator("rect.whole"))
    assert known.count()
    for rows in known.all():
        whole = rows.locator("rect.whole").bounding_box()
        for bar in (each.bounding_box() for each in rows.locator("rect:not(.whole)").all()):
            assert whole["x"] - 1 < bar["x"]  # or the intervals do not hold what is shown
            assert bar["x"] + bar["width"] < whole["x"] + whole["width"] + 1
    assert "finer pixels" in fold.inner_text()
    assert faint(page) == []
    assert cut_off(page, "measured", 390, 844) == []


DASHES = """(sources) => sources.map((source) => Bokeh.documents
    .flatMap((each) => [...each._all_models.values()])
    .find(({type, data_source}) => type === "GlyphRenderer" && data_source.name === source)
    .glyph.line_dash)"""


@pytest.mark.parametrize("body", BODIES)
def test_theories_have_their_names_and_their_dashes_beside_the_curve(prepared, body):
    asked_for = "&loads=2+MPa&boundary=periodic&theories=persson,bush-gibson-thomas"
    page = prepared(body, asked_for, "&example=film&resample=64")
    page.click(READY)
    assert "N/m" in answers(page)
    named = page.locator("#measured-area .names li:visible", has_text=re.compile("Persson|Bush"))
    assert named.all_inner_texts() == ["Persson", "Bush, Gibson, Thomas"]
    dashes = page.evaluate(DASHES, [each.get_attribute("data-sources") for each in named.all()])
    assert len({*map(str, dashes), "[]"}) == 3
    assert page.inner_text("#measured > .error") == ""


def results_open_under_the_policy(page):
    for link in page.locator("[data-links] a").all():
        address = page.evaluate("(link) => link.href", link.element_handle())
        if ".html" not in address:
            reply = page.request.get(address)
            assert reply.status == 200
            assert len(reply.body()) > 1000
            continue
        report = page.context.new_page()
        report.goto(address)
        assert report.locator("h1").count() > 0
        assert report.evaluate("() => [...document.images].every((each) => each.naturalWidth > 0)")
        report.close()


@pytest.mark.parametrize("example", ["shaft", "ground&resample=32"])
def test_a_report_presses_first_if_nothing_is_shown_yet(tab, example):
    page = tab(f"?view=measured&v=1&example={example}&loads=2+MPa")
    page.wait_for_selector("#measured [data-result=file]")
    page.click("#measured-step-answers > summary")
    page.click("[data-report]:enabled")
    page.locator("[data-links] a").first.wait_for()
    assert answers(page)
    results_open_under_the_policy(page)


def test_walk_from_answers_to_code_and_a_report_which_are_of_what_is_shown(tab, tmp_path):
    page = tab("?view=measured&v=1&example=shaft&first=steel&second=copper&loads=2+MPa")
    press(page)
    page.wait_for_selector(SHOWN)
    shown = page.locator('[data-figures="answers"] dd').first.inner_text()
    fill(page, loads="20 MPa")
    page.wait_for_selector("[data-changed]:visible")
    page.click('#measured [data-code="command"]')
    code = page.locator("#measured-code pre")
    code.filter(has_text="--load").wait_for()
    assert "20 MPa" not in code.inner_text()
    page.keyboard.press("Escape")
    page.click("[data-report]")
    link = page.locator("[data-links] a[href*='.html']")
    link.wait_for()
    report = page.request.get(urljoin(page.url, link.get_attribute("href"))).text()
    figure = float(shown.split()[0])  # in three digits; the report may have more
    assert any(float(f"{float(each):.3g}") == figure for each in re.findall(r"\d+\.\d+", report))
    assert "20 MPa" not in report
    fill(page, loads="30 MPa")
    assert link.count() == 1  # which is of what is shown still
    page.click("[data-press]")
    page.wait_for_selector("[data-changed]", state="hidden")
    assert page.locator("[data-links] a").count() == 0
    with page.expect_download() as coming:
        page.click("[data-example-file]")
    coming.value.save_as(tmp_path / coming.value.suggested_filename)
    assert rl.read(tmp_path / coming.value.suggested_filename).heights.size


def test_a_press_can_be_cancelled(tab):
    page = tab("?view=measured")
    page.click(EXAMPLE)
    page.wait_for_selector(READY)
    press(page, loads="")
    page.click("#measured [data-waiting] .cancel")
    page.wait_for_selector("#measured [data-waiting] .cancel", state="hidden")
    page.wait_for_selector(READY)
    assert not page.is_visible('[data-table="measured-answers"]')


def test_walk_over_maps_of_a_part_brought_checked_pressed_and_left_out(tab, tmp_path):
    whole = rl.SelfAffine(hurst=0.7, length=4e-4, rms_height=1e-6).surface(64, 3)
    paths = []
    for i in range(3):
        piece = whole.cropped((20 * i, 20 * i + 16), (0, 16)).detrended()
        paths.append(tmp_path / f"place {i}.nc")
        rl.write(rl.Surface(piece.heights, piece.sizes, "m"), paths[-1])
    (tmp_path / "broken.x3p").write_bytes(b"PK\x03\x04" + bytes(300))
    page = tab("?view=measured")
    page.wait_for_selector(CONNECTED)
    maps = page.locator('[data-table="measured-maps"] tbody tr')
    choose(page, tmp_path / "broken.x3p", *paths[:2])
    maps.nth(2).wait_for()
    line_of(page, "file").filter(has_text="place 0.nc").wait_for()
    assert "damaged" in maps.nth(0).inner_text()
    choose(page, paths[2], button="[data-add-maps]")
    maps.nth(3).wait_for()
    page.click('[aria-label="show place 1.nc"]')
    line_of(page, "file").filter(has_text="place 1.nc").wait_for()
    page.click(READY)
    page.locator('[data-table="measured-part-answers"] tbody tr').first.wait_for()
    assert "broken.x3p" in page.text_content("#measured-step-answers")
    assert page.locator('[data-table="measured-part-leading"] tbody tr').count() == 3
    assert page.is_visible("#plot-measured-part")
    assert "at the hardness" in page.inner_text('[data-caption="measured-contact"]')
    assert asked(page, "nameless", "measured") == []
    page.select_option("[data-part-map]", "2")
    page.wait_for_selector('[data-result="answers"]:not(.dimmed)')
    assert page.input_value("[data-part-map]") == "2"
    page.click('[aria-label="leave out broken.x3p"]')
    maps.nth(3).wait_for(state="detached")
    assert maps.count() == 3
    assert "3 maps" in page.inner_text("[data-words=part-count]")
    page.click(LINE_SCAN)
    line_of(page, "file").filter(has_text="shaft").wait_for()
    assert not page.is_visible('[data-result="part"]')


@pytest.mark.parametrize(
    ("name", "content", "words"),
    [
        ("empty.di", b"", "empty.di"),
        ("picture.sur", b"\x89PNG\r\n\x1a\n" + bytes(500), "picture.sur"),
        ("<b onclick=alert(1)>.txt", b"no numbers here\n", "_b onclick"),
    ],
)
def test_what_is_no_topography_is_refused(measured, name, content, words):
    file = {"name": name, "mimeType": "application/octet-stream", "buffer": content}
    measured.set_input_files("#measured [data-file]", file)
    sentence = measured.locator('#measured [data-error="file"]').filter(has_text=words)
    assert not re.search(r"\n|/tmp|Traceback", sentence.inner_text())
    assert measured.locator("#measured [data-error] b").count() == 0
    measured.click(LINE_SCAN)
    measured.wait_for_selector('#measured-step-file:not(.dimmed) [data-result="file"]')
    measured.wait_for_selector('#measured [data-error="file"]:empty', state="attached")
