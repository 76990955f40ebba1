"""Persson's interfacial separation, magnification by magnification.

Seen at a magnification zeta, which shows the waves up to zeta q_0, the bodies seem to touch on a
share A(zeta) / A_0 of the interface. Where they cease to do so as the magnification rises, the
shorter waves leave the average separation u_1(zeta) between them.

References
----------
.. [1] C. Yang and B. N. J. Persson, "Contact mechanics: contact area and interfacial separation
   from small contact to full contact", J. Phys.: Condens. Matter 20, 215214 (2008).
.. [2] B. N. J. Persson and C. Yang, "Theory of the leak-rate of seals", J. Phys.: Condens. Matter
   20, 315011 (2008).
"""

from __future__ import annotations

import math

import numpy as np
from scipy import special

from roughline.computing.arrays import Real
from roughline.spectra.moments import Bands
from roughline.theories.persson import energy_density, energy_tail, stress_nodes


def separation(spectrum: Bands, E_star: float, pressure: float, share: Real) -> Real:
    """Separation u_1 at the magnifications that show contact on given shares of the interface.

    u_1 = u + u' A / A', where u(zeta) is the mean gap that the waves beyond zeta q_0 leave in the
    apparent contact, under its pressure p A_0 / A(zeta). So u_1 = d(u A) / dA, and the integral of
    u_1 over all shares from the real contact to 1 is the mean gap.

    With t² = pi int q³ C dq up to zeta q_0 and tau² the same beyond it, P = p / (E* A / A_0), and
    F(x) the integral of g(s) / s from x to infinity, u is 2 / sqrt(pi) int F(P / tau) / q dtau. Its
    derivative with t² is a sum, as q rises in steps from band to band.
    """
    p = pressure / E_star
    steps = 1 / spectrum.q - np.append(1 / spectrum.q[1:], 0.0)
    found = np.zeros(share.size)
    for i, A in enumerate(share):
        x = float(special.erfinv(A))  # p / t
        t, P = p / x, p / A
        with np.errstate(divide="ignore"):  # the bands of the waves that are seen have tau = 0
            ends, tau, weight = stress_nodes(spectrum, seen=t**2)
            u_and_fall = (weight * (energy_tail(P / tau) + energy_density(P / tau))).sum()
            is_shorter = ends > 0
            of_waves = (energy_tail(P / ends) * steps)[is_shorter] / (2 * ends[is_shorter])
        for_loss = math.exp(x**2) * t**2 / x  # t² rises by so much over sqrt(pi) as A is lost
        found[i] = u_and_fall + 2 * A * for_loss * of_waves.sum()
    return found
