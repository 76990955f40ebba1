"""The view Explore as a test drives it: what is drawn, what is said, what is set."""

from urllib.parse import parse_qsl, urlsplit

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
