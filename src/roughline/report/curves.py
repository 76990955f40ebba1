"""The curve of a body, with what its grid and its filled points leave open."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace

import numpy as np

from roughline.answers import Answer, Ends
from roughline.contact import press
from roughline.curve import Curve
from roughline.errors import Interrupted
from roughline.larger_interface import stiffness_of_the_larger_surface
from roughline.missing import Missing
from roughline.preparation import Preparation
from roughline.report.pressed import Real
from roughline.report.source import Source, read_parts, together
from roughline.topography import Body, Surface

Progress = Callable[[int, int], None]

_SMALL = 0.001  # changes below this are not told from none [%]


@dataclass(frozen=True)
class Run:
    """Loads and settings, for the body and for the same body filled otherwise.

    With `levelled`, a body is pressed without its tilt, which a periodic half-space cannot have.
    """

    E_star: float
    forces: list[float]
    depths: list[float]
    n_loads: int | None
    periodic: bool
    grid_error: bool
    levelled: bool = False

    @property
    def count(self) -> int:
        """Number of loads."""
        return len(self.forces) or len(self.depths) or self.n_loads or 0

    def press(
        self, body: Body, fields: list[int] | bool, progress: Progress | None
    ) -> tuple[Curve, bool]:
        """Press a body; loads that fail are marked. Gives whether Ctrl-C came as well."""
        if self.levelled:
            body = body.detrended()
        try:
            curve = press(
                body,
                E_star=self.E_star,
                n_loads=self.n_loads,
                forces=self.forces or None,
                depths=self.depths or None,
                periodic=self.periodic,
                fields=fields if isinstance(body, Surface) else False,
                grid_error=self.grid_error,
                throw=False,
                progress=progress,
            )
        except Interrupted as stop:
            return stop.curve, True
        return curve, False


@dataclass(frozen=True, eq=False)
class Solved:
    """A curve and its intervals.

    Attributes
    ----------
    curve : Curve
        Loads that failed are marked.
    interrupted : bool
        Whether Ctrl-C came.
    stiffness_error, area_error : ndarray, shape (loads,), or None
        Of stiffness [N / m] and corrected area fraction [1].
    most_area : ndarray, shape (loads,), or None
        What the area fraction does not exceed. [1]
    note : str
        What another way to fill missing points changes, if that was tried.
    """

    curve: Curve
    interrupted: bool
    stiffness_error: Real | None
    area_error: Real | None
    most_area: Real | None
    note: str = ""

    @property
    def stiffness_interval(self) -> Ends | None:
        """Both ends, if an error is known. [N / m]"""
        return _ends(self.curve.stiffness, self.stiffness_error, None)

    @property
    def area_interval(self) -> Ends | None:
        """Both ends, if an error is known. [1]"""
        return _ends(self.curve.area_fraction_corrected, self.area_error, self.most_area)


def solved(run: Run, body: Body, fields: list[int] | bool, progress: Progress | None) -> Solved:
    """Press a body; what its grid leaves open is known if the run says so."""
    curve, interrupted = run.press(body, fields, progress)
    # whole cells overstate an area under summits, and finer waves take away from it
    return Solved(
        curve,
        interrupted,
        curve.stiffness_error,
        curve.area_fraction_error,
        curve.area_fraction_most,
    )


def filled_otherwise(
    found: Solved,
    run: Run,
    body: Surface,
    sources: Sequence[Source],
    preparation: Preparation | None,
    progress: Progress | None,
) -> Solved:
    """Press the body with its missing points filled otherwise; the change is part of the errors."""
    curve = found.curve
    filling = Missing(sources[0].missing).other
    other = together(read_parts(sources, preparation, filling))
    assert isinstance(other, Surface)
    if other.shape != body.shape:
        other = trimmed(other)
    if np.array_equal(other.heights, body.heights):
        note = "the points were filled before the file was written: what that changes is not known"
        return replace(found, note=note)
    moved, interrupted = run.press(other, False, progress)
    stiffness, share = _change(curve.stiffness, moved.stiffness)
    area, area_share = _change(curve.area_fraction_corrected, moved.area_fraction_corrected)
    assert found.most_area is not None
    return Solved(
        curve,
        interrupted,
        _combined(found.stiffness_error, stiffness),
        _combined(found.area_error, area),
        found.most_area + area,
        f"filled by {filling} instead: stiffness moves by {_at_most(share)}, "
        f"area by {_at_most(area_share)}",
    )


def interface_alone(
    found: Solved,
    run: Run,
    body: Surface,
    fillings: tuple[Sequence[Source], Preparation | None] | None,
    progress: Progress | None,
) -> tuple[Answer, bool]:
    """Stiffness of the interface of the larger surface that a body was cut out of.

    The body is pressed again, into a periodic half-space, unless that was asked for to begin with.
    Gives whether Ctrl-C came as well.

    Parameters
    ----------
    found : Solved
        The curve as asked for.
    run : Run
        How it was made.
    body : Surface
        What was pressed.
    fillings : tuple, optional
        Sources and their preparation, to fill missing points otherwise.
    progress : callable, optional
        As for :func:`roughline.press`.
    """
    converged = found.curve.converged
    again = found
    if not run.periodic and (found.interrupted or not converged.any()):
        again = replace(
            found, curve=replace(found.curve, stiffness=np.full(converged.size, np.nan))
        )
    elif not run.periodic:
        forces = found.curve.force[converged].tolist()
        run = replace(run, forces=forces, depths=[], n_loads=None, periodic=True, levelled=True)
        again = solved(run, body, False, progress)
        if fillings is not None and not again.interrupted:
            again = filled_otherwise(again, run, body, *fillings, progress)
    answer = stiffness_of_the_larger_surface(body, again.curve, again.stiffness_interval)
    if answer.values.size < converged.size:  # loads that failed before have no force
        rows = np.full((3, converged.size), np.nan)
        rows[:, converged] = answer.values, answer.low, answer.high
        answer = replace(answer, values=rows[0], low=rows[1], high=rows[2])
    return answer, found.interrupted or again.interrupted


def trimmed(surface: Surface) -> Surface:
    """The surface without the last rows and columns that cannot be coarsened twice."""
    nx, ny = (n - n % 4 for n in surface.shape)
    return surface if (nx, ny) == surface.shape else surface.cropped((0, nx), (0, ny))


def _change(before: Real | None, after: Real | None) -> tuple[Real, float]:
    """By how much each load changes, and by how many per cent at most."""
    assert before is not None
    assert after is not None
    change = np.abs(after - before)
    with np.errstate(invalid="ignore", divide="ignore"):
        return change, 100 * float(np.nanmax(change / before, initial=0.0))


def _at_most(per_cent: float) -> str:
    return f"up to {per_cent:.2g}%" if per_cent >= _SMALL else f"less than {_SMALL}%"


def _combined(error: Real | None, change: Real) -> Real:
    return change if error is None else np.hypot(error, change)


def _ends(value: Real | None, error: Real | None, most: Real | None) -> Ends | None:
    """Both ends of an interval; nothing that is positive gets below zero."""
    if value is None or error is None:
        return None
    high = value + error
    with np.errstate(invalid="ignore"):
        return value / (1 + error / value), high if most is None else np.minimum(high, most)
