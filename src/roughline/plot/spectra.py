"""Pictures of spectra, and of power laws with their intervals."""

from __future__ import annotations

import numpy as np
from matplotlib.axes import Axes
from numpy.typing import ArrayLike

from roughline.errors import InputError
from roughline.errors.public import public
from roughline.measurement.roughness import Roughness, roughness
from roughline.plot.curves import quantity_name
from roughline.plot.style import SHADE, drawing_on, in_unit, label_decades, say
from roughline.spectra.isotropic import IsotropicSpectrum
from roughline.spectra.profile import ProfileSpectrum
from roughline.statistics.power_law import PowerLaw
from roughline.topography.body import Body

_ROUNDING_FACTOR = 1e4  # how far above that of rounding a spectrum is still rounding


@public
def spectrum(described: Body | Roughness, axes: Axes | None = None) -> Axes:
    """Draw the spectrum of a topography, with the self-affine law that is nearest to it.

    Parameters
    ----------
    described : Surface, Line or Roughness
        A topography, or its roughness where that is known already. A line is a profile.
    axes : Axes, optional
        Where to draw; default: those of a new figure.

    Returns
    -------
    Axes
        The axes that were drawn on: C_2d of a surface, C_profile of a line. The title gives the
        Hurst exponent with its interval. Waves that are no more than rounding of the heights, as
        a generated surface has beyond its cutoff, are left out.

    Raises
    ------
    InputError
        For a reduced line, which is no topography.
    """
    found = described if isinstance(described, Roughness) else roughness(described)
    unit = None if isinstance(described, Roughness) else described.unit
    with drawing_on(axes) as drawn:
        draw_spectrum(drawn, found, unit)
    return drawn


@public
def power_law(
    force_bar: ArrayLike,
    stiffness_bar: ArrayLike,
    law: PowerLaw,
    axes: Axes | None = None,
    *,
    x: str = "force_bar",
    y: str = "stiffness_bar",
) -> Axes:
    """Draw stiffness over force, or any quantity over another, with a fitted power law.

    Parameters
    ----------
    force_bar : array_like, shape (loads,)
        Dimensionless forces, or what `x` says.
    stiffness_bar : array_like, shape (loads,) or (realisations, loads)
        Dimensionless stiffness at these forces, or what `y` says. Of several realisations each is
        drawn, and their mean: arithmetic or geometric, as for the law.
    law : PowerLaw
        What :func:`roughline.fit_power_law` returned.
    axes : Axes, optional
        Where to draw; default: those of a new figure.
    x, y : str, optional
        What was fitted, for the labels: names of quantities over the loads, such as "force" and
        "area_fraction_corrected".

    Returns
    -------
    Axes
        The axes that were drawn on; the window of the fit is shaded.

    Raises
    ------
    InputError
        If there is no such quantity.
    """
    labels = [quantity_name(name) for name in (x, y)]
    force = np.asarray(force_bar, dtype=np.float64)
    stiffness = np.atleast_2d(np.asarray(stiffness_bar, dtype=np.float64))
    if force.ndim != 1 or stiffness.ndim != 2 or stiffness.shape[1] != force.size:
        raise InputError(
            f"force_bar has shape {force.shape} and stiffness_bar {np.shape(stiffness_bar)}; "
            "(loads,) and (loads,) or (realisations, loads) are needed"
        )
    with drawing_on(axes) as drawn:
        drawn.axvspan(*law.window, **SHADE)
        if stiffness.shape[0] > 1:
            drawn.loglog(force, stiffness.T, color="0.75", linewidth=0.5)
        drawn.loglog(force, _mean(stiffness, law), "ko")
        drawn.loglog(force, law(force), color="tab:red", linewidth=0.8, linestyle=":")
        window = np.array(law.window)
        drawn.loglog(window, law(window), color="tab:red")
        low, high = law.exponent_interval
        of = f", {law.realisations} realisations" if law.realisations > 1 else ""
        drawn.set_title(rf"$\alpha$ = {law.exponent:.3f} ({low:.3f} to {high:.3f}){of}", fontsize=9)
        drawn.set(xlabel=labels[0], ylabel=labels[1])
    return drawn


def draw_spectrum(axes: Axes, found: Roughness, unit: str | None) -> None:
    """Draw a spectrum and its law, where lengths have a given unit."""
    power = found.power
    if found.spectrum is None or power is None:
        say(axes, "no spectrum")
        return
    known = power > _ROUNDING_FACTOR * _rounding(found.spectrum, found.rms_height)
    axes.loglog(found.spectrum.q[known], power[known], ".", color="0.4", markersize=2)
    if found.law is not None:
        axes.loglog(*found.law, color="tab:red")
    label_decades(axes)
    of_surface = isinstance(found.spectrum, IsotropicSpectrum)
    symbol, power_unit = ("C_{2D}", "⁴") if of_surface else ("C_{profile}", "³")
    of_q, of_power = (f"1/{unit}", f"{unit}{power_unit}") if unit else (None, None)
    axes.set_xlabel(in_unit("wavenumber $q = 2\\pi/\\lambda$", 1.0, of_q)[0])
    axes.set_ylabel(in_unit(f"spectrum ${symbol}$", 1.0, of_power)[0])
    if found.fit is not None:
        axes.set_title(found.fit.in_words, fontsize=9)


def _rounding(spectrum: IsotropicSpectrum | ProfileSpectrum, rms_height: float) -> float:
    """Spectrum of heights that are nothing but rounding of others, on the same grid."""
    variance, q_last = (np.finfo(np.float64).eps * rms_height) ** 2, float(spectrum.q[-1])
    if isinstance(spectrum, IsotropicSpectrum):
        return variance / (4 * q_last**2)
    return variance / (2 * q_last)


def _mean(stiffness: np.ndarray, law: PowerLaw) -> np.ndarray:
    if law.averaging == "geometric":
        return np.exp(np.nanmean(np.log(stiffness), axis=0))
    return np.nanmean(stiffness, axis=0)
