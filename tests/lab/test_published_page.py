"""The paper's view in a browser: windows drawn with the mouse, choices, trust map."""

import html
from pathlib import Path

import pytest

import roughline as rl
from lab.drawn_plots import drag, held, on_screen
from report.test_typeset import SET
from roughline.paper.claims import judge_claims
from roughline.report.typeset import typeset
from roughline.units import decimal

HEADER = "published-stiffness-3D"


@pytest.fixture(scope="module")
def paper(pages):
    """Return one page of the view, with its numbers and plots."""
    page = pages.open("?view=published")
    ready(page)
    return page


def ready(page):
    page.wait_for_selector('[data-table="fit-3D"] tbody tr')
    page.wait_for_selector('[data-table="published-trust-1"] tbody tr', state="attached")
    page.wait_for_function(
        """() => globalThis.Bokeh?.documents.some((each) =>
            each.get_model_by_name("published-trust-1")?.inner_width > 0)"""
    )


def alpha(page, model="3D", row=0):
    """Return the exponent in a row of the table beside a figure."""
    cells = page.locator(f'[data-table="fit-{model}"] tbody tr').nth(row).locator("td")
    return cells.all_inner_texts()


def draw_window(page, plot, *corners):
    drag(page, *on_screen(page, plot, *corners))


def test_a_window_drawn_with_the_mouse_gives_its_exponent(paper, published_results):
    before = alpha(paper)
    draw_window(paper, HEADER, (0.15, 0.9), (1, 0.1))
    wait_for_other(paper, before)
    low, high = (float(paper.input_value(f"#published-{key}_3D-text")) for key in ("low", "high"))
    assert low == pytest.approx(0.15, rel=0.1)
    assert high == pytest.approx(1, rel=0.1)
    one = published_results.full.sel(fractal_dimension=2.0)
    law = rl.fit_power_law(one.force_bar.values, one.stiffness.values, (low, high))
    cell = paper.locator('[data-table="fit-3D"] tbody tr').first
    cell.filter(has_text=decimal(law.exponent, 3)).wait_for()
    paper.wait_for_function("(low) => location.href.includes(low)", arg=f"low_3D={low:g}")
    drawn = alpha(paper)
    paper.click("#published-windows")
    wait_for_other(paper, drawn)
    assert alpha(paper) == before


def wait_for_other(page, before, row=1):
    """Wait until a row of the table beside a figure says something else."""
    page.wait_for_function(
        """([before, row]) => document.querySelector(
            `[data-table="fit-3D"] tbody tr:nth-child(${row})`
        )?.innerText !== before""",
        arg=["\t".join(before), row],
    )


def test_choices_are_followed(paper):
    before = alpha(paper, row=1)
    paper.check('#published [data-key="mean"][value="geometric"]')
    wait_for_other(paper, before, row=2)
    paper.uncheck('#published [data-key="D_f"][value="3"]')
    paper.wait_for_selector('[data-table="fit-3D"]:not(:has(tbody tr:nth-child(6)))')
    paper.check('#published [data-key="D_f"][value="3"]')
    paper.check('#published [data-key="mean"][value="arithmetic"]')
    paper.wait_for_selector('[data-table="fit-3D"]:has(tbody tr:nth-child(6))')


def test_a_point_of_the_trust_map_says_what_it_means(paper):
    said = paper.locator("[data-words=point]")
    before = said.inner_text()
    paper.mouse.click(*on_screen(paper, "published-trust-4", (0.01, 2.6))[0])
    paper.wait_for_function(
        """(before) => document.querySelector("[data-words=point]").innerText !== before""",
        arg=before,
    )
    assert len(said.inner_text()) > 40
    assert paper.is_checked('#published [data-key="roll_off"][value="4"]')
    assert float(paper.input_value("#published-map_F-text")) == pytest.approx(0.01, rel=0.2)


def test_a_window_in_the_saturation_says_so_as_long_as_it_is_drawn(paper):
    doubt = paper.locator('[data-words="doubt-1D"]')
    assert not doubt.is_visible()
    draw_window(paper, "published-stiffness-1D", (1.2, 0.01), (9, 0.1))
    doubt.filter(has_text="reaches into the saturation").wait_for()
    paper.click("#published-windows")
    doubt.wait_for(state="hidden")


def test_walk_over_choices_which_curves_follow_without_the_server(paper):
    header = paper.locator('[data-table="published-stiffness-3D"] th')
    first = paper.locator('[data-table="published-stiffness-3D"] tbody tr').first.locator("td")
    paper.locator("#published-stiffness-3D summary").click()
    text = first.nth(1).inner_text()
    before = float(text)
    paper.check('#published [data-key="punch"][value="raw"]')
    paper.wait_for_function(
        "(text) => document.querySelector('[data-table=\"published-stiffness-3D\"] td + td')"
        ".innerText !== text",
        arg=text,
    )
    assert float(first.nth(1).inner_text()) == pytest.approx(1.1419 * before, rel=0.01)
    paper.check('#published [data-key="punch"][value="paper"]')
    paper.uncheck('#published [data-key="D_f"][value="2.2"]')
    paper.wait_for_function(
        "() => document.querySelectorAll('[data-table=\"published-stiffness-1D\"] th').length === 6"
    )
    assert header.count() == 6
    assert "2.2" not in "".join(header.all_inner_texts())
    paper.check('#published [data-key="D_f"][value="2.2"]')
    paper.locator("#published-stiffness-3D summary").click()


def test_the_controls_stay_in_sight(paper):
    paper.locator("#claims-title").scroll_into_view_if_needed()
    box = paper.locator("#published-controls").bounding_box()
    assert box["y"] >= 0
    assert box["y"] + box["height"] <= 1100
    paper.set_viewport_size({"width": 1600, "height": 400})
    paper.wait_for_function(  # the page is laid out anew once its window has shrunk
        """() => {
            const controls = document.querySelector("#published-controls");
            controls.scrollTop = controls.scrollHeight;
            const windows = document.querySelector("#published-windows");
            return windows.getBoundingClientRect().bottom <= 400;
        }"""
    )
    paper.set_viewport_size({"width": 1600, "height": 1100})


def test_the_claims_are_in_the_handbook(paper):
    folder = Path(__file__).parents[2] / "docs"
    links = paper.locator("#claims a")
    for address in links.evaluate_all("(each) => each.map(({href}) => href)"):
        assert (folder / Path(address).name).exists()
    assert links.count() == 7


LINK = (
    "v=1&D_f=2,2.2,2.4,2.6,2.8,3&mean=geometric&punch=exact&low_1D=0.001&high_1D=0.1&low_3D=0.02"
    "&high_3D=0.4&tolerance=0.2&map_D_f=2.4&map_F=0.05&roll_off=4&claims=undecided"
)


def test_a_link_of_an_earlier_version_shows_the_same(pages):
    page = pages.open(f"?view=published&{LINK}")
    ready(page)
    said = page.locator("[data-words=point]")
    said.filter(has_text="within 20%").wait_for()
    assert "F̄ = 0.0500" in said.inner_text()
    assert "geometric mean" in page.inner_text('[data-words="note-3D"]')
    assert page.inner_text("#published [data-error='']") == ""
    page.wait_for_function(
        "(link) => [...new URLSearchParams(link)].every(([key, text]) => "
        "new URLSearchParams(location.search).get(key) === text)",
        arg=LINK.replace("&claims=undecided", ""),
    )
    page.context.close()


def test_the_trust_map_names_its_axes(paper):
    named = held(paper, "published-trust-1", "xaxes.0.axis_label", "yaxes.0.axis_label")
    assert named == ["force F̄", "fractal dimension"]


def test_figures_that_are_embedded_at_the_same_time_are_not_taken_for_each_other(pages):
    page = pages.open("?view=measured")
    named = page.evaluate(
        """async () => {
            const {panelsOf} = await import("./lab/panels.js");
            for (const view of document.querySelectorAll("main")) view.hidden = false;
            const views = ["#explore", "#published"].map((id) => document.querySelector(id));
            const made = await Promise.all(views.map((view) => panelsOf(view)));
            return made.map(({plots}) => plots.made.roots().map(({name}) => name));
        }"""
    )
    page.context.close()
    explore, published = map(set, named)
    assert "published-exponents" in published
    assert not explore & published


def test_pages_set_symbols_as_reports_do(pages, published_results):
    page = pages.open("?view=measured")
    claims = judge_claims(published_results)
    texts = [text for text, _ in SET] + [t for each in claims for t in (each.statement, each.found)]
    assert len(texts) > 50
    written = page.evaluate(
        """async (texts) => {
            const {element, typeset} = await import("./lab/elements.js");
            return texts.map((text) => element("p", {}, ...typeset(text)).innerHTML);
        }""",
        texts,
    )
    page.context.close()
    for text, shown in zip(texts, written, strict=True):
        assert html.unescape(shown) == html.unescape(typeset(text)), text
