"""One pressed body: the table of its curve, and figures of curve, topography and contact."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace
from pathlib import Path

import numpy as np
from matplotlib.figure import Figure
from numpy.typing import NDArray

from roughline.contact import press
from roughline.curve import Curve, Status
from roughline.estimates import estimate
from roughline.measured import read
from roughline.preparation import Preparation, prepared
from roughline.quantities import engineering
from roughline.report.folder import make_folder
from roughline.report.style import PAGE, new_figure, save, styled
from roughline.topography import Body, Surface

_LARGE = 2**20  # points from which on the cost is told
_PREFIXES = {-12: "p", -9: "n", -6: "µ", -3: "m", 0: "", 3: "k", 6: "M", 9: "G"}


@dataclass(frozen=True)
class Pressed:
    """What pressing a file gave.

    Attributes
    ----------
    body : Surface or Line
        The body that was pressed, in metres.
    curve : Curve
        Its curve; a load that did not converge is marked.
    files : list of Path
        What was written.
    """

    body: Body
    curve: Curve
    files: list[Path]


def press_file(
    file: Path,
    *,
    E_star: float,
    n_loads: int | None,
    forces: list[float] | None,
    depths: list[float] | None,
    unit: str | None,
    keep_tilt: bool,
    periodic: bool,
    grid_error: bool = False,
    out: Path | None,
    announce: Callable[[str], None],
    progress: Callable[[int, int], None] | None,
) -> Pressed:
    """Read a file, level it, press it and write the results.

    Parameters
    ----------
    file : Path
        The topography.
    E_star : float
        Contact modulus. [Pa]
    n_loads, forces, depths
        One of the three, as for :func:`roughline.press`. [N], [m]
    unit : str or None
        Unit of the lengths in a file that states none.
    keep_tilt : bool
        Whether a measured surface keeps its tilt.
    periodic : bool
        Whether the surface is repeated.
    grid_error : bool
        As for :func:`roughline.press`.
    out : Path or None
        Folder for curve and figures; None writes nothing.
    announce : callable
        Told what a large run will cost, before it starts.
    progress : callable or None
        Called with (loads done, loads in all).
    """
    body = read(file, unit)
    body = prepared(body, Preparation(trend="none") if keep_tilt else None)
    if out is not None:
        make_folder(out)  # a folder that cannot be written is said before the work, not after
    count = next((len(given) for given in (forces, depths, range(n_loads or 0)) if given), 0)
    if isinstance(body, Surface) and body.heights.size >= _LARGE:
        cost = estimate(body.shape, count, periodic=periodic)
        announce(f"{body.shape[0]} x {body.shape[1]} points, {count} loads: {cost}")
    curve = press(
        body,
        E_star=E_star,
        n_loads=n_loads,
        forces=forces,
        depths=depths,
        periodic=periodic,
        fields=[3 * count // 4] if out is not None and isinstance(body, Surface) else False,
        grid_error=grid_error,
        throw=False,
        progress=progress,
    )
    return Pressed(body, curve, write_pressed(body, curve, out) if out is not None else [])


def curve_table(curve: Curve) -> tuple[list[str], list[list[str]]]:
    """Return header and rows of a curve in SI units; a star marks loads that the grid decides."""
    header = ["load", "depth", "force", "stiffness k"]
    if curve.area_fraction is not None:
        header += ["contact area", "corrected"]
    rows = []
    for i in range(curve.depth.size):
        mark = "" if curve.resolved[i] else " *"
        if not curve.converged[i]:
            rows.append(
                [str(i + 1), "-", "-", Status(curve.status[i]).reason, "-", "-"][: len(header)]
            )
            continue
        row = [
            f"{i + 1}{mark}",
            engineering(curve.depth[i], "m"),
            engineering(curve.force[i], "N"),
            engineering(curve.stiffness[i], "N/m"),
        ]
        if curve.stiffness_error is not None:
            row[-1] += f" ± {curve.stiffness_error[i] / curve.stiffness[i]:.1%}"
        if curve.area_fraction is not None and curve.area_fraction_corrected is not None:
            row += [f"{curve.area_fraction[i]:.3%}", f"{curve.area_fraction_corrected[i]:.3%}"]
        if curve.area_fraction_error is not None:
            row[-1] += f" ± {curve.area_fraction_error[i]:.3%}"
        rows.append(row)
    return header, rows


def write_pressed(body: Body, curve: Curve, out: Path) -> list[Path]:
    """Write a pressed body: ``curve.nc``, and figures of the curve and of the contact.

    Parameters
    ----------
    body : Surface or Line
        The body, in metres.
    curve : Curve
        Its curve; of a surface with the fields of the load to be shown.
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
    replace(curve, fields=()).write(out / "curve.nc")
    written = [out / "curve.nc"]
    with styled():
        written += save(curve_figure(curve), out, "curve")
        if isinstance(body, Surface):
            written += save(contact_figure(body, curve), out, "contact")
    return written


def curve_figure(curve: Curve) -> Figure:
    """Force over depth, and stiffness over force; open marks where the grid decides."""
    figure = new_figure(PAGE, 3.0)
    left, right = figure.subplots(1, 2)
    depth_unit, depth = _scaled(curve.depth, "m")
    force_unit, force = _scaled(curve.force, "N")
    stiffness_unit, stiffness = _scaled(curve.stiffness, "N/m")
    for axes, x, y in ((left, depth, force), (right, force, stiffness)):
        axes.loglog(x, y, color="0.5", linewidth=0.8)
        axes.loglog(x[curve.resolved], y[curve.resolved], "o", color="k")
        axes.loglog(x[~curve.resolved], y[~curve.resolved], "o", color="k", fillstyle="none")
    left.set(xlabel=f"depth since touch $d$ [{depth_unit}]", ylabel=f"force $F$ [{force_unit}]")
    right.set(xlabel=f"force $F$ [{force_unit}]", ylabel=f"stiffness $k$ [{stiffness_unit}]")
    return figure


def contact_figure(surface: Surface, curve: Curve) -> Figure:
    """Topography, and the real contact area at the last load whose fields are there."""
    figure = new_figure(PAGE, 3.2)
    left, right = figure.subplots(1, 2)
    size_unit, (width, height) = _scaled(np.array(surface.sizes), "m")
    height_unit, heights = _scaled(surface.heights - surface.heights.mean(), "m")
    extent = (0, width, 0, height)
    shown = left.imshow(heights.T, origin="lower", extent=extent, cmap="cividis")
    figure.colorbar(shown, ax=left, label=f"height [{height_unit}]", shrink=0.85)
    solved = [i for i, fields in enumerate(curve.fields) if fields is not None]
    if solved:
        i = solved[-1]
        found = curve.fields[i]
        assert found is not None
        right.imshow(
            found.contact.T, origin="lower", extent=extent, cmap="binary", interpolation="nearest"
        )
        right.set_title(
            f"contact {found.contact.mean():.2%} at F = {engineering(curve.force[i], 'N', 3)}",
            fontsize=9,
        )
    for axes in (left, right):
        axes.set(xlabel=f"x [{size_unit}]", ylabel=f"y [{size_unit}]")
    return figure


def _scaled(values: NDArray[np.float64], unit: str) -> tuple[str, NDArray[np.float64]]:
    """Choose a prefix for values in an SI unit, and return the unit and the values in it."""
    largest = float(np.nanmax(np.abs(values), initial=0.0))
    power = 3 * int(np.floor(np.log10(largest) / 3)) if 0 < largest < np.inf else 0
    power = min(max(power, min(_PREFIXES)), max(_PREFIXES))
    return _PREFIXES[power] + unit, values / 10.0**power
