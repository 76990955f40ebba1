"""A description in files: the heights as the file has them, the roughness, the prepared body."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np
from matplotlib.axes import Axes
from matplotlib.colors import ListedColormap
from matplotlib.figure import Figure
from matplotlib.ticker import EngFormatter, Formatter, ScalarFormatter
from numpy.typing import NDArray

from roughline.plot.bodies import draw_heights
from roughline.plot.pixels import any_marked, show_map, thinned
from roughline.plot.spectra import draw_spectrum
from roughline.plot.style import PAGE, new_figure, save, styled
from roughline.report.folder import make_folder
from roughline.topography.body import Body
from roughline.topography.files.write import write
from roughline.units import metres_per

if TYPE_CHECKING:
    from roughline.measurement.roughness import Roughness
    from roughline.question.description import Description
    from roughline.topography.files.measurement import Measurement
    from roughline.topography.missing import MissingPattern

_MISSING_COLOUR = "tab:red"


def write_description(description: Description, out: Path) -> list[Path]:
    """Write figures of the file and of the roughness, and the prepared body.

    Raises
    ------
    StoreError
        If the folder cannot be written.
    """
    make_folder(out)
    body, parameters = description.body, description.roughness
    files: list[Path] = []
    with styled():
        if description.missing.count or description.obstacles:
            figure = _measured_figure(description.piece, description.missing)
            files += save(figure, out, "file")
        if body is not None and parameters is not None:
            files += save(_roughness_figure(body, parameters), out, "roughness")
    if body is not None:
        write(body, out / "prepared.nc")
        files.append(out / "prepared.nc")
    return files


def _roughness_figure(body: Body, parameters: Roughness) -> Figure:
    """Heights, and the spectrum with the law that is nearest to it."""
    figure = new_figure(PAGE, 3.2)
    left, right = figure.subplots(1, 2)
    draw_heights(left, body, "m")
    draw_spectrum(right, parameters, "m")
    return figure


def _measured_figure(content: Measurement, missing: MissingPattern) -> Figure:
    """Heights, and where points are missing; with units if the file states one."""
    figure = new_figure(PAGE, 3.2)
    metres = metres_per(content.unit) if content.unit else 1.0
    unknown = content.unknown
    heights = np.ma.MaskedArray(np.ma.getdata(content.heights) * metres, unknown)
    sides = tuple(metres * side for side in content.sizes or ())
    share = f"{missing.count} of {unknown.size} points are missing ({missing.share:.2%})"
    if heights.ndim == 1:
        axes = figure.subplots()
        _draw_line(axes, content, heights, sides)
        if missing.count:
            axes.set_title(share, fontsize=9)
        return figure
    figure.set_layout_engine("compressed")  # which knows where maps of equal scales end
    left, right = figure.subplots(1, 2)
    across = (sides[0], sides[1]) if sides else (heights.shape[0], heights.shape[1])
    image = show_map(left, thinned(heights), across, cmap="cividis")
    ticks = _ticks(content.unit is not None)
    bar = figure.colorbar(
        image, ax=(left, right), orientation="horizontal", format=ticks, shrink=0.6, aspect=40
    )
    bar.ax.locator_params(nbins=5)
    bar.set_label("height" + _unit_remark(content))
    show_map(
        right,
        any_marked(unknown),
        across,
        cmap=ListedColormap(["0.92", _MISSING_COLOUR]),
        vmin=0,
        vmax=1,
        interpolation="nearest",
    )
    right.set_title(share, fontsize=9)
    for axes in (left, right):
        _label(axes, content)
        axes.locator_params(nbins=5)
        axes.yaxis.set_major_formatter(_ticks(content.unit is not None and bool(sides)))
        axes.set_ylabel(axes.get_xlabel().replace("x", "y", 1))
    return figure


def _draw_line(
    axes: Axes, content: Measurement, heights: NDArray[np.float64], sides: tuple[float, ...]
) -> None:
    """Heights of a line scan; red where they are missing."""
    step = sides[0] / heights.size if sides else 1.0
    x = (np.arange(heights.size) + 0.5) * step
    if content.positions is not None and content.sizes is not None:
        x = content.positions * sides[0] / content.sizes[0]
    axes.plot(x, heights, color="k", linewidth=0.6)
    for point in np.flatnonzero(np.ma.getmaskarray(heights)):
        axes.axvspan(x[point] - step / 2, x[point] + step / 2, color=_MISSING_COLOUR, linewidth=1)
    _label(axes, content)
    axes.yaxis.set_major_formatter(_ticks(content.unit is not None))
    axes.set_ylabel("height" + _unit_remark(content))


def _label(axes: Axes, content: Measurement) -> None:
    axes.set_xlabel("x" + _unit_remark(content) if content.sizes is not None else "x [points]")
    axes.xaxis.set_major_formatter(_ticks(content.unit is not None and content.sizes is not None))


def _unit_remark(content: Measurement) -> str:
    return "" if content.unit else " [the file states no unit]"


def _ticks(has_unit: bool) -> Formatter:
    return EngFormatter("m") if has_unit else ScalarFormatter()
