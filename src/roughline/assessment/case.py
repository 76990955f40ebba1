"""A question of one body, read: what is pressed, under which loads, and what answers need."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from functools import cached_property

from roughline.assessment.grid import grid_error_is_estimated
from roughline.assessment.hardness import Hardness, hardness_of
from roughline.assessment.kinds import has_spectrum, is_map, nominal_area
from roughline.assessment.larger_surface import roll_offs_along_a_side
from roughline.assessment.loads import LoadCase
from roughline.assessment.question import Question
from roughline.assessment.source import Topography, pressed_body, topographies
from roughline.assessment.tiles import Beyond
from roughline.engineering.pair import MaterialPair
from roughline.spectra.moments import Moments, moments
from roughline.topography.body import Body, Line, Surface

HALVED_FROM = 2**20
"""Points from which on the scatter of the hardness is judged on half as many points a side."""


@dataclass(frozen=True, eq=False)
class Case:
    """A question whose files were read, in numbers.

    Attributes
    ----------
    question : Question
        What was asked.
    parts : sequence of Topography
        Of the first body and, if that is rough, of the second, prepared. [m]
    body : Surface or Line
        What is pressed. [m]
    loads : LoadCase
        Loads and settings with which it is pressed.
    """

    question: Question
    parts: Sequence[Topography]
    body: Body
    loads: LoadCase

    @classmethod
    def of(cls, question: Question) -> Case:
        """Read and prepare what a question is about, and check that both fit together.

        Raises
        ------
        InputError
            If a file cannot be read, or the question does not suit what it holds.
        """
        parts = topographies(question)
        body = pressed_body([each.body for each in parts])
        question.refuse_misfit(body)
        loads = LoadCase.of(question, body)
        grid_error = grid_error_is_estimated(question, body, loads)
        return cls(question, parts, body, replace(loads, grid_error=grid_error))

    @property
    def pair(self) -> MaterialPair | None:
        """Both materials; None where a contact modulus is given instead, and nothing answered."""
        return self.question.pair

    @property
    def hardness(self) -> Hardness | None:
        """Hardness of the softer body; None of a line, and where both are elastic."""
        return hardness_of(self.question) if isinstance(self.body, Surface) else None

    @property
    def is_scan(self) -> bool:
        """Whether a line scan is pressed, through the surfaces that it may be cut from."""
        return isinstance(self.body, Line) and self.body.kind == "profile"

    @property
    def filled(self) -> Sequence[Topography]:
        """The topographies, if points of one were missing; none otherwise."""
        return self.parts if any(each.is_filled for each in self.parts) else ()

    @property
    def map(self) -> Surface | None:
        """The map whose answers are about the surface that it was cut out of; None if none is."""
        body = self.body
        if self.pair is None or not isinstance(body, Surface):
            return None
        return body if self.question.joint is not None or is_map(body) else None

    @cached_property
    def judged(self) -> Body:
        """On which the scatter of the hardness is judged: the body, or a large one coarsened."""
        body = self.body
        if not isinstance(body, Surface) or body.heights.size < HALVED_FROM:
            return body
        return body if body.shape[0] % 2 or body.shape[1] % 2 else body.coarsened()

    @cached_property
    def beyond(self) -> Beyond:
        """The larger surface that the map is a piece of."""
        body, joint = self.body, self.question.joint
        roll_offs = roll_offs_along_a_side(body) if isinstance(body, Surface) else None
        return Beyond.of(roll_offs, nominal_area(body), joint)

    @cached_property
    def moments(self) -> Moments | None:
        """Moments of the body's spectrum; None of a line, where it has none, without materials."""
        return moments(self.body) if self.pair is not None and has_spectrum(self.body) else None
