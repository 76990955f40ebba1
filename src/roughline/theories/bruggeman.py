"""Bruggeman's effective medium: each place of the gap lies in a medium of the mean conductance.

References
----------
.. [1] D. A. G. Bruggeman, "Berechnung verschiedener physikalischer Konstanten von heterogenen
   Substanzen", Ann. Phys. 416, 636-664 (1935).
.. [2] B. Lorenz and B. N. J. Persson, "Leak rate of seals: effective-medium theory and comparison
   with experiment", Eur. Phys. J. E 31, 159-167 (2010).
.. [3] W. B. Dapp, A. Lücke, B. N. J. Persson and M. H. Müser, "Self-affine elastic contacts:
   percolation and leakage", PRL 108, 244301 (2012).
"""

from __future__ import annotations

import math
from dataclasses import replace

import numpy as np
from numpy.typing import ArrayLike
from scipy import optimize

from roughline.computing.arrays import Real
from roughline.errors.checks import refuse
from roughline.errors.public import public
from roughline.spectra.moments import Bands
from roughline.theories.interfacial_separation import separation
from roughline.theories.persson import persson
from roughline.theories.theory_curve import TheoryCurve

_SEALING_SHARE = 0.5  # share of contact at which the medium seals, 1 - 1 / d, for d = 2
_NODES, _WEIGHTS = np.polynomial.legendre.leggauss(64)  # over the shares without contact

_SMALLEST_CONDUCTANCE = 1e-300  # over the largest, below which a place counts as contact
_SHARE_ROUNDING = 1e-14  # of a sum of shares


def bruggeman(
    spectrum: Bands, E_star: float, pressure: Real, threshold: float = _SEALING_SHARE
) -> TheoryCurve:
    """Flow through the effective medium of the separations that Persson's theory gives.

    The gaps are u_1(zeta), each on the share -dA(zeta) / A_0 of the interface that loses contact at
    its magnification.
    """
    of_persson = persson(spectrum, E_star, pressure)
    aperture = np.zeros(pressure.size)
    for i in np.flatnonzero(of_persson.area_fraction < threshold):
        half = (1 - of_persson.area_fraction[i]) / 2
        gaps = separation(spectrum, E_star, pressure[i], 1 - half * (1 - _NODES))
        aperture[i] = _effective_gap(gaps, half * _WEIGHTS, threshold)
    return replace(
        of_persson,
        name="bruggeman",
        stiffness=None,
        hydraulic_aperture=aperture,
        validity="Gaussian random surfaces, isotropic, gaps of neighbouring places unrelated; the "
        f"medium seals at {100 * threshold:.4g} % contact; aperture 15 % too large at 2 % "
        "contact, 20 to 25 % at 6 %, 30 to 45 % at 13 % and 1.8 to 2.8 times as large at 28 %, in "
        "the mean over surfaces; area and mean gap are those of Persson's theory",
    )


@public
def effective_medium(gap: ArrayLike, threshold: float = _SEALING_SHARE) -> float:
    """Hydraulic aperture of a gap in Bruggeman's effective medium, which asks how wide, not where.

    The conductance sigma = u³ of the medium solves
    ``<(u³ - sigma) / (u³ + (d - 1) sigma)> = 0``, with d = 1 / (1 - threshold).

    Parameters
    ----------
    gap : array_like
        Gap of cells of one size, 0 where there is contact, such as ``rl.flow(...).gap``. [length]
    threshold : float, optional
        Share of contact at which the medium seals: 0.5 is Bruggeman's medium in two dimensions,
        d = 2, and 0.42 that of isotropic elastic contacts. [1]

    Returns
    -------
    float
        Hydraulic aperture, the gap of two flat plates that let as much through; 0 where the share
        of contact is the threshold or more. [length]

    Raises
    ------
    InputError
        If a gap is negative or not finite, there is none, or the threshold is not between 0 and 1.

    References
    ----------
    B. Lorenz and B. N. J. Persson, Eur. Phys. J. E 31, 159-167 (2010).

    Examples
    --------
    >>> import roughline as rl
    >>> gap = [[0.0, 1.0], [1.0, 1.0]]  # a share of contact c leaves 1 - 2 c of the flow
    >>> round(rl.effective_medium(gap), 4)
    0.7937
    """
    gaps = np.asarray(gap, dtype=np.float64).ravel()
    if not gaps.size:
        refuse("gap", gap, "at least one cell is needed")
    wrong = ~((gaps >= 0) & np.isfinite(gaps))
    if wrong.any():
        refuse("gap", float(gaps[wrong][0]), "finite gaps of 0 or more are needed")
    check_threshold(threshold)
    return _effective_gap(gaps, np.full(gaps.size, 1 / gaps.size), threshold)


def check_threshold(threshold: float) -> None:
    """Refuse a share of contact that is not between 0 and 1."""
    if not 0 < threshold < 1:
        refuse("threshold", threshold, "a share of contact between 0 and 1 is needed")


def _effective_gap(gaps: Real, shares: Real, threshold: float) -> float:
    """Gap of the medium of gaps on their shares of the interface; what they leave is contact.

    With d = 1 / (1 - threshold) the equation is <u³ / (u³ + (d - 1) sigma)> = 1 / d. Its left side
    falls and is convex in sigma, so that its tangent at 0 meets 1 / d below the root.
    """
    widest = float(gaps.max(initial=0.0))
    if widest == 0:
        return 0.0
    conductance = (gaps / widest) ** 3
    is_open = conductance > _SMALLEST_CONDUCTANCE
    conductance, shares = conductance[is_open], shares[is_open]
    excess = float(shares.sum()) - (1 - threshold)
    if excess <= _SHARE_ROUNDING:
        return 0.0
    odds = threshold / (1 - threshold)  # d - 1
    lowest = excess / (odds * float((shares / conductance).sum()))

    def imbalance(logarithm: float) -> float:
        medium = odds * math.exp(logarithm)
        wider = conductance > medium  # whole shares first, as terms far below them would be lost
        parts = np.where(wider, -medium, conductance) / (conductance + medium)
        return float(shares[wider].sum()) - (1 - threshold) + float((shares * parts).sum())

    root = optimize.brentq(imbalance, math.log(lowest) - 1e-9, 1e-9, xtol=1e-14)
    return widest * math.exp(root / 3)
