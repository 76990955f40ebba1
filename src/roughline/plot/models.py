"""Pictures of both models on the same roughness, and of where the reduced one may be trusted."""

from __future__ import annotations

from typing import Any

import matplotlib as mpl
import numpy as np
from matplotlib.axes import Axes
from matplotlib.colors import BoundaryNorm, ListedColormap
from matplotlib.ticker import PercentFormatter

from roughline.comparison.models import Comparison
from roughline.comparison.trust import TrustMap
from roughline.comparison.trust import trust_map as published_map
from roughline.computing.arrays import Real
from roughline.errors import InputError
from roughline.errors.public import public
from roughline.plot.style import FORCE_LABEL, OPEN, SHADE, colours, drawing_on

_DIFFERENCE_LABEL = "$k_{3D} / k_{1D} - 1$"

TRUST_LEVELS = (-0.3, -0.2, -0.1, -0.05, 0.05, 0.1, 0.2, 0.3, 0.4)
"""Differences at which the colour of the trust map changes."""


@public
def comparison(compared: Comparison, axes: Axes | None = None) -> Axes:
    """Draw the stiffness of both models over the force.

    Parameters
    ----------
    compared : Comparison
        What :func:`roughline.compare` returned.
    axes : Axes, optional
        Where to draw; default: those of a new figure.

    Returns
    -------
    Axes
        The axes that were drawn on; bands are 95 % intervals.
    """
    count, (dark, light) = compared.surfaces, colours(2)
    surfaces = f"mean of {count} surfaces" if count > 1 else "one surface"
    with drawing_on(axes) as drawn:
        for mean, colour, label in (
            (compared.full, dark, f"full model, {surfaces}"),
            (compared.reduced, light, f"reduced model, mean of {compared.lines} lines"),
        ):
            force = compared.force_bar
            drawn.loglog(force, mean.mean, color=colour, marker="o", label=label)
            drawn.fill_between(force, mean.low, mean.high, color=colour, alpha=0.25, linewidth=0)
        drawn.set(xlabel=FORCE_LABEL, ylabel=r"raw stiffness $k\,/\,(E^* L)$")
        drawn.legend()
    return drawn


@public
def difference(compared: Comparison, tolerance: float = 0.1, axes: Axes | None = None) -> Axes:
    """Draw the relative difference of the stiffness of the full model from the reduced one's.

    Parameters
    ----------
    compared : Comparison
        What :func:`roughline.compare` returned.
    tolerance : float, optional
        Difference that is accepted; shaded. [1]
    axes : Axes, optional
        Where to draw; default: those of a new figure.

    Returns
    -------
    Axes
        The axes that were drawn on; the band is the 95 % interval, and marks are open where fewer
        than ten cells touch.
    """
    force, (colour, _) = compared.force_bar, colours(2)
    with drawing_on(axes) as drawn:
        drawn.axhspan(-tolerance, tolerance, **SHADE)
        drawn.axhline(0, color="k", linewidth=0.7)
        drawn.fill_between(
            force, compared.low, compared.high, color=colour, alpha=0.25, linewidth=0
        )
        drawn.semilogx(force, compared.difference, color=colour)
        for sure, look in ((compared.resolved, {}), (~compared.resolved, OPEN)):
            drawn.semilogx(force[sure], compared.difference[sure], "o", color=colour, **look)
        drawn.yaxis.set_major_formatter(PercentFormatter(1, decimals=0))
        drawn.set(xlabel=FORCE_LABEL, ylabel=_DIFFERENCE_LABEL)
    return drawn


@public
def trust_map(
    roll_off_ratio: float = 1.0, trust: TrustMap | None = None, axes: Axes | None = None
) -> Axes:
    """Draw the difference of the two models over load and fractal dimension.

    Parameters
    ----------
    roll_off_ratio : float, optional
        q_roll / q_low, one of the values that the map has; 1 without a roll-off.
    trust : TrustMap, optional
        Default: the map that comes with the package.
    axes : Axes, optional
        Where to draw; default: those of a new figure.

    Returns
    -------
    Axes
        The axes that were drawn on; hatched where fewer than ten cells touch in some surface.

    Raises
    ------
    InputError
        If the map has no such roll-off.
    """
    trust = published_map() if trust is None else trust
    (found,) = np.nonzero(np.isclose(trust.roll_off_ratios, roll_off_ratio))
    if not found.size:
        known = ", ".join(f"{ratio:g}" for ratio in trust.roll_off_ratios)
        raise InputError(f"roll_off_ratio is {roll_off_ratio:g}; the map has {known}")
    with drawing_on(axes) as drawn:
        mesh = draw_trust(drawn, trust, int(found[0]))
        drawn.set(xlabel=FORCE_LABEL, ylabel="fractal dimension $D_f$")
        add_bar(drawn, mesh)
    return drawn


def draw_trust(axes: Axes, trust: TrustMap, roll_off: int) -> Any:
    """Draw the map at the roll-off with this index; return the image for the colour bar."""
    levels = np.array(TRUST_LEVELS)
    scale = ListedColormap(trust_colours())
    norm = BoundaryNorm(levels, levels.size + 1, extend="both")
    over = (trust.force_bars, trust.fractal_dimensions)
    mesh = axes.pcolormesh(*over, trust.difference[roll_off], cmap=scale, norm=norm)
    axes.contourf(
        *over, trust.resolved[roll_off], levels=[-1, 0.5], colors="none", hatches=["////"]
    )
    axes.set(xscale="log", title=f"$q_r/q_0$ = {trust.roll_off_ratios[roll_off]:g}")
    return mesh


def add_bar(axes: Any, mesh: Any) -> None:
    """Add the bar of a trust map's colours beside axes."""
    figure = np.ravel(axes)[0].figure
    bar = figure.colorbar(mesh, ax=axes, label=_DIFFERENCE_LABEL, ticks=np.array(TRUST_LEVELS))
    bar.ax.yaxis.set_major_formatter(PercentFormatter(1, decimals=0))


def trust_colours() -> Real:
    """Return the colours below, between and above the levels of the trust map, shape (10, 4)."""
    # colours change in equal steps on both sides of white, where the models agree
    steps = np.concatenate([np.linspace(0.1, 0.4, 4), [0.5], np.linspace(0.6, 0.95, 5)])
    return mpl.colormaps["RdBu_r"](steps)
