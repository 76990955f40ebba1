"""Questions of several maps of one part: what these are called, and that all are asked the same."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path

import attrs

from roughline.errors import InputError
from roughline.errors.checks import refuse
from roughline.question.question import Question


def map_names(questions: Sequence[Question]) -> list[str]:
    """What maps are called: their files' names, with folders where these are the same."""
    paths = [each.body if isinstance(each.body, Path) else None for each in questions]
    names = [
        f"map {i}" if path is None else question.name
        for i, (path, question) in enumerate(zip(paths, questions, strict=True), 1)
    ]
    for depth in range(2, 1 + max((len(path.parts) for path in paths if path), default=0)):
        repeated = {name for name in names if names.count(name) > 1}
        names = [
            str(Path(*path.parts[-depth:])) if path and name in repeated else name
            for name, path in zip(names, paths, strict=True)
        ]
    return [f"{name} ({i})" if names.count(name) > 1 else name for i, name in enumerate(names, 1)]


def refuse_unlike(questions: Sequence[Question]) -> None:
    """Refuse questions that differ in more than their map, and how it is read."""
    if not isinstance(questions, Sequence) or not all(
        isinstance(each, Question) for each in questions
    ):
        refuse("questions", questions, "a list of Questions, one of each map, is needed")
    if not questions:
        raise InputError("there is no map; give at least one, better five")
    for item in attrs.fields(Question):
        if (
            item.eq
            and item.name not in ("body", "reading")
            and any(
                getattr(each, item.name) != getattr(questions[0], item.name) for each in questions
            )
        ):
            raise InputError(
                f"all maps of a part are asked the same question, but {item.name} differs between "
                "them: give the same for all"
            )
