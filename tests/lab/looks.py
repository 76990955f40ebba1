"""What a page looks like to eyes, ears and keys; the questions are in looks.js."""

import time
from pathlib import Path

from reference import patience

_QUESTIONS = (Path(__file__).parent / "looks.js").read_text(encoding="utf-8")
_AA = 4.5  # least contrast of texts
_PHONE = 760  # below this width fingers are expected [px]


def asked(page, question, *arguments):
    """Ask one of the questions of a page."""
    return page.evaluate(f"(arguments) => {_QUESTIONS}.{question}(...arguments)", list(arguments))


def faint(page):
    """Return the texts that do not stand out from what is behind them."""
    found = asked(page, "contrasts")
    assert found
    return [(text, contrast) for text, contrast in found if contrast < _AA]


def cut_off(page, view, width, height=1100):
    """Make the window so large; return what is cut off or too small to touch, once it is drawn."""
    page.set_viewport_size({"width": width, "height": height})
    end = time.monotonic() + patience()
    while True:
        found = asked(page, "cut", view)
        if width < _PHONE:
            found += asked(page, "small", view)
        beyond = asked(page, "width") - width
        if (not found and not beyond) or time.monotonic() > end:
            return found + [f"{beyond} pixels beyond the window"] * bool(beyond)
        page.wait_for_timeout(50)


def tabbed(page, view):
    """Go through a view by the tab key: what should stop it, what did, and what was unseen."""
    wanted = asked(page, "stops", view)
    page.focus(".skip")  # the first stop of all, which leads past the header
    reached, unseen = [], []
    for _ in range(2 * len(wanted)):
        if len(reached) == len(wanted):
            break
        page.keyboard.press("Tab")
        stop, is_seen = asked(page, "stop")
        if stop == "passing":  # a long table, which scrolls by keys, or a cancel, gone or there
            continue
        reached.append(stop)
        if not is_seen:
            unseen.append(stop)
    return wanted, reached, unseen


def texts_stand_out(page, view):
    """Check that texts of a view are seen at any width and large enough, and name what is there."""
    assert faint(page) == []
    for width, height in ((390, 844), (1200, 800), (1600, 1100)):
        assert cut_off(page, view, width, height) == []
        assert asked(page, "tiny", view) == []
    assert asked(page, "nameless", view) == []
    assert asked(page, "undescribed", view) == []
