"""The pages on laws and half-spaces of one's own list all that these are asked."""

import re
from pathlib import Path

import pytest

import roughline as rl

TUTORIALS = Path(__file__).parents[2] / "docs" / "tutorials"
LISTED = re.compile(r"^\| `(\w+)[^`]*` \|", re.MULTILINE)


@pytest.mark.parametrize(
    ("page", "asked"), [("add_a_contact_law", rl.ContactLaw), ("add_a_half_space", rl.HalfSpace)]
)
def test_every_member_is_listed(page, asked):
    listed = LISTED.findall((TUTORIALS / f"{page}.md").read_text("utf-8"))
    members = {*vars(asked), *asked.__annotations__}
    assert sorted(listed) == sorted(name for name in members if not name.startswith("_"))
