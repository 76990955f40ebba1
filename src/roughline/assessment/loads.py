"""Loads of a question on a body, and the settings with which the body is pressed again."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace

import numpy as np

from roughline.assessment.hardness import hardness_of, refuse_beyond_hardness
from roughline.assessment.kinds import is_map, nominal_area
from roughline.assessment.question import DEFAULT_LOADS, UNLOADING, Question
from roughline.computing.arrays import Indices, Mask
from roughline.contact.curve import Curve
from roughline.contact.press import press
from roughline.topography.body import Body, Line, Surface

LoadProgress = Callable[[int, int], None]
"""Called with (loads done, loads in all)."""

_LIGHTEST = 1e-3  # of the largest load, where a whole curve begins
_ROUNDING = 1e-9  # of the force under which all of the area is at the hardness
_CURVE_LOADS = 16  # of a whole curve


@dataclass(frozen=True)
class LoadCase:
    """Loads and settings under which a body is pressed, and pressed again when it is changed.

    Attributes
    ----------
    E_star : float
        Contact modulus. [Pa]
    forces, depths : list of float
        In the order in which they are applied; at least one of the two lists is empty. [N], [m]
    asked : tuple of int
        Which of them were asked for, in the order asked; empty if none was named.
    n_loads : int or None
        Number of forces spaced from first touch to saturation, instead of given ones.
    periodic, grid_error
        As for :func:`roughline.press`.
    levelled : bool
        Whether the tilt is removed first, which a periodic half-space cannot have.
    hardness : float or None
        Of the softer body; None if both are elastic. [Pa]
    """

    E_star: float
    forces: list[float]
    depths: list[float]
    asked: tuple[int, ...]
    n_loads: int | None
    periodic: bool
    grid_error: bool = False
    levelled: bool = False
    hardness: float | None = None

    @classmethod
    def of(cls, question: Question, body: Body) -> LoadCase:
        """The loads of a question on a body, spaced ones of a line scan included."""
        area = nominal_area(body)
        forces, asked = _path(question, question.forces(area))
        depths, asked_depths = _path(question, question.heights())
        n_loads, hardness = question.n_loads, None
        if isinstance(body, Surface):
            refuse_beyond_hardness(question, area)
            known = hardness_of(question)
            hardness = None if known is None else known.value
        elif body.kind == "profile" and not forces:
            forces = _forces_of_a_scan(body, question.modulus, n_loads or DEFAULT_LOADS)
            n_loads = None
        levelled = question.joint is not None and is_map(body)
        return cls(
            question.modulus,
            forces,
            depths,
            asked or asked_depths,
            n_loads,
            question.is_repeated,
            levelled=levelled,
            hardness=hardness,
        )

    @property
    def count(self) -> int:
        """Number of loads."""
        return len(self.forces) or len(self.depths) or self.n_loads or 0

    @property
    def largest(self) -> int:
        """Number of the largest load; of spaced ones, the last."""
        values = self.forces or self.depths
        return values.index(max(values)) if values else self.count - 1

    def borne(self, curve: Curve) -> Mask:
        """Which loads of a curve were solved, and leave some of the area below the hardness."""
        if self.hardness is None or curve.area_fraction is None:
            return curve.converged
        most = self.hardness * curve.length**2
        return curve.converged & (np.nan_to_num(curve.force) < most * (1 - _ROUNDING))

    def under_forces_of(self, curve: Curve) -> LoadCase:
        """The same under the forces of a curve that were solved, and that the body bears."""
        forces = curve.force[self.borne(curve)].tolist()
        return replace(self, forces=forces, depths=[], n_loads=None)

    def of_hardness(self, hardness: float | None, loads: Mask, curve: Curve) -> LoadCase:
        """Some of the same loads on a body of another hardness, without the grid's errors.

        Spaced loads are those of the curve that was solved under them.
        """
        values = np.array(self.depths or self.forces or curve.force)[loads].tolist()
        forces, depths = ([], values) if self.depths else (values, [])
        return replace(
            self, hardness=hardness, forces=forces, depths=depths, n_loads=None, grid_error=False
        )

    def press(
        self,
        body: Body,
        fields: Sequence[int] = (),
        progress: LoadProgress | None = None,
        rtol: float = 1e-6,
    ) -> Curve:
        """Press a body; loads that fail are marked.

        Raises
        ------
        Interrupted
            On Ctrl-C, with the loads that were solved before.
        """
        return press(
            body.detrended() if self.levelled else body,
            E_star=self.E_star,
            hardness=self.hardness,
            n_loads=self.n_loads,
            forces=self.forces or None,
            depths=self.depths or None,
            periodic=self.periodic,
            fields=fields if isinstance(body, Surface) else False,
            grid_error=self.grid_error,
            rtol=rtol,
            throw=False,
            progress=progress,
        )


def asked_loads(case: LoadCase, count: int) -> Indices:
    """Which loads of the curve were asked for, in the order asked; all if none was named."""
    return np.array(case.asked) if case.asked else np.arange(count)


def load_with_fields(case: LoadCase) -> int:
    """The load whose fields are kept: the largest asked for, or one at three quarters of them."""
    return case.largest if case.asked else 3 * case.count // 4


def _path(question: Question, asked: list[float]) -> tuple[list[float], tuple[int, ...]]:
    """Return loads in the order in which they are applied, and where those asked for stand."""
    if not asked:
        return [], ()
    if question.history:
        before = _with_curve(asked[:1])[:-1] if question.whole_curve and question.loads else []
        return before + asked, tuple(range(len(before), len(before) + len(asked)))
    typed = asked[: -len(UNLOADING)] if question.unload else asked
    rising = sorted({*typed})
    if question.whole_curve and question.loads:
        rising = _with_curve(typed)
    falling = asked[len(typed) :]
    places = [rising.index(load) for load in typed]
    return rising + falling, (*places, *range(len(rising), len(rising) + len(falling)))


def _with_curve(asked: list[float]) -> list[float]:
    """Loads for a whole curve up to the largest, those asked for among them, rising."""
    curve = np.geomspace(_LIGHTEST * max(asked), max(asked), _CURVE_LOADS)
    apart = [f for f in curve if not np.isclose(f, asked, rtol=0.02).any()]
    return sorted({*asked, *apart})


def _forces_of_a_scan(line: Line, E_star: float, count: int) -> list[float]:
    """Forces for a line scan, from light contact to nearly saturated. [N]"""
    scale = E_star * line.rms_height * line.length
    return (scale * np.geomspace(1e-3, 3, count)).tolist()
