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
from roughline.errors.checks import allowed_choice, positive, refuse
from roughline.errors.public import public
from roughline.halfspace.elasticity.half_space import HalfSpace
from roughline.halfspace.elasticity.homogeneous import Homogeneous
from roughline.spectra.moments import (
    SurfaceOrSpectrum,
    bands,
    continuum_note,
    refuse_no_roughness,
)
from roughline.theories.bruggeman import bruggeman, check_threshold
from roughline.theories.bush_gibson_thomas import bush_gibson_thomas
from roughline.theories.critical_junction import critical_junction
from roughline.theories.greenwood_williamson import greenwood_williamson
from roughline.theories.layers import (
    HOLDS_UP_TO,
    effective_roughness,
    is_even,
    on_layers,
    stiffening,
)
from roughline.theories.persson import persson
from roughline.theories.theory_curve import TheoryCurve

_FLOW_THEORIES = {"critical-junction": critical_junction, "bruggeman": bruggeman}
"""Theories of the flow through the gap; each seals at a threshold that may be given."""

THEORIES: dict[str, Callable[..., TheoryCurve]] = {
    "persson": persson,
    "bush-gibson-thomas": bush_gibson_thomas,
    "greenwood-williamson": greenwood_williamson,
    **_FLOW_THEORIES,
}
"""Every theory, by its name."""

ONE_MATERIAL_ONLY = ("bush-gibson-thomas", "greenwood-williamson")
"""Theories of summits as spheres, which have no solution on layers."""


@public
def theory(
    name: str,
    roughness: SurfaceOrSpectrum,
    E_star: float | None = None,
    pressure: ArrayLike | None = None,
    threshold: float | None = None,
    *,
    half_space: HalfSpace | None = None,
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
    E_star : float, optional
        Contact modulus. [pressure]
    pressure : array_like, shape (loads,)
        Mean pressures over the nominal area. [pressure]
    threshold : float, optional
        Of theories of flow, the share of contact at which no channel is left: 0.42 for
        "critical-junction" and 0.5, which is d = 2, for "bruggeman" unless given. Bruggeman's d is
        1 / (1 - threshold). [1]
    half_space : HalfSpace, optional
        What the roughness is pressed into, in place of `E_star`, such as :class:`roughline.Layered`
        for "persson" and what rests on it; ``validity`` says how far that holds.

    Raises
    ------
    InputError
        If there is no theory of that name, a pressure is not positive, the spectrum has no
        upper end, a threshold is not between 0 and 1 or given to a theory that has none, or a
        half-space has layers, of which the theory is not.

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
    allowed_choice("name", name, THEORIES)
    refuse_no_roughness(roughness)
    elastic = _checked_half_space(E_star, half_space)
    pressures = _pressures(pressure)
    if threshold is not None:
        _refuse_threshold(name, threshold)
    spectrum = bands(roughness)
    ratio = stiffening(spectrum, elastic)
    if name in ONE_MATERIAL_ONLY and not is_even(ratio):
        raise InputError(
            f"has layers, and the summits of {name} are spheres of one material: leave it out, or "
            'take "persson"',
            "half_space",
        )
    others = () if threshold is None else (threshold,)
    curve = THEORIES[name](
        effective_roughness(spectrum, elastic), elastic.E_star, pressures, *others
    )
    remark = continuum_note(roughness) + on_layers(ratio)
    return replace(curve, validity=curve.validity + remark)


def why_not(name: str, roughness: SurfaceOrSpectrum, half_space: HalfSpace) -> str:
    """Say why a theory does not hold of the layers of a half-space; empty where it does."""
    ratio = stiffening(bands(roughness), half_space)
    if is_even(ratio):
        return ""
    if name in ONE_MATERIAL_ONLY:
        return "its summits are spheres of one material, and one body is coated"
    if ratio > HOLDS_UP_TO:
        return (
            f"the layers meet these waves {ratio:.2g} times as stiffly as the top one alone, and "
            f"the theory was found to hold up to {HOLDS_UP_TO:g}"
        )
    return ""


def _checked_half_space(E_star: float | None, half_space: HalfSpace | None) -> HalfSpace:
    """What waves feel: that of a half-space, or a contact modulus."""
    if half_space is None:
        needed = "a positive, finite contact modulus is needed"
        return Homogeneous(positive("E_star", E_star, needed))
    if E_star is not None:
        raise InputError("half_space and E_star are given; the half-space has a modulus of its own")
    if not isinstance(half_space, HalfSpace):
        refuse("half_space", half_space, "an rl.HalfSpace is needed, such as rl.Layered(...)")
    return half_space


def _refuse_threshold(name: str, threshold: float) -> None:
    """Refuse a threshold of a theory that has none, or one that is no share."""
    if name not in _FLOW_THEORIES:
        refuse(
            "threshold",
            threshold,
            f"theories of flow alone have one: {' and '.join(_FLOW_THEORIES)}",
        )
    check_threshold(threshold)


def _pressures(given: ArrayLike | None) -> Real:
    """Mean pressures, positive and finite."""
    if given is None:
        raise InputError("theory needs pressure=; give it")
    pressures = np.atleast_1d(np.asarray(given, dtype=np.float64))
    if not ((pressures > 0) & np.isfinite(pressures)).all():
        raise InputError(f"pressures must be positive and finite; {pressures.min()} is among them")
    return pressures
