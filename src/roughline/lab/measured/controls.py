"""The controls of the view "My surface", made of the fields of a question."""

from __future__ import annotations

from roughline.lab.controls import Choice
from roughline.question.fields import FIELDS, FILE, PREPARATION

MOST_POINTS = 4096
"""Most points along a side that are resampled to."""
MOST_MAPS = 20
"""Most maps of one part; a page may have no more files."""

BY_CONTROL = {each.control: each for each in FIELDS if each.control}
"""Fields of a question by the keys of their controls."""

BODIES = {key: (field, text) for field in FIELDS for key, text in field.texts.items()}
"""Fields that say what is pressed, which have several texts or exclude each other, and their texts,
by the keys of these."""

_BODIES_BY = Choice(
    key="bodies",
    name="bodies given by",
    options={"materials": "two materials", "modulus": "contact modulus"},
    default="materials",
    meaning="Two materials give all answers; a contact modulus E* alone gives the curve.",
)
CHOICES = {
    key: Choice(
        key=key,
        name=field.label or key,
        options={word: word_on_page for word, (_, word_on_page) in field.choices.items()},
        default=next(iter(field.choices)),
        meaning=field.help,
    )
    for key, field in BY_CONTROL.items()
    if field.choices
}
CHOICES["bodies"] = _BODIES_BY
"""Controls of which one of several words is chosen."""

BEGINS = {key: text.begins for key, (_, text) in BODIES.items()}
BEGINS |= {key: field.begins for key, field in BY_CONTROL.items() if field.begins}
"""What stands in the form at first, by the keys of controls."""

KEYS = (*BY_CONTROL, "bodies", *BODIES)
"""Keys of all controls, as in the address."""

STEPS: dict[str, dict[str, list[str]]] = {"preparation": {"": []}, "bodies": {"": []}}
"""Keys of the controls of the second and the third step by their folds; "" has none."""

for _key, _field in BY_CONTROL.items():
    _step = "preparation" if _field.group in (FILE, PREPARATION) else "bodies"
    if _field.group != FILE or not _field.is_of_file:  # what a file leaves open is asked before
        STEPS[_step].setdefault(_field.fold, []).append(_key)
