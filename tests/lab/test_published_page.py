"""The paper's view in a browser: windows drawn with the mouse, choices, trust map, claims."""

import pytest

import roughline as rl
from lab.looks import asked, cut_off, faint, tabbed
from roughline.paper.studies import study_summaries
from roughline.units import decimal

HEADER = "published-stiffness-3D"


@pytest.fixture(scope="module")
def paper(pages):
    """Return one page of the view, with its numbers, plots and claims."""
    page = pages.open("?view=published")
    ready(page)
    page.wait_for_selector('[data-table="claims"] tbody tr', timeout=60_000)
    return page


def ready(page):
    page.wait_for_selector('[data-table="fit-3D"] tbody tr')
    page.wait_for_selector('[data-table="published-trust"] tbody tr', state="attached")
    page.wait_for_function(
        """() => globalThis.Bokeh?.documents.some((each) =>
            each.get_model_by_name("published-trust-1")?.inner_width > 0)"""
    )


def alpha(page, model="3D", row=0):
    """Return the exponent in a row of the table beside a figure."""
    cells = page.locator(f'[data-table="fit-{model}"] tbody tr').nth(row).locator("td")
    return cells.all_inner_texts()


def at(page, plot, *points):
    """Return where points of a plot are on the screen."""
    place = page.locator(f"#plot-{plot}")
    place.scroll_into_view_if_needed()
    box = place.bounding_box()
    found = page.evaluate(
        """([plot, points]) => {
            const made = Bokeh.documents.find((each) => each.get_model_by_name(plot));
            const {frame} = Bokeh.index.find_one(made.get_model_by_name(plot));
            return points.map(([x, y]) => [frame.x_scale.compute(x), frame.y_scale.compute(y)]);
        }""",
        [plot, points],
    )
    return [(box["x"] + x, box["y"] + y) for x, y in found]


def test_a_window_drawn_with_the_mouse_gives_its_exponent(paper, published_results):
    before = alpha(paper)
    start, end = at(paper, HEADER, (0.15, 0.9), (1, 0.1))
    paper.mouse.move(*start)
    paper.mouse.down()
    paper.mouse.move((start[0] + end[0]) / 2, (start[1] + end[1]) / 2)
    paper.mouse.move(*end)
    paper.mouse.up()
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
    said = paper.locator("#published [data-point]")
    before = said.inner_text()
    ((x, y),) = at(paper, "published-trust-4", (0.01, 2.6))
    paper.mouse.click(x, y)
    paper.wait_for_function(
        """(before) => document.querySelector("#published [data-point]").innerText !== before""",
        arg=before,
    )
    assert len(said.inner_text()) > 40
    assert paper.is_checked('#published [data-key="roll_off"][value="4"]')
    assert float(paper.input_value("#published-map_F-text")) == pytest.approx(0.01, rel=0.2)


def test_the_studies_have_their_place(paper):
    for study in study_summaries():
        section = paper.locator(f"#study-{study.name}")
        section.scroll_into_view_if_needed()
        assert section.locator("h2").inner_text() == study.title
        assert section.locator(".lead").inner_text() == study.answer
        for i in range(len(study.panels)):
            paper.wait_for_function(
                """(plot) => globalThis.Bokeh?.documents.some((each) =>
                    each.get_model_by_name(plot)?.inner_width > 0)""",
                arg=f"study-{study.name}-{i}",
            )
        section.locator("summary").click()
        rows = section.locator("tbody tr")
        assert rows.count() == len(study.rows)
        assert rows.first.locator("td").all_inner_texts() == list(study.rows[0])
        assert section.locator("td[data-verdict]").count() >= len(study.rows) / 2
        section.locator("summary").click()


def test_the_claims_are_shown_by_verdict(paper):
    rows = paper.locator('[data-table="claims"] tbody tr')
    everything = rows.count()
    counts = []
    for verdict in ("confirmed", "undecided", "refuted"):
        paper.check(f'#published [data-key="claims"][value="{verdict}"]')
        counts.append(rows.count())
        assert all(verdict in text for text in rows.all_inner_texts())
    assert sum(counts) == everything
    paper.check('#published [data-key="claims"][value="all"]')


def test_everything_has_a_name(paper):
    assert asked(paper, "nameless", "published") == []
    assert asked(paper, "undescribed", "published") == []


def test_it_is_seen_at_any_width_and_in_both_themes(pages):
    page = pages.open("?view=published&v=1&D_f=2,2.4&low_3D=0.02", theme="dark")
    ready(page)
    assert faint(page) == []
    # until then, the button that cancels their judgement is a stop, and it goes away
    page.wait_for_selector('[data-table="claims"] tbody tr')
    page.wait_for_selector("#published .cancel", state="hidden")
    wanted, reached, unseen = tabbed(page, "published")
    assert reached == wanted
    assert unseen == []
    page.click("#theme")
    for width in (1600, 390):
        assert cut_off(page, "published", width) == []
        assert faint(page) == []
    page.context.close()


def test_an_address_that_cannot_be_read_is_refused_in_one_sentence(pages):
    page = pages.open("?view=published&v=9&D_f=2")
    error = page.locator('#published [data-error=""]')
    error.filter(has_text="set the controls by hand").wait_for()
    ready(page)
    assert error.is_visible()
    page.context.close()


def test_figures_that_are_embedded_at_the_same_time_are_not_taken_for_each_other(pages):
    page = pages.open("?view=measured")
    named = page.evaluate(
        """async () => {
            const {embedded} = await import("/lab/plots.js");
            const {bodyFigures, publishedFigures} = await import("/lab/published-figures.js");
            const {exploreFigures} = await import("/lab/explore-figures.js");
            for (const view of document.querySelectorAll("main")) view.hidden = false;
            const published = () => publishedFigures(["1", "2"]), bodies = () => bodyFigures(4);
            const declared = [exploreFigures, published, bodies];
            const made = await Promise.all(declared.map(embedded));
            return made.map(({made}) => made.roots().map(({name}) => name));
        }"""
    )
    page.context.close()
    explore, published, bodies = map(set, named)
    assert any("published-trust" in name for name in published)
    assert not explore & published
    assert not explore & bodies
    assert not published & bodies
