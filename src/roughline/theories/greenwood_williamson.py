"""Greenwood and Williamson's theory: independent spheres on the summits of a surface.

References
----------
.. [1] J. A. Greenwood and J. B. P. Williamson, Proc. R. Soc. A 295, 300-319 (1966).
.. [2] J. I. McCool, Wear 107, 37-60 (1986).
"""

from __future__ import annotations

import math

import numpy as np
from scipy import special

from roughline.computing.arrays import Real
from roughline.errors import InputError
from roughline.spectra.moments import Bands, moments
from roughline.theories.theory_curve import TheoryCurve


def greenwood_williamson(spectrum: Bands, E_star: float, pressure: Real) -> TheoryCurve:
    """Greenwood and Williamson's independent spheres, with summits after Nayak and McCool."""
    of_surface = moments(spectrum)
    density, radius = of_surface.summit_density, of_surface.summit_radius
    deviation = of_surface.summit_deviation
    t = np.linspace(-3.0, 12.0, 3000)  # separation over the deviation of the summits
    scale = density * E_star * math.sqrt(radius)
    force = 4 / 3 * scale * deviation**1.5 * _moment_above(1.5, t)
    if pressure.max() > force[0]:
        limit = f"{force[0] / E_star:.3g} E*"
        raise InputError(
            f"greenwood-williamson has no answer at pressures over {limit}, where its mean planes "
            "cross: leave it out, or take lighter loads"
        )
    separation = np.interp(-np.log(pressure), -np.log(force), t)
    return TheoryCurve(
        "greenwood-williamson",
        pressure,
        math.pi * density * radius * deviation * _moment_above(1.0, separation),
        2 * scale * math.sqrt(deviation) * _moment_above(0.5, separation),
        of_surface.summit_mean + deviation * separation,
        "light loads; spheres of one radius that do not interact; poor for wide spectra, "
        f"here Nayak's parameter is {of_surface.nayak:.3g}",
    )


def _moment_above(power: float, t: Real) -> Real:
    """Integrate (s - t)^n over the standard normal density from t to infinity."""
    parabolic_cylinder = special.pbdv(-power - 1, t)[0]
    factor = special.gamma(power + 1) / math.sqrt(2 * math.pi)
    return factor * np.exp(-(t**2) / 4) * parabolic_cylinder
