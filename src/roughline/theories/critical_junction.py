"""Persson and Yang's critical junction: all fluid pressure drops over the narrowest constriction.

References
----------
.. [1] B. N. J. Persson and C. Yang, "Theory of the leak-rate of seals", J. Phys.: Condens. Matter
   20, 315011 (2008).
.. [2] W. B. Dapp, A. Lücke, B. N. J. Persson and M. H. Müser, "Self-affine elastic contacts:
   percolation and leakage", PRL 108, 244301 (2012).
"""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from roughline.computing.arrays import Real
from roughline.spectra.moments import Bands
from roughline.theories.interfacial_separation import separation
from roughline.theories.persson import persson
from roughline.theories.theory_curve import TheoryCurve

_PERCOLATION_SHARE = 0.42  # of contact of isotropic elastic surfaces: no channel is left [2]


def critical_junction(
    spectrum: Bands, E_star: float, pressure: Real, threshold: float = _PERCOLATION_SHARE
) -> TheoryCurve:
    """Flow through one square constriction, of the gap u_c that the critical magnification shows.

    As the magnification zeta rises, less and less of the interface seems to touch. Where
    A(zeta_c) / A_0 is the threshold the first channel opens, and u_c = u_1(zeta_c) is its gap.
    """
    of_persson = persson(spectrum, E_star, pressure)
    aperture = np.zeros(pressure.size)
    for i in np.flatnonzero(of_persson.area_fraction < threshold):
        aperture[i] = separation(spectrum, E_star, pressure[i], np.array([threshold]))[0]
    return replace(
        of_persson,
        name="critical-junction",
        stiffness=None,
        hydraulic_aperture=aperture,
        validity=f"Gaussian random surfaces, isotropic, that seal at {100 * threshold:.4g} % "
        "contact; aperture 20 % too large at 2 % contact, a third at 6 %, half at 13 % and 2 to "
        "2.7 times as large at 28 %, in the mean over surfaces; area and mean gap are those of "
        "Persson's theory",
    )
