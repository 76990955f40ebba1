"""What pressing a file gave: the body, its curve with intervals, and what follows from it."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from roughline.answers import Answer, Ends
from roughline.curve import Curve
from roughline.materials import Interface
from roughline.report.loading import nominal_area
from roughline.report.source import Source
from roughline.theories import TheoryCurve
from roughline.topography import Body

Real = NDArray[np.float64]


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
        Which loads of the curve were asked for.
    stiffness_interval, area_interval : tuple of ndarray, shape (loads,), or None
        Both ends: what the grid, filled points or a single line scan leave open of the stiffness
        [N / m] and of the corrected area fraction [1].
    interrupted : bool
        Whether Ctrl-C came before the last load was solved, or its errors estimated.
    pair : Interface or None
        The materials.
    answers : list of Answer
        For the materials, over the loads of the curve.
    theories : list of TheoryCurve
        At the mean pressures of the loads that were solved.
    notes : list of str
        How the loads were meant, what was filled, what is suspicious, where an assumption breaks.
    files : list of Path
        What was written.
    """

    source: Source
    parts: Sequence[Body]
    body: Body
    curve: Curve
    asked: NDArray[np.intp]
    stiffness_interval: Ends | None = None
    area_interval: Ends | None = None
    interrupted: bool = False
    pair: Interface | None = None
    answers: list[Answer] = field(default_factory=list)
    theories: list[TheoryCurve] = field(default_factory=list)
    notes: list[str] = field(default_factory=list)
    files: list[Path] = field(default_factory=list)

    @property
    def area(self) -> float:
        """Nominal area; of a line scan, the square of its length. [m²]"""
        return nominal_area(self.body)
