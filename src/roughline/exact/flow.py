"""Flow through gaps of which the permeance per square is known, Lambda = 12 eta <j> / <grad P>.

Reynolds' flux per width is j = -u³ / (12 eta) grad P, so that two flat plates of the gap u have
Lambda = u³.

References
----------
.. [1] O. Reynolds, "On the theory of lubrication", Phil. Trans. R. Soc. 177, 157-234 (1886).
.. [2] Lord Rayleigh, "On the influence of obstacles arranged in rectangular order upon the
   properties of a medium", Phil. Mag. 34, 481-502 (1892).
.. [3] W. T. Perrins, D. R. McKenzie and R. C. McPhedran, "Transport properties of regular arrays of
   cylinders", Proc. R. Soc. A 369, 207-225 (1979).
.. [4] J. B. Keller, "A theorem on the conductivity of a composite medium", J. Math. Phys. 5,
   548-549 (1964).
.. [5] A. M. Dykhne, "Conductivity of a two-dimensional two-phase system", Sov. Phys. JETP 32, 63-65
   (1971).
.. [6] O. Wiener, Abh. Sächs. Akad. Wiss. 32, 509-604 (1912).
"""

from __future__ import annotations

from math import gamma, pi

import numpy as np
from scipy.special import comb

from roughline.exact._checks import Real, positive


def uniform(gap: float) -> float:
    """Permeance u³ of two flat plates. [length³]"""
    positive(gap=gap)
    return gap**3


def in_series(gaps: Real) -> float:
    """Permeance 1 / <u⁻³> of strips of one width that the flow crosses. [length³]"""
    positive(gaps=gaps)
    return float(1 / np.mean(np.asarray(gaps, dtype=np.float64) ** -3.0))


def in_parallel(gaps: Real) -> float:
    """Permeance <u³> of strips of one width along the flow. [length³]"""
    positive(gaps=gaps)
    return float(np.mean(np.asarray(gaps, dtype=np.float64) ** 3))


def along_a_wave(mean: float, amplitude: float) -> float:
    """Permeance u_0³ (1 + 3 e² / 2) of the gap u_0 (1 + e cos) along its crests. [length³]

    Parameters
    ----------
    mean : float
        u_0. [length]
    amplitude : float
        e, from 0 to below 1. [1]
    """
    positive(mean=mean, one_less_amplitude=1 - amplitude)
    return mean**3 * (1 + 1.5 * amplitude**2)


def across_a_wave(mean: float, amplitude: float) -> float:
    """Permeance u_0³ (1 - e²)^(5/2) / (1 + e² / 2) of the same gap across its crests. [length³]"""
    positive(mean=mean, one_less_amplitude=1 - amplitude)
    return mean**3 * (1 - amplitude**2) ** 2.5 / (1 + amplitude**2 / 2)


def wedge(inlet: float, outlet: float) -> float:
    """Permeance 2 u_1² u_2² / (u_1 + u_2) of a gap that is linear along the flow. [length³]

    Parameters
    ----------
    inlet, outlet : float
        u_1 and u_2. [length]
    """
    positive(inlet=inlet, outlet=outlet)
    return 2 * inlet**2 * outlet**2 / (inlet + outlet)


def disc_in_a_square_cell(radius: float, gap: float, terms: int = 40) -> float:
    """Permeance of a uniform gap with a round contact in each cell of a square lattice. [length³]

    Rayleigh's expansion about a disc, Re sum over odd l of (A_l z^l + B_l z^-l). No flow enters the
    disc: A_l = B_l / R^(2 l). The other discs and the mean gradient make up its regular part,
    A_l = delta_l1 - sum over m of comb(l + m - 1, l) S_(l + m) B_m, with the lattice's sums S_n of
    z^-n and S_2 = pi for a gradient along the lattice. Then Lambda / u³ = 1 - 2 pi B_1.

    Parameters
    ----------
    radius : float
        R over the side of the cell; below 1/2, where the discs meet. [1]
    gap : float
        u. [length]
    terms : int, optional
        Odd l that are kept. 40 leave an error of 1e-13 at R = 0.4; towards 1/2 more are needed.
    """
    positive(radius=radius, room_between_discs=0.5 - radius, gap=gap)
    order = 2 * np.arange(terms) + 1
    of, by = np.meshgrid(order, order, indexing="ij")
    others = comb(of + by - 1, of) * _lattice_sums(2 * terms)[(of + by) // 2] * radius ** (of + by)
    of_first = np.where(order == 1, radius, 0.0)
    amplitudes = np.linalg.solve(np.eye(terms) + others, of_first)  # B_l / R^l
    return float(gap**3 * (1 - 2 * pi * radius * amplitudes[0]))


def _lattice_sums(count: int) -> Real:
    """Sums S_2k of z^-2k over the points of the square lattice but its origin, k up to `count`.

    They are the coefficients of Weierstrass' function, c_k = (2 k - 1) S_2k, by its recurrence.
    """
    c = np.zeros(count + 1)
    c[2] = 3 * gamma(0.25) ** 8 / (960 * pi**2)
    for k in range(4, count + 1):
        c[k] = 3 * (c[2 : k - 1] @ c[k - 2 : 1 : -1]) / ((2 * k + 1) * (k - 3))
    sums = c / (2 * np.arange(count + 1) - 1)
    sums[1] = pi
    return sums


def dual_gap(gap: Real, reference: float) -> Real:
    """Gap a² / u of the dual flow, which lies along the lines of equal pressure. [length]

    Parameters
    ----------
    gap : ndarray
        u. [length]
    reference : float
        a, any length. [length]
    """
    positive(gap=gap, reference=reference)
    return reference**2 / np.asarray(gap, dtype=np.float64)


def dual_permeance(permeance: float, reference: float) -> float:
    """Permeance a⁶ / Lambda_x of :func:`dual_gap` along y, for that of the gap along x. [length³]

    It holds for a cell that is periodic both ways, and for one with two sides at a pressure and two
    that are closed (Keller, Dykhne).
    """
    positive(permeance=permeance, reference=reference)
    return reference**6 / permeance


def self_dual(gap: Real) -> float:
    """Permeance exp(3 <ln u>) of a gap that is statistically its own dual. [length³]

    So are isotropic log-normal gaps, all of which ln u lies alike about its mean, and a chessboard
    of two gaps (Dykhne).
    """
    positive(gap=gap)
    return float(np.exp(3 * np.mean(np.log(gap))))


def bounds(gap: Real) -> tuple[float, float]:
    """Wiener's bounds of the permeance along the first axis. [length³]

    The lower one has walls between the rows of cells along the flow, the upper one no resistance
    across it.

    Parameters
    ----------
    gap : ndarray, shape (along, across)
        Gap of cells; 0 is contact. [length]
    """
    with np.errstate(divide="ignore"):
        rows = 1 / np.mean(np.asarray(gap, dtype=np.float64) ** -3.0, axis=0)
        columns = np.mean(np.asarray(gap, dtype=np.float64) ** 3, axis=1) ** -1.0
    return float(np.mean(rows)), float(1 / np.mean(columns))
