"""How the contact under a load is searched for, which changes what it takes and not the answer."""

from __future__ import annotations

from typing import Literal, get_args

from attrs import field, frozen

from roughline.contact.arguments import checked_count
from roughline.errors.checks import allowed_choice
from roughline.errors.public import public

SearchPrecision = Literal["mixed", "float64", "float32"]


def _iterations(given: float) -> int:
    """A largest number of iterations."""
    return checked_count("max_iterations", given, 1)


def _precision(given: SearchPrecision) -> SearchPrecision:
    """A precision of the convolutions."""
    allowed_choice("precision", given, get_args(SearchPrecision))
    return given


@public
@frozen
class Solver:
    """How the contact under a load is searched for.

    What is returned keeps the tolerance in any case.

    Parameters
    ----------
    max_iterations : int, optional
        Largest number of convolutions to find the contact under one load. A few more certify it,
        and its stiffness takes further ones.
    precision : {"mixed", "float64", "float32"}, optional
        Precision of the convolutions. "mixed" takes its steps in single precision, computes the
        residuals in double, and returns what "float64" returns, to the tolerance. "float32" saves
        memory and refuses tolerances that it cannot reach.

    Raises
    ------
    InputError
        If an argument cannot be used.

    Examples
    --------
    >>> import roughline as rl
    >>> surface = rl.SelfAffine(hurst=0.8, rms_height=0.01, q_roll=25.0).surface(64, rng=7)
    >>> double = rl.Solver(precision="float64")
    >>> print(rl.press(surface, E_star=1.0, forces=[1e-3], solver=double).depth.round(4))
    [0.0093]
    """

    max_iterations: int = field(default=5000, converter=_iterations)
    precision: SearchPrecision = field(default="mixed", converter=_precision)


AS_USUAL = Solver()
