"""The curve of a body, with what its grid and its filled points leave open."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace

import numpy as np

from roughline.assessment.larger_surface import stiffness_of_the_larger_surface
from roughline.assessment.source import Source, read_parts, together
from roughline.computing.arrays import Real
from roughline.contact.curve import Curve
from roughline.contact.press import press
from roughline.engineering.answers import Answer, Ends
from roughline.errors import Interrupted
from roughline.topography.body import Body, Surface
from roughline.topography.missing import Missing
from roughline.topography.preparation import Preparation

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
    stiffness_interval, area_interval : tuple of ndarray, shape (loads,), or None
        Both ends, of stiffness [N / m] and of the corrected area fraction [1].
    note : str
        What another way to fill missing points changes, if that was tried.
    """

    curve: Curve
    interrupted: bool = False
    stiffness_interval: Ends | None = None
    area_interval: Ends | None = None
    note: str = ""


def solved(run: Run, body: Body, fields: list[int] | bool, progress: Progress | None) -> Solved:
    """Press a body; what its grid leaves open is known if the run says so."""
    curve, interrupted = run.press(body, fields, progress)
    return Solved(curve, interrupted, *_intervals(curve))


def filled_otherwise(
    found: Solved,
    run: Run,
    body: Surface,
    sources: Sequence[Source],
    preparation: Preparation | None,
    progress: Progress | None,
) -> Solved:
    """Press the body with its missing points filled otherwise; the change adds to the errors."""
    curve = found.curve
    filling = Missing(sources[0].missing).other
    other = together(read_parts(sources, preparation, filling))
    assert isinstance(other, Surface)
    if np.array_equal(other.heights, body.heights):
        note = "the points were filled before the file was written: what that changes is not known"
        return replace(found, note=note)
    again = replace(run, grid_error=False)
    if run.n_loads is not None and curve.converged.all():
        again = replace(again, n_loads=None, forces=curve.force.tolist())  # not spaced anew
    moved, interrupted = again.press(other, False, progress)
    stiffness, share = _change(curve.stiffness, moved.stiffness)
    area, area_share = _change(curve.area_fraction_corrected, moved.area_fraction_corrected)
    note = (
        f"filled by {filling} instead: stiffness moves by {_at_most(share)}, "
        f"area by {_at_most(area_share)}"
    )
    return Solved(curve, interrupted, *_intervals(curve, stiffness, area), note)


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


def _intervals(
    curve: Curve, stiffness: Real | float = 0.0, area: Real | float = 0.0
) -> tuple[Ends | None, Ends | None]:
    """Intervals of stiffness and area from the grid's errors and from further ones.

    None without the grid's: further errors alone are narrower than what is unknown.
    """
    value, error, most = (
        curve.area_fraction_corrected,
        curve.area_fraction_error,
        curve.area_fraction_most,
    )
    if curve.stiffness_error is None or value is None or error is None or most is None:
        return None, None
    low, high = _ends(value, np.hypot(error, area))
    return (
        _ends(curve.stiffness, np.hypot(curve.stiffness_error, stiffness)),
        # whole cells overstate an area under summits, and finer waves take away from it
        (low, np.minimum(high, most + area)),
    )


def _change(before: Real | None, after: Real | None) -> tuple[Real, float]:
    """By how much each load changes, and by how many per cent at most."""
    assert before is not None
    assert after is not None
    change = np.abs(after - before)
    with np.errstate(invalid="ignore", divide="ignore"):
        return change, 100 * float(np.nanmax(change / before, initial=0.0))


def _at_most(per_cent: float) -> str:
    return f"up to {per_cent:.2g}%" if per_cent >= _SMALL else f"less than {_SMALL}%"


def _ends(value: Real, error: Real) -> Ends:
    """Both ends of an interval; nothing that is positive gets below zero."""
    with np.errstate(invalid="ignore"):
        return value / (1 + error / value), value + error
