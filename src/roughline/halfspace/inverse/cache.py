"""What a thread keeps from one press for the next: working memory, and inverses of small grids."""

from __future__ import annotations

import threading
from collections.abc import Hashable, Iterator
from contextlib import contextmanager

from roughline.halfspace.elasticity.half_space import HalfSpace
from roughline.halfspace.inverse.approximate_inverse import ApproximateInverse
from roughline.halfspace.operators.discretisation import on_grid
from roughline.halfspace.operators.workspace import MUCH_MEMORY, Workspace

_MOST_CACHED_BYTES = 2**25  # enough for 1024 x 1024 points and the coarser grids that lead them


class _Cache(threading.local):
    def __init__(self) -> None:
        self.workspace = Workspace()
        self.inverses: dict[Hashable, ApproximateInverse] = {}  # the last one used comes last

    def clear(self) -> None:
        """Keep nothing of what was so far."""
        self.workspace.give_up()
        self.inverses.clear()


_cache = _Cache()


@contextmanager
def working_memory() -> Iterator[None]:
    """Own the thread's working memory for a press, and give it up after one if it is much.

    After an exception it is given up in any case, as it may be half at work.
    """
    try:
        yield
    except BaseException:
        _cache.workspace.give_up()
        raise
    if _cache.workspace.nbytes > MUCH_MEMORY:
        _cache.workspace.give_up()


def inverse_on(
    half_space: HalfSpace, shape: tuple[int, int], spacing: tuple[float, float]
) -> ApproximateInverse:
    """Return the approximate inverse of a grid's operator, and with it the operator.

    They work in the memory of this thread, and are kept for the next who asks for the same grid, as
    far as they have room. Those of a half-space that holds an array, and so has no hash, are not.
    """
    inverses, grid = _cache.inverses, (half_space, shape, spacing)
    try:
        hash(grid)
    except TypeError:
        return _made(*grid)
    inverse = inverses.pop(grid, None) or _made(*grid)
    if inverse.nbytes <= _MOST_CACHED_BYTES:
        inverses[grid] = inverse
        while sum(each.nbytes for each in inverses.values()) > _MOST_CACHED_BYTES:
            del inverses[next(iter(inverses))]
    return inverse


def _made(
    half_space: HalfSpace, shape: tuple[int, int], spacing: tuple[float, float]
) -> ApproximateInverse:
    return ApproximateInverse.of(on_grid(half_space, shape, spacing, _cache.workspace))
