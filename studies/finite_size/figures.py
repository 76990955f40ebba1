"""The study's figure."""

from __future__ import annotations

from matplotlib.axes import Axes
from matplotlib.figure import Figure

from roughline.plot.style import PAGE, colours, new_figure
from studies.finite_size.crossover import local_exponents, scaling_exponent_of
from studies.finite_size.samples import (
    BAND,
    GEOMETRIES,
    HURSTS,
    SIZES,
    WIDE,
    Geometry,
    Sample,
    sample,
)

_STYLES: dict[Geometry, str] = {"periodic": "-", "free": "--", "lines": ":"}
_WIDE_STYLE = "-."
_NAMES: dict[Geometry, str] = {
    "periodic": "periodic",
    "free": "free, interface",
    "lines": "reduced",
}
_EXPONENTS, _GAMMAS = (0.45, 1.15), (0.0, 0.6)


def crossover_figure() -> Figure:
    """Draw local exponents over the force, and F / (k h) over the pressure, for all sizes."""
    figure = new_figure(PAGE, 5.4)
    above, below = figure.subplots(2, len(HURSTS), sharey="row")
    for exponents, gammas, hurst in zip(above, below, HURSTS, strict=True):
        for size, colour in zip(SIZES[BAND], colours(len(SIZES[BAND])), strict=True):
            for geometry in GEOMETRIES:
                _draw(exponents, gammas, sample(geometry, BAND, size, hurst), colour)
            if size in SIZES[WIDE]:
                _draw(exponents, gammas, sample("periodic", WIDE, size, hurst), colour)
        for value in (scaling_exponent_of(hurst), 1.0):
            exponents.axhline(value, color="0.5", linewidth=0.7, zorder=0)
        gammas.axhspan(0.4, 0.5, color="0.92", zorder=-10, linewidth=0)
        exponents.set(title=f"Hurst {hurst:g}", ylim=_EXPONENTS, xlim=(0.003, 700))
        exponents.set(xlabel=r"$F\,/\,(E^* h \lambda_r)$")
        gammas.set(xlabel=r"$p \lambda_r\,/\,(E^* h)$", ylim=_GAMMAS)
    above[0].set_ylabel(r"$d \ln k\,/\,d \ln F$")
    below[0].set_ylabel(r"$F\,/\,(k h)$")
    _name(figure, above[0])
    return figure


def _draw(exponents: Axes, gammas: Axes, one: Sample, colour: object) -> None:
    style = _WIDE_STYLE if one.band == WIDE else _STYLES[one.geometry]
    look = {"color": colour, "linestyle": style, "linewidth": 1}
    local = local_exponents(one.force, one.stiffness)
    exponents.semilogx(local.force, local.value, **look)
    if style == "-":
        exponents.fill_between(
            local.force, local.low, local.high, color=colour, alpha=0.2, linewidth=0
        )
    gammas.semilogx(one.pressure, one.gamma, **look)


def _name(figure: Figure, axes: Axes) -> None:
    """Say what colours and lines mean."""
    sizes = [
        axes.plot([], [], color=colour, label=f"{size}")[0]
        for size, colour in zip(SIZES[BAND], colours(len(SIZES[BAND])), strict=True)
    ]
    styles = [
        axes.plot([], [], color="k", linestyle=_STYLES[each], label=_NAMES[each])[0]
        for each in GEOMETRIES
    ]
    wide = axes.plot([], [], color="k", linestyle=_WIDE_STYLE, label="wider band")
    figure.legend(
        handles=[*sizes, *styles, *wide],
        title="roll-off waves along a side; geometry",
        loc="outside upper center",
        ncols=10,
        columnspacing=1.2,
        handlelength=1.6,
    )
