"""How loops are compiled, and where the machine code is kept."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any, TypeVar, cast

from numba import njit

_Loop = TypeVar("_Loop", bound=Callable[..., Any])


def compiled(loop: _Loop) -> _Loop:
    """Compile a loop on first use; it holds no lock, so threads may run it side by side.

    The machine code is kept beside the source or in the user's cache folder, so that the next
    process finds it; where neither can be written, every process compiles for itself.
    """
    return _compiled(loop, fastmath=False)


def compiled_sums(loop: _Loop) -> _Loop:
    """Compile a loop whose sums may be taken in another order, side by side, as BLAS takes them."""
    return _compiled(loop, fastmath={"reassoc", "nsz", "contract"})


def _compiled(loop: _Loop, **options: Any) -> _Loop:
    try:
        return cast(_Loop, njit(cache=True, nogil=True, **options)(loop))
    except RuntimeError:
        return cast(_Loop, njit(nogil=True, **options)(loop))
