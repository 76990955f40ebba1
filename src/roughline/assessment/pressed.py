"""What pressing a file gave: the body, its curve with intervals, and what follows from it."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field, fields, replace
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from roughline.assessment.loading import nominal_area
from roughline.assessment.source import Source
from roughline.contact.curve import Curve
from roughline.engineering.answers import Answer, Ends
from roughline.engineering.pair import MaterialPair
from roughline.theories.theory_curve import TheoryCurve
from roughline.topography.body import Body, Surface


@dataclass(frozen=True, eq=False)
class Pressed:
    """What pressing a file gave.

    Attributes
    ----------
    source : Source
        The file.
    parts : sequence of Surface or Line
        The topographies of the first body and, if that is rough, of the second, prepared. [m]
    body : Surface or Line
        What was pressed: the sum of two surfaces, or the first body. [m]
    curve : Curve
        Its curve; a load that did not converge is marked.
    asked : ndarray of int
        Which loads of the curve were asked for, in the order in which they were.
    texts : sequence of str
        What was given for each of them, such as "10 N"; empty where loads are spaced.
    stiffness_interval, area_interval : tuple of ndarray, shape (loads,), or None
        Both ends, over the loads of the curve: what the grid and filled points, or a single line
        scan, leave open of the stiffness [N / m] and of the corrected area fraction [1]. None where
        the grid's error is not known.
    interrupted : bool
        Whether Ctrl-C came before the last load was solved, or its errors estimated.
    pair : MaterialPair or None
        The materials.
    answers : list of Answer
        For the materials, over the loads that were asked for.
    theories : list of TheoryCurve
        At the mean pressures of the loads that were solved.
    notes : list of str
        Where an assumption breaks, what is suspicious, what is not known, what was filled, how the
        loads were meant; gravest first.
    filled : sequence of Surface or None
        Of each part, 1 where a point was missing and 0 elsewhere; None where that is not known.
    files : list of Path
        What was written.
    """

    source: Source
    parts: Sequence[Body]
    body: Body
    curve: Curve
    asked: NDArray[np.intp]
    texts: Sequence[str] = ()
    stiffness_interval: Ends | None = None
    area_interval: Ends | None = None
    interrupted: bool = False
    pair: MaterialPair | None = None
    answers: list[Answer] = field(default_factory=list)
    theories: list[TheoryCurve] = field(default_factory=list)
    notes: list[str] = field(default_factory=list)
    filled: Sequence[Surface | None] = ()
    files: list[Path] = field(default_factory=list)

    @property
    def area(self) -> float:
        """Nominal area; of a line scan, the square of its length. [m²]"""
        return nominal_area(self.body)

    @property
    def headings(self) -> list[str]:
        """What each load that was asked for is called: as it was typed, or its number."""
        return list(self.texts) or [str(i + 1) for i in self.asked]

    @property
    def at_asked(self) -> Curve:
        """The curve at the loads that were asked for, in their order, without fields."""
        taken = {
            item.name: getattr(self.curve, item.name)[self.asked]
            for item in fields(Curve)
            if isinstance(getattr(self.curve, item.name), np.ndarray)
        }
        return replace(self.curve, **taken, fields=())

    def ends_at_asked(self, ends: Ends | None) -> Ends | None:
        """Both ends of an interval at the loads that were asked for, in their order."""
        return None if ends is None else (ends[0][self.asked], ends[1][self.asked])
