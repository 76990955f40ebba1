"""Student's t: how uncertain the mean of a few values is."""

from __future__ import annotations

from typing import Any

from numpy.typing import ArrayLike


def student(freedom: ArrayLike, share: ArrayLike = 0.975) -> Any:
    """Value below which Student's t of some degrees of freedom lies in a share of the cases.

    By default that is half the interval of a mean, over its standard error, at 95 %. The values are
    independent and scatter normally.
    """
    from scipy.special import stdtrit  # here because it loads slowly

    return stdtrit(freedom, share)
