"""The tests that drive a page would see errors, requests that leave, and foreign code."""

import re

import pytest

from lab.explore_driven import SMALL

SHOWN = "#plot-explore-contact[data-shown]"


@pytest.fixture(scope="module")
def one_page(pages):
    return pages.open(SMALL)


def test_the_first_page_draws_a_contact_and_complains_of_nothing(one_page):
    one_page.wait_for_selector(SHOWN)


@pytest.mark.parametrize(
    ("script", "complaint"),
    [
        ("console.warn('columns of inconsistent lengths')", "inconsistent lengths"),
        ("setTimeout(() => { throw new Error('broken'); })", "broken"),
        ("fetch('http://192.0.2.1/').catch(() => 0)", "leaves for http://192.0.2.1"),
        ("new Image().src = 'http://192.0.2.1/a.png'", "Content Security Policy"),
        ("new WebSocket('ws://192.0.2.1/')", "Content Security Policy"),
        (
            "document.body.append(Object.assign(document.createElement('script'), "
            "{textContent: 'document.title = 1'}))",
            "Content Security Policy",
        ),
        ("document.body.setAttribute('onclick', 'document.title = 1')", "Content Security Policy"),
    ],
)
def test_what_must_not_be_is_seen(one_page, pages, script, complaint):
    with pages.expecting(f"{re.escape(complaint)}|192.0.2.1"):
        one_page.evaluate(
            f"() => {{ try {{ {script} }} catch (e) {{ console.error(e.message) }} }}"
        )
        one_page.click("body", position={"x": 2, "y": 2})
    assert one_page.title() != "1"
