"""Operators and their approximate inverses, kept for the next pressing on the same grid."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager

from roughline.halfspace.elasticity.half_space import HalfSpace
from roughline.halfspace.inverse.approximate_inverse import ApproximateInverse
from roughline.halfspace.operators.discretisation import on_grid

_Grid = tuple[HalfSpace, tuple[int, int], tuple[float, float]]

# Of all grids that are kept; enough for 1024 x 1024 points and the coarser grids that lead them.
# With their working memory they take some 32 bytes a point, so 50 MB.
_MOST_POINTS = 3 * 2**19

_kept: dict[_Grid, ApproximateInverse] = {}  # the one that was used last comes last


@contextmanager
def lent(
    half_space: HalfSpace, shape: tuple[int, int], spacing: tuple[float, float]
) -> Iterator[ApproximateInverse]:
    """Lend the approximate inverse of a grid's operator, and with it the operator.

    Nobody else has it meanwhile, as both have working memory. It is kept for the next who asks for
    the same grid, if that is small; after an exception it is not, as it may be half at work.

    Parameters
    ----------
    half_space : HalfSpace
        The half-space.
    shape, spacing
        As for :func:`roughline.halfspace.operators.discretisation.on_grid`.
    """
    grid = half_space, shape, spacing
    inverse = _kept.pop(grid, None)
    if inverse is None:
        inverse = ApproximateInverse.of(on_grid(half_space, shape, spacing))
    yield inverse
    _keep(grid, inverse)


def _keep(grid: _Grid, inverse: ApproximateInverse) -> None:
    """Keep what was lent, if it is small, and of the others those used last that have room."""
    if _points(grid) > _MOST_POINTS:
        return
    _kept[grid] = inverse
    room = _MOST_POINTS
    for other in reversed(list(_kept)):
        room -= _points(other)
        if room < 0:
            _kept.pop(other, None)


def _points(grid: _Grid) -> int:
    return grid[1][0] * grid[1][1]
