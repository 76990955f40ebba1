"""Whether the parts of a question fit together, before any file is read."""

from __future__ import annotations

from typing import TYPE_CHECKING

from roughline.errors import InputError
from roughline.errors.checks import whole
from roughline.errors.words import called

if TYPE_CHECKING:
    from roughline.assessment.question import Question


def refuse_inconsistent_loads(question: Question) -> None:
    """Refuse loads, depths and numbers of loads that do not go together.

    Raises
    ------
    InputError
        If more than one of them is given, or a history or an unloading lacks them.
    """
    given = (question.n_loads, question.loads or None, question.depths or None)
    if sum(each is not None for each in given) > 1:
        raise InputError(
            f"give one of {called('loads')}, {called('depths')} and {called('n_loads')}"
        )
    if question.n_loads is not None:
        whole("n_loads", question.n_loads, 2, "a whole number of at least 2 is needed")
    if question.unload and (not question.loads or question.history):
        raise InputError(
            f"{called('unload', True)} takes off the largest of the loads "
            f"({called('loads')}); in a history, and for "
            "depths, write the falling values yourself"
        )
    if question.history and not (question.loads or question.depths):
        raise InputError(
            f"{called('history', True)} needs {called('loads')} or {called('depths')} in the "
            "order of the history"
        )


def refuse_inconsistent_joint(question: Question) -> None:
    """Refuse a joint that is asked for what only a body has.

    Raises
    ------
    InputError
        If there are no materials, or depths instead of loads.
    """
    if question.joint_area is None:
        return
    if question.materials is None:
        raise InputError(
            f"answers of a joint ({called('joint_area')}) need two materials "
            f"({called('materials')})"
        )
    if question.depths:
        raise InputError(
            f"a joint ({called('joint_area')}) is pressed by loads ({called('loads')}): its "
            "depth counts from the "
            "touch of its highest point, which a map does not show"
        )


def refuse_inconsistent_maps(question: Question) -> None:
    """Refuse several maps without what they are compared by.

    Raises
    ------
    InputError
        If there are no materials or no loads, the maps share one name, or there is a second
        topography.
    """
    if not question.is_of_several:
        return
    if question.materials is None:
        raise InputError(
            "several maps are compared by their answers, which need two materials "
            f"({called('materials')})"
        )
    if not question.loads and not question.depths:
        raise InputError(
            f"several maps are pressed under the same loads: give them ({called('loads')})"
        )
    if question.against is not None:
        raise InputError(
            "several maps are pressed into a smooth body: the one second topography "
            f"({called('against')}) "
            "would be the same for all maps, and its own scatter between places would not show; "
            f"press each map against it alone, or leave {called('against')} out"
        )
    if question.reading.name is not None:
        raise InputError(
            f"the name in {called('reading')} is that of one file, and there are several "
            "maps: leave it out"
        )
