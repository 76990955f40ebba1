"""The view Explore as a test drives it: what is drawn, what is said, what is set."""

from urllib.parse import parse_qsl, urlencode, urlsplit

import numpy as np

from lab.drawn_plots import image

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


def typed(page, key, text, view="explore"):
    """Type a text beside a control, and leave it."""
    field = page.locator(f'#{view} [data-text="{key}"]')
    field.fill(text)
    field.press("Tab")


def address(page):
    """Return the parameters of the address, when the page has written what is set."""
    page.evaluate("(rare) => new Promise((done) => setTimeout(done, rare))", RARE)  # timers queue
    return dict(parse_qsl(urlsplit(page.evaluate("() => location.href")).query))


def sentence(page, key, view="explore"):
    """Return what stands in red at a control."""
    return page.locator(f'#{view} [data-error="{key}"]')


def save(page, name, folder):
    """Save something by the button; return where it is."""
    page.select_option("#saved", name)
    with page.expect_download() as coming:
        page.click("#save")
    assert coming.value.suggested_filename == name
    coming.value.save_as(folder / name)
    return folder / name


def put(page, name, **attributes):
    """Set attributes of what Bokeh has by a name, as its tools do."""
    page.evaluate(
        """([name, attributes]) => {
            const made = Bokeh.documents.find((each) => each.get_model_by_name(name));
            Object.assign(made.get_model_by_name(name), attributes);
        }""",
        [name, attributes],
    )


def assert_link_shows_the_same(page, pages, at_rest, **wanted):
    """Check that a link to the page shows the same; return the page that it opens."""
    other = pages.open("?" + urlencode(address(page)))
    at_rest(other, **wanted)
    assert strip(other) == strip(page)
    np.testing.assert_array_equal(image(other, "contact"), image(page, "contact"))
    shown = '#explore [data-key="shown"]'
    assert other.input_value(shown) == page.input_value(shown)
    return other
