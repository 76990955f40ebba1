"""Analytical theories of rough contact by their names, to be compared with the full model.

They neglect the edges of the half-space: they hold per nominal area, for periodic or very large
surfaces.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace

import numpy as np
from numpy.typing import ArrayLike

from roughline.computing.arrays import Real
from roughline.errors import InputError
from roughline.errors.checks import one_of, positive, refuse
from roughline.errors.public import public
from roughline.spectra.moments import SurfaceOrSpectrum, of_the_continuum, refuse_no_roughness
from roughline.theories.bruggeman import bruggeman, check_threshold
from roughline.theories.bush_gibson_thomas import bush_gibson_thomas
from roughline.theories.critical_junction import critical_junction
from roughline.theories.greenwood_williamson import greenwood_williamson
from roughline.theories.persson import persson
from roughline.theories.theory_curve import TheoryCurve

_OF_FLOW = {"critical-junction": critical_junction, "bruggeman": bruggeman}
"""Theories of the flow through the gap; each seals at a threshold that may be given."""

THEORIES: dict[str, Callable[[SurfaceOrSpectrum, float, Real], TheoryCurve]] = {
    "persson": persson,
    "bush-gibson-thomas": bush_gibson_thomas,
    "greenwood-williamson": greenwood_williamson,
    **_OF_FLOW,
}
"""Every theory, by its name."""


@public
def theory(
    name: str,
    roughness: SurfaceOrSpectrum,
    E_star: float,
    pressure: ArrayLike,
    threshold: float | None = None,
) -> TheoryCurve:
    """Evaluate a theory for a surface or a spectrum.

    Parameters
    ----------
    name : {"persson", "bush-gibson-thomas", "greenwood-williamson", "critical-junction", \
"bruggeman"}
        Name of the theory; the last two are of the flow through the gap.
    roughness : Surface, LatticeSpectrum, IsotropicSpectrum, ContinuumSpectrum or SelfAffine
        A surface, for its own waves; ``spectrum.lattice(n)``, for those of generated surfaces;
        ``spectrum.continuum``, or the spectrum itself, for integrals up to ``q_high``. Where the
        integrals of a SelfAffine are more than 5 % off its surfaces, ``validity`` says so. [length]
    E_star : float
        Contact modulus. [pressure]
    pressure : array_like, shape (loads,)
        Mean pressures over the nominal area. [pressure]
    threshold : float, optional
        Of theories of flow, the share of contact at which no channel is left: 0.42 for
        "critical-junction" and 0.5, which is d = 2, for "bruggeman" unless given. Bruggeman's d is
        1 / (1 - threshold). [1]

    Raises
    ------
    InputError
        If there is no theory of that name, a pressure is not positive, the spectrum has no
        upper end, or a threshold is not between 0 and 1 or given to a theory that has none.

    Examples
    --------
    >>> import roughline as rl
    >>> surface = rl.SelfAffine(hurst=0.8, rms_height=0.01, q_roll=25.0).surface(64, rng=7)
    >>> persson = rl.theory("persson", surface, E_star=1.0, pressure=[1e-3, 1e-2])
    >>> print(persson.area_fraction.round(4), persson.stiffness.round(3))
    [0.0036 0.0356] [0.19  1.887]
    >>> junction = rl.theory("critical-junction", surface, E_star=1.0, pressure=[1e-2, 1e-1])
    >>> print(junction.hydraulic_aperture.round(4))
    [0.014  0.0003]
    """
    one_of("name", name, THEORIES)
    refuse_no_roughness(roughness)
    positive("E_star", E_star, "a positive, finite contact modulus is needed")
    pressures = np.atleast_1d(np.asarray(pressure, dtype=np.float64))
    if not ((pressures > 0) & np.isfinite(pressures)).all():
        raise InputError(f"pressures must be positive and finite; {pressures.min()} is among them")
    if threshold is None:
        curve = THEORIES[name](roughness, E_star, pressures)
    else:
        if name not in _OF_FLOW:
            refuse(
                "threshold", threshold, f"theories of flow alone have one: {' and '.join(_OF_FLOW)}"
            )
        check_threshold(threshold)
        curve = _OF_FLOW[name](roughness, E_star, pressures, threshold)
    return replace(curve, validity=curve.validity + of_the_continuum(roughness))
