"""What a thread keeps from one press for the next: working memory, and inverses of small grids."""

from __future__ import annotations

import threading
from collections.abc import Hashable, Iterator
from contextlib import contextmanager

from roughline.halfspace.elasticity.half_space import HalfSpace
from roughline.halfspace.inverse.approximate_inverse import ApproximateInverse
from roughline.halfspace.operators.discretisation import on_grid
from roughline.halfspace.operators.workspace import Workspace

# Working memory that is kept after a press, and tables of all grids that are: enough for
# 1024 x 1024 points and the coarser grids that lead them. [bytes]
_MOST_MEMORY = 2**26
_MOST_TABLES = 2**25


class _Kept(threading.local):
    def __init__(self) -> None:
        self.workspace = Workspace()
        self.inverses: dict[Hashable, ApproximateInverse] = {}  # the last one used comes last

    def clear(self) -> None:
        """Keep nothing of what was so far."""
        self.workspace.give_up()
        self.inverses.clear()


_kept = _Kept()


@contextmanager
def working_memory() -> Iterator[None]:
    """Own the thread's working memory for a press, and give it up after one if it is much.

    After an exception it is given up in any case, as it may be half at work.
    """
    sound = False
    try:
        yield
        sound = True
    finally:
        if not sound or _kept.workspace.nbytes > _MOST_MEMORY:
            _kept.workspace.give_up()


def inverse_on(
    half_space: HalfSpace, shape: tuple[int, int], spacing: tuple[float, float]
) -> ApproximateInverse:
    """Return the approximate inverse of a grid's operator, and with it the operator.

    They work in the memory of this thread. They are kept for the next who asks for the same grid,
    as far as they have room.

    Parameters
    ----------
    half_space, shape, spacing
        As for :func:`roughline.halfspace.operators.discretisation.on_grid`.
    """
    kept, grid = _kept.inverses, (half_space, shape, spacing)
    inverse = kept.pop(grid, None) if _has_hash(half_space) else None
    if inverse is None:
        inverse = ApproximateInverse.of(on_grid(half_space, shape, spacing, _kept.workspace))
    if _has_hash(half_space) and inverse.nbytes <= _MOST_TABLES:
        kept[grid] = inverse
        room = _MOST_TABLES
        for other in reversed(list(kept)):
            room -= kept[other].nbytes
            if room < 0:
                del kept[other]
    return inverse


def _has_hash(half_space: HalfSpace) -> bool:
    """Whether an equal half-space can be found again; one that holds an array cannot."""
    try:
        hash(half_space)
    except TypeError:
        return False
    return True
