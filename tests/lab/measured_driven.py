"""My surface as a test drives it: files that are brought, texts typed, and what is answered."""

CONNECTED = '#measured-step-bodies .line:has-text(" on ")'  # what the server has answered
EXAMPLE = "[data-example] >> nth=0"
LINE_SCAN = "[data-example] >> nth=2"  # which is soon prepared
READY = "[data-press]:not([disabled])"
SHOWN = '[data-result="answers"]:not(.dimmed) [data-table="measured-answers"] tbody tr'


def choose(page, *files, button="[data-choose]"):
    """Choose files by a button, as a person does."""
    with page.expect_file_chooser() as coming:
        page.click(button)
    coming.value.set_files(files)


_UNFOLD = """(each) => {
    for (let at = each; at; at = at.parentElement) if (at.matches("details")) at.open = true;
}"""


def fill(page, **texts):
    """Type texts beside controls, which may be folded away, and leave them."""
    for key, text in texts.items():
        field = page.locator(f"#measured-{key}-text")
        field.evaluate(_UNFOLD)
        field.fill(text)
        field.press("Tab")


def press(page, **texts):
    """Press the bodies, with what is typed before."""
    fill(page, **texts)
    page.click(READY)


def answers(page):
    """Return the table of the answers, when it is there."""
    page.locator(SHOWN).first.wait_for()
    return page.inner_text('[data-table="measured-answers"]')


def line_of(page, step):
    """What stands in the line of a step."""
    return page.locator(f"[data-words=line-{step}]")
