"""Bush, Gibson and Thomas' theory: contact area in the limit of light loads.

References
----------
.. [1] A. W. Bush, R. D. Gibson and T. R. Thomas, "The elastic contact of a rough surface", Wear
   35, 87-111 (1975).
"""

from __future__ import annotations

import math

from roughline.computing.arrays import Real
from roughline.spectra.moments import Bands, moments
from roughline.theories.theory_curve import TheoryCurve

KAPPA = math.sqrt(2 * math.pi)  # contact area at light loads: A / A_0 = KAPPA p / (E* rms |grad h|)


def bush_gibson_thomas(spectrum: Bands, E_star: float, pressure: Real) -> TheoryCurve:
    """Asymptotic area of Bush, Gibson and Thomas, A / A_0 = sqrt(2 pi) p / (E* rms |grad h|)."""
    slope = moments(spectrum).rms_slope
    return TheoryCurve(
        "bush-gibson-thomas",
        pressure,
        KAPPA * pressure / (E_star * slope),
        None,
        None,
        "the limit of light loads, summits that do not interact; area too large beyond a "
        "fraction of about 1e-4",
    )
