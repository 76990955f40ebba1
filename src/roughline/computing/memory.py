"""The memory that is free, and the refusal of what needs more."""

from __future__ import annotations

import psutil

from roughline.errors import InputError

_USABLE = 0.95  # of the memory that is free


def fits_into_memory(needed: int) -> bool:
    """Return whether so many bytes of memory are free."""
    return needed <= _USABLE * psutil.virtual_memory().available


def refuse_beyond_memory(needed: int, what: str, advice: str) -> None:
    """Refuse work that needs more memory than is free.

    Parameters
    ----------
    needed : int
        Memory that the work takes. [bytes]
    what, advice : str
        The work, and what to do instead.

    Raises
    ------
    InputError
        If that is more than is free.
    """
    free = psutil.virtual_memory().available
    if not fits_into_memory(needed):
        raise InputError(
            f"{what} needs about {needed / 1e9:.3g} GB of memory, and {free / 1e9:.3g} GB is free: "
            f"{advice}"
        )
