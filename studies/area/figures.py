"""The study's figure."""

from __future__ import annotations

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from roughline.computing.arrays import Real
from roughline.plot.style import MARKERS, PAGE, colours, new_figure
from roughline.statistics.averages import average
from roughline.theories import bush_gibson_thomas, persson
from studies.area.claims import MIDDLE, common_law
from studies.area.measure import BANDS, HURSTS, Sample, kappa, sample

_KAPPA = r"$\kappa = A\,E^* \nabla h\,/\,F$"
_SHOWN = (0.01, MIDDLE, 0.15)


def kappa_figure() -> Figure:
    """Draw kappa over the area, and over Nayak's parameter."""
    figure = new_figure(PAGE, 3.4)
    left, right = figure.subplots(1, 2, sharey=True)
    _draw_over_area(left)
    _draw_over_nayak(right)
    for axes in (left, right):
        for value, name, style in (
            (bush_gibson_thomas.KAPPA, "Bush, Gibson, Thomas", "--"),
            (persson.KAPPA, "Persson", ":"),
        ):
            axes.axhline(value, color="0.3", linewidth=1, linestyle=style)
            axes.annotate(
                f"{name} {value:.3f}",
                (0.02, value),
                xycoords=("axes fraction", "data"),
                fontsize=7,
                va="bottom",
            )
        axes.set(ylim=(1.5, 2.7))
    return figure


def _draw_over_area(axes: Axes) -> None:
    for hurst, style in zip(HURSTS, ("-", "--", ":"), strict=True):
        for band, colour in zip(BANDS, colours(len(BANDS)), strict=True):
            area, mean, low, high = over_loads(sample("main", band, hurst))
            label = f"{band}" if hurst == HURSTS[0] else None
            axes.semilogx(area, mean, color=colour, linestyle=style, label=label, linewidth=1)
            if hurst == HURSTS[0]:
                axes.fill_between(area, low, high, color=colour, alpha=0.2, linewidth=0)
    axes.set(xlabel="real contact area $A/A_0$", ylabel=_KAPPA)
    legend = axes.legend(
        title="$q_{high}/q_{roll}$", ncols=5, loc="lower left", bbox_to_anchor=(0, 0.12)
    )
    axes.add_artist(legend)
    marks = [
        axes.plot([], [], color="k", linestyle=style, label=f"Hurst {hurst:g}")[0]
        for hurst, style in zip(HURSTS, ("-", "--", ":"), strict=True)
    ]
    axes.legend(handles=marks, ncols=3, loc="lower left", bbox_to_anchor=(0, 0.28))


def over_loads(one: Sample) -> tuple[Real, ...]:
    """Mean area, and kappa with its interval, at each load."""
    mean = average(one.area)
    return (mean.mean, *(each / one.pressure for each in (mean.mean, mean.low, mean.high)))


def _draw_over_nayak(axes: Axes) -> None:
    for level, fill in zip(_SHOWN, ("full", "left", "none"), strict=True):
        law = common_law(level)
        ends = np.array([3.0, 150.0])
        axes.semilogx(ends, [law(each) for each in ends], color="0.5", linewidth=0.8)
        for hurst, colour, marker in zip(HURSTS, colours(3), MARKERS, strict=False):
            found = [(one.nayak, kappa(one, level)) for one in _of_bands(hurst)]
            value = np.array([each.value for _, each in found])
            ends_of = np.array([(each.low, each.high) for _, each in found]).T
            axes.errorbar(
                [nayak for nayak, _ in found],
                value,
                (value - ends_of[0], ends_of[1] - value),
                color=colour,
                marker=marker,
                fillstyle=fill,
                linestyle="none",
                capsize=2,
                label=f"Hurst {hurst:g}" if level == _SHOWN[0] else None,
            )
        axes.annotate(
            f"{level:.0%}", (160, law(160.0)), fontsize=7, va="center", annotation_clip=False
        )
    axes.set(xlabel=r"Nayak's parameter $\alpha = m_0 m_4 / m_2^2$", xlim=(2.8, 240))
    axes.legend(loc="lower left", bbox_to_anchor=(0, 0.12), ncols=3)


def _of_bands(hurst: float) -> list[Sample]:
    return [sample("main", band, hurst) for band in BANDS]
