"""Figures of one topography: its heights, its spectrum, its curve, and its contact."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import numpy as np
from matplotlib.axes import Axes
from matplotlib.colors import ListedColormap
from matplotlib.figure import Figure
from numpy.typing import NDArray

from roughline.assessment.assessment import Assessment
from roughline.assessment.slip import PartialSlip
from roughline.computing.arrays import Real
from roughline.contact.curve import Curve
from roughline.engineering.intervals import Ends
from roughline.report.folder import make_folder
from roughline.report.pixels import any_marked, thinned
from roughline.report.style import PAGE, label_decades, new_figure, save, styled
from roughline.spectra.isotropic import IsotropicSpectrum
from roughline.spectra.roughness import Roughness
from roughline.topography.body import Body, Surface
from roughline.units import decimal, engineering, prefix

_GAP_ELASTIC_PLASTIC = ListedColormap(["white", "black", "tab:red"])
_DASHES = ("--", ":", "-.")


def write_contact(assessment: Assessment, out: Path) -> list[Path]:
    """Write ``curve.nc``, and figures of the curve and of the contact.

    Parameters
    ----------
    assessment : Assessment
        With the fields of the load to be shown, if it is of a surface.
    out : Path
        Folder; made if it does not exist.

    Returns
    -------
    list of Path
        The files.

    Raises
    ------
    StoreError
        If the folder cannot be written.
    """
    make_folder(out)
    replace(assessment.curve, fields=()).write(out / "curve.nc")
    written = [out / "curve.nc"]
    with styled():
        written += save(curve_figure(assessment), out, "curve")
        if isinstance(assessment.body, Surface):
            written += save(contact_figure(assessment.body, assessment), out, "contact")
    return written


def curve_figure(assessment: Assessment) -> Figure:
    """Force over depth, and stiffness over force; open marks where the grid decides."""
    figure = new_figure(PAGE, 3.0)
    left, right = figure.subplots(1, 2)
    draw_force(left, assessment)
    draw_stiffness(right, assessment)
    return figure


def contact_figure(surface: Surface, assessment: Assessment) -> Figure:
    """Topography, and the real contact area at the last load whose fields are there."""
    figure = new_figure(PAGE, 3.2)
    left, right = figure.subplots(1, 2)
    draw_heights(left, surface)
    draw_filled(left, assessment)
    draw_contact(right, surface, assessment)
    return figure


def roughness_figure(body: Body, parameters: Roughness) -> Figure:
    """Heights, and the spectrum with the law that is nearest to it."""
    figure = new_figure(PAGE, 3.2)
    left, right = figure.subplots(1, 2)
    draw_heights(left, body)
    draw_spectrum(right, parameters)
    return figure


def draw_force(axes: Axes, assessment: Assessment) -> None:
    """Force over depth; where loads fall, on linear scales, which show both ways and the dent."""
    curve, falls = assessment.curve, has_falling_loads(assessment)
    depth_unit, depth = _prefixed(curve.depth, "m")
    force_unit, force = _prefixed(curve.force, "N", assessment.scale)
    _draw_loads(axes, curve.depth * depth, curve.force * force, curve, linear=falls)
    axes.set(
        xlabel=f"depth since touch $d$ [{depth_unit}]", ylabel=_force_label(assessment, force_unit)
    )
    if falls:
        axes.plot([], [], "o", color="tab:blue", label="after a larger load")
        axes.legend()


def draw_stiffness(axes: Axes, assessment: Assessment) -> None:
    """Stiffness over force with its interval, and theories beside it; of the joint, if given."""
    curve, area, scale = assessment.curve, assessment.area, assessment.scale
    force_unit, force = _prefixed(curve.force, "N", scale)
    unit, stiffness = _prefixed(curve.stiffness, "N/m", scale)
    _draw_loads(axes, curve.force * force, curve.stiffness * stiffness, curve)
    _draw_interval(axes, curve, assessment.stiffness_interval, (force, stiffness))
    if curve.hardness is not None and curve.unloading_stiffness is not None:
        rising = _rising(curve)
        unloading = curve.unloading_stiffness[rising] * stiffness
        symbol = "k_u" if assessment.question.joint is None else "k_i"
        label = f"unloading ${symbol}$"
        axes.loglog(curve.force[rising] * force, unloading, "--.", color="tab:red", label=label)
        _draw_interval(axes, curve, assessment.unloading_interval, (force, stiffness), "tab:red")
        axes.legend()
    for theory, dashes in zip(assessment.theories, _DASHES, strict=False):
        if theory.stiffness is not None:
            axes.plot(
                theory.pressure * area * force,
                theory.stiffness * area * stiffness,
                dashes,
                label=theory.name,
            )
            axes.legend()
    symbol = "k_i" if assessment.question.joint and curve.hardness is None else "k"
    axes.set(xlabel=_force_label(assessment, force_unit), ylabel=f"stiffness ${symbol}$ [{unit}]")


def draw_area(axes: Axes, assessment: Assessment) -> None:
    """Contact area over force with its interval, and theories beside it."""
    curve, area = assessment.curve, assessment.area
    assert curve.area_fraction_corrected is not None
    force_unit, force = _prefixed(curve.force, "N", assessment.scale)
    _draw_loads(axes, curve.force * force, curve.area_fraction_corrected, curve)
    _draw_interval(axes, curve, assessment.area_interval, (force, 1.0))
    for theory, dashes in zip(assessment.theories, _DASHES, strict=False):
        axes.plot(theory.pressure * area * force, theory.area_fraction, dashes, label=theory.name)
        axes.legend()
    axes.set(xlabel=_force_label(assessment, force_unit), ylabel="contact area $A/A_0$")


def draw_partial_slip(axes: Axes, slip: PartialSlip | None) -> None:
    """Tangential force over displacement at the largest load, until the whole contact slides."""
    if slip is None:
        axes.text(0.5, 0.5, "largest load not solved", ha="center", transform=axes.transAxes)
        return
    x_unit, x = _prefixed(slip.displacement, "m")
    y_unit, y = _prefixed(slip.force, "N")
    axes.plot(slip.displacement * x, slip.force * y, color="k")
    axes.set(
        xlabel=f"slip displacement $u_x$ [{x_unit}]", ylabel=f"tangential force $Q$ [{y_unit}]"
    )


def draw_heights(axes: Axes, body: Body) -> None:
    """Heights about their mean."""
    height_unit, factor = _prefixed(body.heights - body.heights.mean(), "m")
    heights = (body.heights - body.heights.mean()) * factor
    if not isinstance(body, Surface):
        unit, size = _prefixed(np.array([body.length]), "m")
        x = (np.arange(heights.size) + 0.5) * body.spacing * size
        axes.plot(x, heights, color="k", linewidth=0.6)
        axes.set(xlabel=f"x [{unit}]", ylabel=f"height [{height_unit}]")
        return
    shown = axes.imshow(thinned(heights).T, origin="lower", extent=_extent(body), cmap="cividis")
    assert axes.figure is not None
    axes.figure.colorbar(shown, ax=axes, label=f"height [{height_unit}]", shrink=0.85)
    _label_sides(axes, body)


def draw_filled(axes: Axes, assessment: Assessment) -> None:
    """Mark on a map of heights where points were missing and have been filled."""
    if not isinstance(assessment.body, Surface):
        return
    _, size = _prefixed(np.array(assessment.body.sizes), "m")
    bounds = axes.axis()
    for i, part in enumerate(assessment.topographies):
        marks = part.filled_region
        if isinstance(marks, Surface) and 0 < marks.heights.mean() < 1:
            # the second of two bodies is turned over
            shown = any_marked(marks.heights if i == 0 else marks.heights[::-1])
            x, y = (
                (np.arange(n) + 0.5) / n * side * size
                for n, side in zip(shown.shape, marks.sizes, strict=True)
            )
            axes.contourf(x, y, shown.T, levels=[0.5, 1], colors="tab:red", alpha=0.3)
            axes.contour(x, y, shown.T, levels=[0.5], colors="tab:red", linewidths=0.7)
    axes.axis(bounds)


def draw_contact(axes: Axes, surface: Surface, assessment: Assessment) -> None:
    """Real contact area at the last load whose fields are there; red where it yields."""
    curve = assessment.curve
    _label_sides(axes, surface)
    for i in range(len(curve.fields) - 1, -1, -1):
        fields = curve.fields[i]
        if fields is None:
            continue
        axes.imshow(
            fields.contact.T.astype(int) + fields.plastic.T,
            origin="lower",
            extent=_extent(surface),
            cmap=_GAP_ELASTIC_PLASTIC,
            vmin=0,
            vmax=2,
            interpolation="nearest",
        )
        assert curve.area_fraction_corrected is not None
        share = decimal(100 * curve.area_fraction_corrected[i], 4)
        force = engineering(curve.force[i] * assessment.scale, "N")
        key = "\nred: at the hardness" if fields.plastic.any() else ""
        axes.set_title(f"corrected area {share}% at {force}{key}", fontsize=8)
        return


def draw_spectrum(axes: Axes, parameters: Roughness) -> None:
    """Spectrum C_2d of a surface or C_profile of a line, and the self-affine law."""
    spectrum, fit, power = parameters.spectrum, parameters.fit, parameters.power
    if spectrum is None or power is None:
        axes.text(0.5, 0.5, "no spectrum", ha="center", transform=axes.transAxes)
        return
    of_surface = isinstance(spectrum, IsotropicSpectrum)
    known = power > 0
    axes.loglog(spectrum.q[known], power[known], ".", color="0.4", markersize=2)
    if parameters.law is not None:
        axes.loglog(*parameters.law, color="tab:red")
    label_decades(axes)
    symbol = "$C_{2d}$ [m⁴]" if of_surface else "$C_{profile}$ [m³]"
    axes.set(xlabel="wavenumber $q = 2\\pi/\\lambda$ [1/m]", ylabel=f"spectrum {symbol}")
    if fit is not None:
        low, high = fit.hurst_interval
        axes.set_title(f"H = {fit.hurst:.2f} ({low:.2f} to {high:.2f})", fontsize=9)


def has_falling_loads(assessment: Assessment) -> bool:
    """Whether a load is smaller than one before it."""
    return not bool(_rising(assessment.curve).all())


def _draw_loads(axes: Axes, x: Real, y: Real, curve: Curve, *, linear: bool = False) -> None:
    """Draw the loads of a curve in their order; those after a larger one in blue."""
    rising, resolved = _rising(curve), curve.resolved | (curve.force == 0)
    # on logarithmic scales bodies just apart have no place
    shown = np.isfinite(x * y) if linear else (x > 0) & (y > 0)
    draw = axes.plot if linear else axes.loglog
    draw(x[shown], y[shown], color="0.5", linewidth=0.8)
    for when, colour in ((rising, "k"), (~rising, "tab:blue")):
        for which, fill in ((resolved, "full"), (~resolved, "none")):
            points = shown & when & which
            draw(x[points], y[points], "o", color=colour, fillstyle=fill)
    if not linear:
        label_decades(axes)


def _draw_interval(
    axes: Axes, curve: Curve, ends: Ends | None, units: tuple[float, float], colour: str = "0.35"
) -> None:
    """Draw an interval over the force on loading; units are the factors of both axes."""
    if ends is not None:
        rising = _rising(curve)
        low, high = (end[rising] * units[1] for end in ends)
        x = curve.force[rising] * units[0]
        axes.fill_between(x, low, high, color=colour, alpha=0.2, linewidth=0, zorder=-5)


def _rising(curve: Curve) -> NDArray[np.bool_]:
    """Which loads are at least as large as all before them."""
    force = np.nan_to_num(curve.force)
    return force >= np.maximum.accumulate(force)


def _extent(surface: Surface) -> tuple[float, float, float, float]:
    _, size = _prefixed(np.array(surface.sizes), "m")
    return (0, surface.sizes[0] * size, 0, surface.sizes[1] * size)


def _label_sides(axes: Axes, surface: Surface) -> None:
    unit, _ = _prefixed(np.array(surface.sizes), "m")
    axes.set(xlabel=f"x [{unit}]", ylabel=f"y [{unit}]")


def _force_label(assessment: Assessment, unit: str) -> str:
    on = "" if assessment.question.joint is None else " on the joint"
    return f"force $F${on} [{unit}]"


def _prefixed(values: Real, unit: str, scale: float = 1.0) -> tuple[str, float]:
    """Choose a prefix for values times a scale; return the unit, and the factor to it.

    The values are in an SI unit, and the factor holds the scale.
    """
    factor, prefixed = prefix(scale * float(np.nanmax(np.abs(values), initial=0.0)), unit)
    return prefixed, factor * scale
