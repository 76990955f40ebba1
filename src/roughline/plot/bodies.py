"""Pictures of topographies: heights over the plane or along a line."""

from __future__ import annotations

import numpy as np
from matplotlib.axes import Axes

from roughline.computing.arrays import Real
from roughline.errors.public import public
from roughline.plot.pixels import thinned
from roughline.plot.style import drawing_on
from roughline.plot.units import in_unit
from roughline.topography.body import Body, Surface


@public
def topography(body: Body, axes: Axes | None = None) -> Axes:
    """Draw the heights of a body about their mean.

    Parameters
    ----------
    body : Surface or Line
        What is drawn; a surface from above, in colours.
    axes : Axes, optional
        Where to draw; default: those of a new figure.

    Returns
    -------
    Axes
        The axes that were drawn on.
    """
    with drawing_on(axes) as drawn:
        draw_heights(drawn, body, body.unit)
    return drawn


def draw_heights(axes: Axes, body: Body, unit: str | None) -> None:
    """Draw heights about their mean, where lengths have a given unit."""
    deviation = body.heights - body.heights.mean()
    label, factor = in_unit("height", deviation, unit)
    if isinstance(body, Surface):
        draw_map(axes, body, unit, deviation * factor, label)
        return
    along, size = in_unit("x", body.length, unit)
    x = (np.arange(deviation.size) + 0.5) * body.spacing * size
    axes.plot(x, deviation * factor, color="k", linewidth=0.6)
    axes.set(xlabel=along, ylabel=label)


def draw_map(
    axes: Axes,
    surface: Surface,
    unit: str | None,
    values: Real,
    label: str,
    cmap: str = "cividis",
) -> None:
    """Draw values on the grid of a surface, from above, with a colour bar."""
    borders = extent(surface, unit)
    shown = axes.imshow(thinned(values).T, origin="lower", extent=borders, cmap=cmap)
    assert axes.figure is not None
    axes.figure.colorbar(shown, ax=axes, label=label, shrink=0.85)
    label_sides(axes, surface, unit)


def extent(surface: Surface, unit: str | None) -> tuple[float, float, float, float]:
    """Return the borders of a surface on the axes: left, right, bottom and top."""
    _, size = in_unit("x", surface.sizes, unit)
    return (0.0, surface.sizes[0] * size, 0.0, surface.sizes[1] * size)


def label_sides(axes: Axes, surface: Surface, unit: str | None) -> None:
    """Label both axes of a map."""
    labels = [in_unit(name, surface.sizes, unit)[0] for name in ("x", "y")]
    axes.set(xlabel=labels[0], ylabel=labels[1])
