"""What two materials and loads mean, before anything is pressed."""

from __future__ import annotations

import re
from itertools import chain
from pathlib import Path
from typing import Any

import numpy as np
from attrs import evolve

from roughline.engineering.rules import rules
from roughline.errors.words import speaking
from roughline.lab.controls import STRANGE, ControlError, sent_texts
from roughline.lab.explore.controls import CHOICES as EXPLORED
from roughline.lab.frames import frame
from roughline.lab.measured import controls as c
from roughline.lab.measured.state import PAGE_WORDS, ControlTexts, Source, page_question, used_in
from roughline.lab.server.tasks import Arguments, Progress
from roughline.question.asked import Theories
from roughline.question.loading import DEFAULT_LOADS
from roughline.question.loads import Hardness, find_hardness
from roughline.question.meant import facts_on_loads
from roughline.question.question import Question
from roughline.question.reading import Reading
from roughline.report.contact_tables import solid_in_words
from roughline.report.values import up_to_three_digits
from roughline.topography.body import Body, Line, Surface


@speaking(PAGE_WORDS)
def bodies(arguments: Arguments, progress: Progress) -> bytes:
    """E* of the bodies, and what each load is in all on the `sides` of the prepared body. [m]

    All controls are read, so that each is refused when it is set, and not when the body is pressed.
    """
    body = _flat(arguments.get("sides"))

    def read(texts: ControlTexts) -> tuple[Question, ControlTexts]:
        question = page_question(texts, Source(Path("no file yet"), "", ""))
        with c.at("joint_area" if "joint_area" in texts else ""):
            if body is not None:
                asked = [each for each in question.ask if not isinstance(each, Theories)]
                question = evolve(question, body=body, reading=Reading(), ask=asked)
        return question, texts

    (question, texts), refused = used_in(arguments, read)
    of = ", of what lies at the surfaces" if question.coated else ""
    rows = [["contact modulus E*", up_to_three_digits(question.modulus, None, "Pa") + of]]
    pair, notes = question.pair, ["a contact modulus alone gives the curve, and no answers"]
    if pair is not None:
        bodies = zip(c.BODIES.values(), (pair.first, pair.second), strict=False)
        rows += [[text.label, solid_in_words(solid)] for (_, text), solid in bodies]
        left_out = rules.left_out(pair, question.frequency_in_hertz)
        notes = [*map(str, [*pair.facts, *left_out])]
    rows.append(["yield", _yield_in_words(question, find_hardness(question))])
    if not question.loads:
        notes.append(
            f"no load is given: {DEFAULT_LOADS} loads from first touch to saturation are taken"
        )
    meanings = []
    if body is not None and question.loads:
        meanings = [*map(str, facts_on_loads(question, body))]
    elastic = {"elastic": "yes"} | {**sent_texts(arguments), "elastic": "yes"}  # changed first
    still = used_in({**arguments, "state": elastic}, read)[1] if refused else {}
    header = {
        "refused": refused,
        "mended_if_elastic": [key for key in refused if key not in still],
        "tables": {"measured-bodies": [["", ""], rows]},
        "lists": {"loads": meanings, "bodies-notes": notes},
        "words": {
            "line-preparation": _preparation_line(texts),
            "line-bodies": _bodies_line(question, texts),
        },
    }
    return frame(header)


def _preparation_line(texts: ControlTexts) -> str:
    """What is done to the topography, in one line."""
    trend = texts.get("trend", "default")
    removed = {"default": "tilt", "none": "no trend"}.get(trend, trend)
    others = _others(texts, "preparation", "trend")
    return ", ".join([f"{removed} removed", "missing points filled", *others])


def _bodies_line(question: Question, texts: ControlTexts) -> str:
    """What is pressed under which loads, in one line."""
    pair = question.pair
    pressed = f"E* = {up_to_three_digits(question.modulus, None, 'Pa')}"
    if pair is not None:
        pressed = f"{pair.first.name} {'against' if pair.coated else 'on'} {pair.second.name}"
    loads = ", ".join(question.loading.headings) or f"{DEFAULT_LOADS} loads"
    return ", ".join([pressed, loads, *_others(texts, "bodies", "loads")])


def _others(texts: ControlTexts, step: str, stated: str) -> list[str]:
    """What else is set in a step, less a control that is told."""
    found = []
    for key in chain(*c.STEPS[step].values()):
        usual = key in c.CHOICES and texts.get(key) == c.CHOICES[key].default
        if key in texts and key != stated and not usual:
            field, text = c.BY_CONTROL[key], texts[key]
            words = field.choices[text][1] if field.choices else text
            if key == "theories":
                names = EXPLORED[key].options
                words = " and ".join(names.get(each, each) for each in re.split(r"\s*,\s*", text))
            found.append(f"{field.label or key.replace('_', ' ')} {words}")
    return found


def _yield_in_words(question: Question, hardness: Hardness | None) -> str:
    """At which pressure the contact yields, and how well that is known."""
    if hardness is None:
        return "left out" if question.elastic else "no hardness is known: elastic"
    known = "as given" if hardness.factor == 1 else f"known to a factor of {hardness.factor:g}"
    return f"at {up_to_three_digits(hardness.value, None, 'Pa')}, {known}"


def _flat(sides: Any) -> Body | None:
    """A flat body with the sides that the page was told; None before there is one."""
    if sides is None:
        return None
    try:
        if len(sides) == 1:
            return Line(np.zeros(2), sides[0], "m", kind="profile")
        return Surface(np.zeros((2, 2)), sides, "m")
    except TypeError:
        raise ControlError(STRANGE) from None
