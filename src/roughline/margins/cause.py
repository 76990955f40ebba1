"""A cause: why answers are not known better, as one object, and the list of all that are asked."""

from __future__ import annotations

from abc import ABC, abstractmethod
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from dataclasses import replace
from functools import partial
from typing import ClassVar

import numpy as np

from roughline.computing.arrays import Real
from roughline.contact.curve import SurfaceCurve
from roughline.errors import InputError
from roughline.errors.checks import allowed_choice, refuse, shown
from roughline.errors.public import public
from roughline.facts.fact import Fact
from roughline.margins.sheared import ShearedBody
from roughline.margins.spread import Spread, Values
from roughline.margins.variant import Curves, Variant
from roughline.question.case import Case
from roughline.question.loads import LoadCase
from roughline.topography.body import Surface


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
    is_of_shear : bool
        Whether it leaves open what a shear force does, and nothing else.
    """

    name: ClassVar[str]
    title: ClassVar[str]
    remedy: ClassVar[str]
    takes: ClassVar[str] = ""
    is_of_larger: ClassVar[bool] = False
    is_bound: ClassVar[bool] = False
    is_of_shear: ClassVar[bool] = False

    def presses(self, case: Case, pressed: Variant) -> Sequence[Variant]:
        """What is pressed to learn it, beside a variant: the body as asked, or repeated."""
        return ()

    @abstractmethod
    def spread(self, case: Case, curves: Curves, variant: str) -> Spread | None:
        """Both ends that it alone leaves open of a variant; None where that is not known."""

    def opens_shear(self, case: Case) -> bool:
        """Whether it leaves open what a shear force does to the body as asked; default: no."""
        return False

    def sheared(self, case: Case, asked: ShearedBody) -> ShearedBody | None:
        """What is sheared to learn that, beside the body and its path; None if it is not known."""
        return None

    def facts(self, case: Case, curves: Curves) -> Sequence[Fact]:
        """What is worth telling of it: where it is wide, absent or grave."""
        return ()


@public
class OtherBodies(Cause):
    """A cause that is learnt from other bodies, as good as the one asked about, pressed as it is.

    What it leaves open reaches as far to either side as these are away, by the root of the mean
    square, times `times`. One whose load does not converge leaves the ends under that load unknown.

    Attributes
    ----------
    count : int
        How many there are; default: 1.
    times : float
        Of the root mean square of their distances, on the scale of each quantity; default: 1.
    """

    count: ClassVar[int] = 1
    times: ClassVar[float] = 1.0

    @abstractmethod
    def body(self, case: Case, i: int) -> Surface:
        """The i-th other body, from 0; one with the heights of `case.body` is not pressed. [m]"""

    def presses(self, case: Case, pressed: Variant) -> Sequence[Variant]:
        """Each of the bodies, under the same loads."""
        if not isinstance(case.body, Surface):
            return ()
        return [
            replace(
                pressed,
                name=self._name(pressed.name, i),
                purpose=self.name,
                needed=partial(_other_body, case, pressed, partial(self.body, case, i)),
            )
            for i in range(self.count)
        ]

    def spread(self, case: Case, curves: Curves, variant: str) -> Spread | None:
        """How far their curves are away from that of a variant; None if Ctrl-C came before all."""
        curve, found = curves.get(variant), self.pressed(curves, variant)
        if curve is None or self.name in curves.missing:
            return None
        values = Values.of(curve)
        others = [Values.of(each) for each in found] or [values]
        return Spread.between(values, others, times=self.times, more=self.more(curves))

    def opens_shear(self, case: Case) -> bool:
        """Whether it leaves open what a shear force does: as much as its first body shows."""
        return True

    def sheared(self, case: Case, asked: ShearedBody) -> ShearedBody | None:
        """The first of the bodies, along the same path."""
        return replace(asked, body=self.body(case, 0), times=self.times)

    def more(self, curves: Curves) -> Real | float:
        """By which share values may be larger or smaller besides. [1]"""
        return 0.0

    def pressed(self, curves: Curves, variant: str) -> list[SurfaceCurve]:
        """Curves of the bodies that were pressed as a variant was."""
        found = (curves.get(self._name(variant, i)) for i in range(self.count))
        return [each for each in found if each is not None]

    def _name(self, variant: str, i: int) -> str:
        return f"{variant}, {self.name} {i + 1}"


def _other_body(
    case: Case, variant: Variant, other: Callable[[], Surface], curves: Curves
) -> LoadCase | None:
    """Press another body under the loads of a variant, if that was pressed, and it differs."""
    first, curve = variant.needed(curves), curves.get(variant.name)
    if not isinstance(first, LoadCase) or curve is None:
        return None
    body = other()
    if np.array_equal(body.heights, case.body.heights):
        return None
    if first.n_loads is not None and curve.converged.all():
        first = first.under_forces_from(curve)  # the same forces, not new ones
    return replace(first, body=body, fields=())


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

    @property
    def independent(self) -> list[Cause]:
        """Those that leave values of a curve open, each by itself."""
        return [each for each in self if not (each.is_bound or each.is_of_shear)]

    def sheared_otherwise(self, case: Case) -> Mapping[str, ShearedBody | None]:
        """What each shears that leaves open what a shear force does; None where it is not known."""
        if (asked := ShearedBody.of(case)) is None:
            return {}
        return {each.name: each.sheared(case, asked) for each in self if each.opens_shear(case)}

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
