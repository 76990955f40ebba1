"""A body that creeps: the relaxation function of its modulus, a Prony series."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass
from functools import lru_cache

import numpy as np
from numpy.typing import ArrayLike

from roughline.computing.arrays import Real
from roughline.creep.fading_memory import FadingMemory
from roughline.errors import InputError
from roughline.errors.checks import between, refuse, several
from roughline.errors.public import public

_SHORTEST_TIME, _LONGEST_TIME = 1e-100, 1e100  # whose squares and quotients are numbers
_SMALLEST_MODULUS = 1e-12  # left of that at once; shares that leave less add up to 1


@public
@dataclass(frozen=True)
class Creep:
    """A modulus that relaxes from E_0 at once to less in the end, by a Prony series.

    After a strain was applied, the stress falls as R(t) = 1 - sum of g_i (1 - exp(-t / tau_i)).
    After a stress was applied, the strain grows as J(t), of which s L[R] s L[J] = 1 in Laplace's
    transform: as many exponentials, whose times are longer. Poisson's ratio stays as it is.

    Parameters
    ----------
    shares : float or sequence of float
        Shares g_i of E_0 that relax. Together they are less than 1: in the end the body bears as a
        solid. [1]
    times : float or sequence of float
        Relaxation times tau_i. [time]

    Raises
    ------
    InputError
        If a share or a time is not positive, the shares add up to 1 or more, or there are not as
        many of both.

    References
    ----------
    .. [1] S. W. Park and R. A. Schapery, "Methods of interconversion between linear viscoelastic
       material functions, part I", Int. J. Solids Struct. 36, 1653-1675 (1999).

    Examples
    --------
    >>> import roughline as rl
    >>> rubber = rl.Creep(shares=[0.3, 0.4], times=[1.0, 100.0])
    >>> print(rubber.relaxation([0.0, 1.0, 1e4]).round(3))
    [1.    0.806 0.3  ]
    >>> print(rubber.compliance([0.0, 1.0, 1e4]).round(3))
    [1.    1.221 3.333]
    """

    shares: float | Sequence[float]
    times: float | Sequence[float]

    def __post_init__(self) -> None:
        for name, most, needed in (
            ("shares", 1.0, "a positive number below 1 is needed"),
            ("times", _LONGEST_TIME, "a positive time from 1e-100 to 1e100 is needed"),
        ):
            given = getattr(self, name)
            each = [
                between(name, one, _SHORTEST_TIME, most, needed)
                for one in several(given) or [given]
            ]
            object.__setattr__(self, name, tuple(each))
        shares, times = several(self.shares), several(self.times)
        if len(shares) != len(times):
            raise InputError(
                f"shares are {len(shares)} in number and times {len(times)}; give a relaxation "
                "time for each share"
            )
        if self.relaxed_share < _SMALLEST_MODULUS:
            raise InputError(
                f"add up to {math.fsum(shares):.12g}; less than 1 is needed: a body that relaxes "
                "to nothing flows like a liquid, and its contact grows without end",
                "shares",
            )

    @property
    def relaxed_share(self) -> float:
        """What is left of the modulus in the end, R(infinity). [1]"""
        return math.fsum([1.0, *(-each for each in several(self.shares))])

    def relaxation(self, t: ArrayLike) -> Real:
        """Return the relaxation function R, the modulus over E_0.

        Parameters
        ----------
        t : array_like
            Times since the strain was applied, not negative. [time]

        Returns
        -------
        ndarray, shape of t
            Between 1 and `relaxed_share`. [1]
        """
        return memory_of_strain(self).at(_since(t))

    def compliance(self, t: ArrayLike) -> Real:
        """Return the creep function J, the compliance times E_0.

        Parameters
        ----------
        t : array_like
            Times since the stress was applied, not negative. [time]

        Returns
        -------
        ndarray, shape of t
            From 1 to 1 / `relaxed_share`. [1]
        """
        return memory_of_stress(self).at(_since(t))


@lru_cache
def memory_of_strain(creep: Creep) -> FadingMemory:
    """Return the relaxation function, with which stress follows from a history of strain."""
    rates = 1 / np.array(several(creep.times))
    order = np.argsort(rates)
    return FadingMemory(creep.relaxed_share, np.array(several(creep.shares))[order], rates[order])


@lru_cache
def memory_of_stress(creep: Creep) -> FadingMemory:
    """Return the creep function, with which strain follows from a history of stress.

    With Lambda = diag(1 / tau), gamma_i = sqrt(g_i) and b = sqrt(Lambda) gamma,
    s L[R] = 1 - b (s + Lambda)^-1 b, whose inverse is s L[J] = 1 + b (s + Lambda - b b)^-1 b. So
    the rates are the eigenvalues of Lambda - b b = B^T B, B = sqrt(1 - gamma gamma) sqrt(Lambda),
    which are positive. The left singular vectors u_j of B give the weights,
    (u_j gamma)² / (1 - sum of g). Jacobi's rotations find those of a matrix whose columns differ by
    many orders [1]_.

    References
    ----------
    .. [1] J. Demmel and K. Veselic, "Jacobi's method is more accurate than QR", SIAM J. Matrix
       Anal. Appl. 13, 1204-1245 (1992).
    """
    from scipy.linalg.lapack import dgejsv  # here because it loads slowly

    relaxing = memory_of_strain(creep)
    gamma, unit = np.sqrt(relaxing.weights), relaxing.rates[-1]
    narrowed = (1 - math.sqrt(relaxing.end)) / (gamma @ gamma)
    root = np.eye(gamma.size) - narrowed * np.outer(gamma, gamma)
    values, u, _, scales, *_ = dgejsv(root * np.sqrt(relaxing.rates / unit))
    rates = unit * (values * scales[0] / scales[1]) ** 2
    weights = (u.T @ gamma) ** 2 / relaxing.end
    order = np.argsort(rates)
    return FadingMemory(1 / relaxing.end, -weights[order], rates[order])


def _since(t: ArrayLike) -> Real:
    """Return times since a step."""
    found = np.asarray(t, dtype=np.float64)
    if not (found >= 0).all():
        refuse("t", t, "times since the step are needed, not negative")
    return found
