"""The view Explore as a test drives it: what is drawn, what is said, what is set."""

from urllib.parse import parse_qsl, urlencode, urlsplit

import numpy as np

SMALL = "?view=explore&v=1&D_f=2.4&seed=3&n=64&F=0.2&cutoff=0.0625"

RARE = 300  # between two changes of the address [ms]

_DRAWN = """([plot, wanted]) => {
    const text = document.querySelector(`#plot-explore-${plot}`)?.dataset.shown;
    if (!text) return false;
    const {numbers, ...others} = JSON.parse(text), said = {...others, ...numbers};
    return Object.entries(wanted).every(([key, value]) => said[key] === value) && said;
}"""


def drawn(page, plot="contact", **wanted):
    """Wait until the picture of a plot is of these numbers (or `points`, `what`) at rest."""
    return page.wait_for_function(_DRAWN, arg=[plot, wanted]).json_value()


def settled(page, **wanted):
    """Wait until everything at rest is drawn: contact, curves, nothing that is waited for."""
    drawn(page, **wanted)
    page.wait_for_selector("#explore:not(:has(.dimmed))")
    page.wait_for_selector("#explore .cancel", state="hidden")


def strip(page):
    """Return the answer strip: value and what stands below by key."""
    return page.evaluate(
        """() => Object.fromEntries(
            [...document.querySelectorAll("#explore [data-answer]")].map((item) => [
                item.dataset.answer,
                [...item.querySelectorAll("dd > *")].map((each) => each.textContent),
            ]))"""
    )


def table(page, plot):
    """Return the rows of the table under a plot."""
    return page.evaluate(
        """async (plot) => {
            const place = document.querySelector(`[data-table="explore-${plot}"]`);
            const fold = place.closest("details");
            if (!fold.open) { // which fills it
                const opened = new Promise((tell) => {
                    fold.addEventListener("toggle", tell, {once: true});
                });
                fold.open = true;
                await opened;
            }
            return [...place.querySelectorAll("tbody tr")].map(
                (row) => [...row.children].map((cell) => cell.textContent));
        }""",
        plot,
    )


def image(page, name):
    """Return the numbers of a map as Bokeh has them."""
    return page.evaluate(
        """(name) => {
            const made = Bokeh.documents.find((each) => each.get_model_by_name(name));
            return [...made.get_model_by_name(name).data.image[0]];
        }""",
        name,
    )


def typed(page, key, text):
    """Type a text beside a control, and leave it."""
    field = page.locator(f'#explore [data-text="{key}"]')
    field.fill(text)
    field.press("Tab")


def address(page):
    """Return the parameters of the address, when the page has written what is set."""
    page.evaluate("(rare) => new Promise((done) => setTimeout(done, rare))", RARE)  # timers queue
    return dict(parse_qsl(urlsplit(page.evaluate("() => location.href")).query))


def sentence(page, key):
    """Return what stands in red at a control."""
    return page.locator(f'#explore [data-error="{key}"]')


def model(page, name, attribute):
    """Return an attribute of what Bokeh has by a name."""
    return page.evaluate(
        """([name, attribute]) => {
            const made = Bokeh.documents.find((each) => each.get_model_by_name(name));
            return made.get_model_by_name(name)[attribute];
        }""",
        [name, attribute],
    )


def source(page, name):
    """Return x and y of what is drawn."""
    return page.evaluate(
        """(name) => {
            const made = Bokeh.documents.find((each) => each.get_model_by_name(name));
            const {x, y} = made.get_model_by_name(name).data;
            return [[...x], [...y]];
        }""",
        name,
    )


def assert_linked(page, pages, tick, panel, at_rest):
    """Check that a link to the page shows the same."""
    other = pages.open("?" + urlencode(address(page)))
    at_rest(other)
    assert strip(other) == strip(page)
    assert table(other, panel) == table(page, panel)
    np.testing.assert_array_equal(image(other, "contact"), image(page, "contact"))
    shown = '#explore [data-key="shown"]'
    assert other.input_value(shown) == page.input_value(shown)
    assert other.is_checked(f"#explore-adds-{tick}")
    assert other.is_visible(f"#plot-explore-{panel}")
    other.context.close()


def assert_taken_away(page, tick, panel, before):
    """Untick a physics, and check that nothing is left of it but what was there before."""
    (*_, last) = strip(page).keys() - before.keys()
    page.uncheck(f"#explore-adds-{tick}")
    settled(page, points=64)
    page.wait_for_function(f"() => !document.querySelector('[data-answer={last}]')")
    assert strip(page) == before
    assert not page.is_visible(f"#tab-{panel}")
    assert page.is_visible("#plot-explore-area")
    assert page.input_value('#explore [data-key="shown"]') == "area"
    assert set(image(page, "contact")) == {0, 1}
    assert tick not in address(page)
