"""A question of one body, read: what is pressed, under which loads, and what answers need."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from functools import cached_property

from roughline.computing.arrays import Mask
from roughline.contact.measures import Measure
from roughline.engineering.pair import MaterialPair
from roughline.engineering.rules import rules
from roughline.fluid.measures import measures_at_border
from roughline.question.assumptions import broken
from roughline.question.extrapolation import Extrapolation, roll_offs_along_a_side
from roughline.question.kinds import has_spectrum, is_map, nominal_area
from roughline.question.loads import Hardness, LoadCase, find_hardness
from roughline.question.question import Question
from roughline.question.source import Topography, filled_points, pressed_body, topographies
from roughline.spectra.moments import Moments, moments
from roughline.topography.body import Body, Line, Surface

HALVED_FROM = 2**20
"""Points from which on the scatter of the hardness is judged on half as many points a side."""

COARSENED_FROM = 64
"""Points a side from which on the grid's error is estimated unasked."""

_CHEAP = 2**24  # points times loads up to which that takes a few seconds


@dataclass(frozen=True, eq=False)
class Case:
    """A question whose files were read, in numbers."""

    question: Question
    parts: Sequence[Topography]  # the first body and, if that is rough, the second, prepared [m]
    loads: LoadCase

    @classmethod
    def of(cls, question: Question) -> Case:
        """Read and prepare what a question is about; refuse it where it does not suit that."""
        parts = topographies(question)
        body = pressed_body([each.body for each in parts])
        question.refuse_misfit(body)
        if isinstance(body, Surface):
            for each in question.coated:
                each.refuse_grid(body.spacing)
        loads = LoadCase.of(question, body)
        grid_error = _grid_error_is_estimated(question, loads)
        return cls(question, parts, replace(loads, grid_error=grid_error))

    @property
    def body(self) -> Body:
        """What is pressed. [m]"""
        return self.loads.body

    @property
    def pair(self) -> MaterialPair | None:
        """Both materials; None where a contact modulus is given instead, and nothing answered."""
        return self.question.pair

    @property
    def hardness(self) -> Hardness | None:
        """Hardness of the softer body; None of a line, and where both are elastic."""
        return find_hardness(self.question) if isinstance(self.body, Surface) else None

    @property
    def scan(self) -> Line | None:
        """The line scan that is pressed through the surfaces that it may be cut from, if one is."""
        return self.body if isinstance(self.body, Line) and self.body.kind == "profile" else None

    @property
    def filled(self) -> Sequence[Topography]:
        """The topographies, if points of one were missing; none otherwise."""
        return self.parts if any(each.is_filled for each in self.parts) else ()

    @cached_property
    def filled_points(self) -> Mask | None:
        """Points of the pressed surface that were filled; None where none was, or not known."""
        if not self.filled or not isinstance(self.body, Surface):
            return None
        points = filled_points(self.parts)
        return None if points is None or not points.any() else points

    @property
    def map(self) -> Surface | None:
        """The map whose answers are about the surface that it was cut out of; None if none is."""
        body = self.body
        if self.pair is None or not isinstance(body, Surface):
            return None
        return body if self.question.joint is not None or is_map(body) else None

    @property
    def tells_of_larger(self) -> bool:
        """Whether the map tells how the surface that it was cut out of differs from it.

        How far tiles tell of that is known of bodies of one material each.
        """
        return not self.question.coated and not broken("larger surface", self.body)

    @property
    def is_repeated_for_interface(self) -> bool:
        """Whether the map is pressed periodically too, for the surface that it was cut out of."""
        return self.map is not None and not self.loads.periodic

    @property
    def measures(self) -> Sequence[Measure]:
        """What rules need from the fields of every load, of the map pressed periodically."""
        if self.pair is None or not isinstance(self.body, Surface):
            return ()
        return rules.measures(self.pair, self.question.sealing)

    @property
    def measures_at_border(self) -> Sequence[Measure]:
        """What tells how the border of a map that was cut out moves what flows; none of others."""
        sealing = self.question.sealing
        if sealing is None or self.map is None or not is_map(self.body):
            return ()
        return [
            each
            for along in sealing.directions
            for each in measures_at_border(sealing.rarefied, along)
        ]

    @cached_property
    def scatter_body(self) -> Body:
        """On which the scatter of the hardness is judged: the body, or a large one coarsened.

        Half as many points along a side need not resolve a layer.
        """
        body = self.body
        if not isinstance(body, Surface) or body.heights.size < HALVED_FROM:
            return body
        if self.question.coated:
            return body
        return body if body.shape[0] % 2 or body.shape[1] % 2 else body.coarsened()

    @cached_property
    def extrapolation(self) -> Extrapolation:
        """The larger surface that the map is a piece of."""
        body = self.body
        roll_offs = roll_offs_along_a_side(body) if isinstance(body, Surface) else None
        return Extrapolation.of(roll_offs, nominal_area(body), self.question.joint)

    @property
    def gap_extrapolation(self) -> Extrapolation:
        """The larger surface of what flows in the gap: of the seal, if there is one."""
        assembly = self.question.gap_assembly
        return Extrapolation.of(self.extrapolation.roll_offs, nominal_area(self.body), *assembly)

    @cached_property
    def moments(self) -> Moments | None:
        """Moments of the body's spectrum; None of a line, where it has none, without materials."""
        return moments(self.body) if self.pair is not None and has_spectrum(self.body) else None


def _grid_error_is_estimated(question: Question, loads: LoadCase) -> bool:
    """Whether the grid's error is estimated: as the question says, or else where that is cheap."""
    body = loads.body
    if question.grid_error is not None or isinstance(body, Line):
        return bool(question.grid_error)
    cheap = question.whole_curve or body.heights.size * loads.count <= _CHEAP
    return cheap and min(body.shape) >= COARSENED_FROM
