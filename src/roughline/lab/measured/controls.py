"""The controls of the view "My surface"."""

from __future__ import annotations

from roughline.assessment.fields import ANSWERS, BODIES, FIELDS, FILE, LOADS, PREPARATION
from roughline.lab.controls import Choice

MOST_POINTS = 4096
"""Most points along a side that are resampled to."""
MOST_MAPS = 20
"""Most maps of one part; a page may have no more files."""

BY_CONTROL = {each.control: each for each in FIELDS if each.control}
"""Fields of a question by the keys of their controls."""

_BODIES = Choice(
    "bodies",
    "bodies given by",
    {"materials": "two materials", "modulus": "contact modulus"},
    "materials",
    "Two materials give all answers; a contact modulus E* alone gives the curve.",
)
CHOICES = {"bodies": _BODIES} | {
    key: Choice(
        key,
        field.label or key,
        {word: shown for word, (_, shown) in field.choices.items()},
        next(iter(field.choices)),
        field.help,
    )
    for key, field in BY_CONTROL.items()
    if field.choices
}
"""Controls of which one of several words is chosen."""

OF_PREPARATION = tuple(
    key
    for key, field in BY_CONTROL.items()
    if field.group in (FILE, PREPARATION) and key not in ("unit", "channel", "size")
)
"""Controls of the second step; what a file leaves open is asked in the first."""
OF_FLUID = ("fluid", "inlet", "outlet", "seal", "flow_along", "sealing_pressure")
"""Controls of the third step for a fluid in the gap, in a fold of their own."""
FOLDED = tuple(
    key
    for key, field in BY_CONTROL.items()
    if key == "boundary" or (field.group == ANSWERS and key != "theories" and key not in OF_FLUID)
)
"""Controls of the third step that are folded away; theories have boxes of their own."""
OF_BODIES = tuple(
    key
    for key, field in BY_CONTROL.items()
    if field.group in (BODIES, LOADS) and key not in ("loads", *FOLDED)
)
"""Other controls of the third step, beside the bodies and the loads."""

KEYS = (*BY_CONTROL, "bodies", "first", "second", "E")
"""Keys of all controls, as in the address."""
