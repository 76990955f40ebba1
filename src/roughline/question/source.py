"""Topographies of a question: read, prepared, filled by another method, and added up."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from functools import cached_property
from pathlib import Path

import numpy as np
from attrs import evolve

from roughline.errors import InputError
from roughline.errors.checks import refuse
from roughline.question.question import Question
from roughline.question.reading import Reading
from roughline.topography.body import Body, Line, Surface, within
from roughline.topography.files.measurement import Measurement
from roughline.topography.files.read import measurement
from roughline.topography.low_pass import inner_points
from roughline.topography.missing import Filler, Filling
from roughline.topography.preparation import Preparation, as_prepared
from roughline.topography.provenance import MOUNTING
from roughline.topography.trend import Trend
from roughline.topography.two_bodies import facing
from roughline.units import engineering


@dataclass(frozen=True, eq=False)
class Topography:
    """A body as it was read and prepared, with what is needed to fill its missing points again."""

    body: Body  # prepared [m]
    file: Path | None  # None for a body that was given
    measurement: Measurement | None
    """What the file holds, or the piece of it that is read, its missing points marked; None where
    none were missing."""

    reading: Reading
    preparation: Preparation | None

    @classmethod
    def of(
        cls, given: Body | Path, reading: Reading, preparation: Preparation | None
    ) -> Topography:
        """Take or read a body, and prepare it; refuse files and steps that do not suit."""
        if isinstance(given, Surface | Line):
            return cls(as_prepared(given, preparation), None, None, reading, preparation)
        content = measurement(given, reading.channel, reading.name).with_mask(reading.missing.mask)
        content, reading, preparation = crop_first(content, reading, preparation)
        unfilled = content if not content.by_roughline and content.unknown.any() else None
        body = measured_body(content, reading, preparation, in_place=unfilled is None)
        return cls(as_prepared(body, preparation), given, unfilled, reading, preparation)

    @property
    def is_filled(self) -> bool:
        """Whether points were missing and have been filled."""
        known = self.body.provenance
        return known.filled is not None or known.filled_before_crop > 0

    def filled_by(self, method: Filling) -> Body:
        """The body with its missing points filled by a method; itself where they are not known."""
        if self.measurement is None:
            return self.body
        reading = replace(self.reading, missing=evolve(self.reading.missing, method=method))
        body = measured_body(self.measurement, reading, self.preparation)
        return as_prepared(body, self.preparation)

    @cached_property
    def filled_region(self) -> Surface | None:
        """Where points were filled: 1 there, 0 elsewhere; None where that is not known.

        It has the points of the file, or of the piece of it that is read, less those that a low
        pass leaves out.
        """
        if self.measurement is None or self.measurement.kind != "surface":
            return None
        marked = replace(self.measurement, heights=self.measurement.unknown.astype(np.float64))
        marks = marked.body(self.reading.unit, self.reading.sizes, Filler(), "none")
        assert isinstance(marks, Surface)
        if self.preparation is not None and self.preparation.low_pass is not None:
            marks = within(marks, inner_points(marks, self.preparation.low_pass))
        return replace(marks, heights=np.sign(marks.heights))


def crop_first(
    content: Measurement, reading: Reading, preparation: Preparation | None
) -> tuple[Measurement, Reading, Preparation | None]:
    """Crop what a file holds before anything is filled; return how to read and prepare the rest."""
    if preparation is None or preparation.crop is None:
        return content, reading, preparation
    piece = content.piece(preparation.crop, reading.unit, reading.sizes)
    return piece, replace(reading, sizes=None), replace(preparation, crop=None)


def measured_body(
    content: Measurement,
    reading: Reading,
    preparation: Preparation | None,
    *,
    in_place: bool = False,
) -> Body:
    """The body that a file holds; its trend is left to the preparation if that names one.

    In place, the heights of the content are used up, which saves memory.
    """
    trend: Trend = "none" if preparation and preparation.trend else "tilt"
    removed = preparation.trend if preparation and preparation.trend else trend
    lines = preparation.lines if preparation else None
    filler = Filler(reading.missing, removed, lines)
    content = content.with_instrument(
        reading.instrument, is_tilt_of_mounting=reading.tilt == MOUNTING
    )
    body = content.body(reading.unit, reading.sizes, filler, trend, in_place=in_place)
    if reading.blur is not None and reading.blur >= body.length:
        length = engineering(body.length, "m")
        refuse("blur", reading.blur, f"the heights span {length}: a shorter one is needed [m]")
    return body


def topographies(question: Question) -> list[Topography]:
    """Read and prepare the first body and, if it is rough, the second."""
    first = Topography.of(question.bodies[0], question.reading, question.preparation)
    if question.against is None:
        return [first]
    reading = replace(question.reading, name=None)
    return [first, Topography.of(question.against, reading, question.preparation)]


def pressed_body(bodies: Sequence[Body]) -> Body:
    """Return the body to press: the sum of two surfaces, or the first of two line scans."""
    if len(bodies) == 1:
        return bodies[0]
    first, second = bodies
    if isinstance(first, Surface) and isinstance(second, Surface):
        return facing(first, second)
    if (
        isinstance(first, Line)
        and isinstance(second, Line)
        and first.kind == second.kind == "profile"
    ):
        return first
    raise InputError("two rough bodies must both be surfaces, or both line scans")
