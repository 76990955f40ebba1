"""A cause: why answers are not known better, as one object, and the list of all that are asked."""

from __future__ import annotations

from abc import ABC, abstractmethod
from collections.abc import Iterable, Iterator, Sequence
from typing import ClassVar

from roughline.assessment.case import Case
from roughline.errors import InputError
from roughline.errors.checks import allowed_choice, refuse, shown
from roughline.errors.public import public
from roughline.facts.fact import Fact
from roughline.margins.spread import Spread
from roughline.margins.variant import Curves, Variant


@public
class Cause(ABC):
    """Why answers are not known better: what is pressed to learn it, and how far that moves them.

    All that is known of a cause stands in one class. Once it is added to ``rl.causes``, its presses
    are among those of every question, and what it leaves open is in all intervals.

    Attributes
    ----------
    name : str
        By which it is found, such as "grid".
    title : str
        What pages call it, such as "the grid".
    remedy : str
        What would narrow it, such as "finer pixels".
    takes : str
        What its presses are for, as the announced cost of a large run says it, such as "for the
        surface around the map".
    is_of_larger : bool
        Whether it leaves open what is said of the surface that a map was cut out of, and nothing of
        the map alone.
    is_bound : bool
        Whether it bounds what other causes leave open, instead of being independent of them.
    """

    name: ClassVar[str]
    title: ClassVar[str]
    remedy: ClassVar[str]
    takes: ClassVar[str] = ""
    is_of_larger: ClassVar[bool] = False
    is_bound: ClassVar[bool] = False

    def presses(self, case: Case, pressed: Variant) -> Sequence[Variant]:
        """What is pressed to learn it, beside a variant: the body as asked, or repeated."""
        return ()

    @abstractmethod
    def spread(self, case: Case, curves: Curves, variant: str) -> Spread | None:
        """Both ends that it alone leaves open of a variant; None where that is not known."""

    def facts(self, case: Case, curves: Curves) -> Sequence[Fact]:
        """What is worth telling of it: where it is wide, absent or grave."""
        return ()


@public
class Causes:
    """The causes that leave answers open.

    Independent ones add in squares; those that are bounds come after them.
    """

    def __init__(self, causes: Iterable[Cause] = ()) -> None:
        self._by_name: dict[str, Cause] = {}
        for each in causes:
            self.add(each)

    def __iter__(self) -> Iterator[Cause]:
        """Causes one by one."""
        return iter(tuple(self._by_name.values()))

    def __getitem__(self, name: str) -> Cause:
        """The cause of a name.

        Raises
        ------
        InputError
            If there is none of that name.
        """
        return self._by_name[allowed_choice("name", name, self._by_name)]

    def add(self, cause: Cause) -> None:
        """Add a cause: what it leaves open is then in the intervals of every assessment.

        Raises
        ------
        InputError
            If it is no Cause, has no name, or that of another.
        """
        if not isinstance(cause, Cause):
            refuse("cause", cause, "give an object of a class that is a Cause")
        lacking = [each for each in ("name", "title", "remedy") if not getattr(cause, each, "")]
        if lacking:
            raise InputError(f"has no {' and no '.join(lacking)}: give it one, as a text", "cause")
        if cause.name in self._by_name:
            raise InputError(
                f"has the name {shown(cause.name)}, as {self._by_name[cause.name].title} has; give "
                "another, or remove that one first (rl.causes.remove)",
                "cause",
            )
        self._by_name[cause.name] = cause

    def remove(self, name: str) -> None:
        """Remove a cause.

        Raises
        ------
        InputError
            If there is none of that name.
        """
        del self._by_name[self[name].name]
