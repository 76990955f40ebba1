"""The controls of the view "My surface", made of the fields of a question."""

from __future__ import annotations

import math
import re
from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import dataclass
from typing import Any

import roughline as rl
from roughline.lab.controls import Choice, Control, ControlError
from roughline.question.fields import FIELDS, FILE, PREPARATION, Field

MOST_POINTS = 4096
"""Most points along a side that are resampled to."""
MOST_MAPS = 20
"""Most maps of one part; a page may have no more files."""

BY_CONTROL = {each.control: each for each in FIELDS if each.control}
"""Fields of a question by the keys of their controls."""

_MOST_LOADS = 20


@dataclass(frozen=True, kw_only=True)
class FieldText(Control):
    """A text for a field of a question, read as the field is; without one the field is not told."""

    field: Field
    most: float = math.inf  # the largest number, or most texts, that this lab takes

    def read(self, text: str, state: Any = None) -> Any:
        """Return the value of the field, or raise a ControlError."""
        # here because the server, which reads nothing, loads this file
        from roughline.question.from_fields import refuse_alone

        with at(self.key):
            value = self.field.value(self._parted(text))
            refuse_alone(self.field, value)
        count = len(value) if isinstance(value, list) else value
        if isinstance(count, int) and count > self.most:
            sentence = f"{self.name}: {count} are too many; this lab takes up to {self.most:g}"
            raise ControlError(sentence, self.key)
        return value

    def _parted(self, text: str) -> str | list[str]:
        """The texts of a field that takes several, which a comma with a space parts as well."""
        if not self.field.separator:
            return text
        parts = re.split(rf"{self.field.separator}|,\s", text)
        return [part.strip() for part in parts if part.strip()]


@contextmanager
def at(key: str) -> Iterator[None]:
    """Say of a refusal at which control it arose, in the words of the page."""
    try:
        yield
    except rl.RoughlineError as error:
        about = [getattr(error, "argument", None), *getattr(error, "others", ())]
        keys = [each for name in about for each in _CONTROL_KEYS.get(name or "", (name,))]
        among = getattr(error, "among", [key for key in keys if key in KEYS] or [key])
        raise ControlError(str(error), *among) from None


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


def _choice(key: str, field: Field) -> Choice:
    values = {word: value for word, (value, _) in field.choices.items()}
    return Choice(
        key=key,
        name=field.label or key,
        options={word: word_on_page for word, (_, word_on_page) in field.choices.items()},
        of=values.__getitem__,
        default=next(iter(values)),
        meaning=field.help,
    )


CHOICES = {key: _choice(key, field) for key, field in BY_CONTROL.items() if field.choices}
CHOICES["bodies"] = _BODIES_BY
"""Controls of which one of several words is chosen."""
_MOST_VALUES = {"points": MOST_POINTS, "loads": _MOST_LOADS}
CONTROLS: dict[str, Control] = CHOICES | {
    key: FieldText(
        key=key,
        name=field.label or key,
        field=field,
        most=_MOST_VALUES.get(field.name, math.inf),
        # without a text, in words
        default=field.otherwise if field.kind is float else "",
        meaning=field.help,
    )
    for key, field in BY_CONTROL.items()
    if not field.choices
}
"""All controls of fields by their keys, and how the bodies are given."""

BEGINS = {key: text.begins for key, (_, text) in BODIES.items()}
BEGINS |= {key: field.begins for key, field in BY_CONTROL.items() if field.begins}
"""What stands in the form at first, by the keys of controls."""

KEYS = (*BY_CONTROL, "bodies", *BODIES)
"""Keys of all controls, as in the address."""
_CONTROL_KEYS = {each.name: (key,) for key, each in BY_CONTROL.items()} | {
    field.name: tuple(field.texts) for field, _ in BODIES.values()
}
"""Keys of controls by the names of arguments."""

STEPS: dict[str, dict[str, list[str]]] = {"preparation": {"": []}, "bodies": {"": []}}
"""Keys of the controls of the second and the third step by their folds; "" has none."""

for _key, _field in BY_CONTROL.items():
    _step = "preparation" if _field.group in (FILE, PREPARATION) else "bodies"
    if _field.group != FILE or not _field.is_of_file:  # what a file leaves open is asked before
        STEPS[_step].setdefault(_field.fold, []).append(_key)
