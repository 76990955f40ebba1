"""Where the fluid goes through the gap."""

from __future__ import annotations

from collections.abc import Sequence
from functools import partial
from typing import Any

import matplotlib as mpl
import numpy as np
from matplotlib.axes import Axes
from matplotlib.colors import ListedColormap, LogNorm
from matplotlib.patheffects import withStroke

from roughline.errors.public import public
from roughline.fluid.flow import Flow
from roughline.plot.pixels import any_marked, draw_map, drawn_sides
from roughline.plot.style import drawing_on
from roughline.topography.heights import checked_unit
from roughline.units import in_words

_WEAKEST_FLUX = 1e-2  # of the mean: what is less has the colour of no flow
_DARKEST_COLOUR = 0.85  # of the colours: darker ones are too near to the black of the contact
_TITLE_SIZE = 8  # [pt]
_CHANNEL_SHARE = 0.5  # share of the flow from which on a channel is told


@public
def flow(flow: Flow, unit: str | None = None, axes: Axes | None = None) -> Axes:
    r"""Draw where the fluid goes: the flux in the gap, and in black where the bodies touch.

    The scale of the flux is logarithmic and relative to its mean, the flux of two flat plates that
    let as much through. So the channels stand out, and those that carry little are still seen. What
    is below a hundredth of the mean has the palest colour, gaps without any flow are white.

    Parameters
    ----------
    flow : Flow
        As :func:`roughline.flow` returns it.
    unit : str, optional
        Unit of its lengths, such as "m"; default: none is written.
    axes : Axes, optional
        Where to draw; default: those of a new figure.

    Returns
    -------
    Axes
        The axes that were drawn on. An arrow leads from inlet to outlet, and a ring marks the cell
        at which most of the fluid's power is lost. Of a sealed gap the picture shows how far the
        fluid comes from the inlet.

    Raises
    ------
    InputError
        If the unit is none of length.

    Examples
    --------
    >>> import roughline as rl
    >>> surface = rl.SelfAffine(hurst=0.8, rms_height=0.01, q_roll=25.0).surface(64, rng=7)
    >>> curve = rl.press(surface, E_star=1.0, forces=[0.05], periodic=True, fields=True)
    >>> axes = rl.plot.flow(rl.flow(curve.fields[0]))
    """
    length = checked_unit(unit)
    with drawing_on(axes) as drawn:
        draw_flow(drawn, flow, length)
    return drawn


def draw_flow(axes: Axes, flow: Flow, unit: str | None) -> None:
    """Draw the flux on the gap, where lengths have a given unit."""
    draw = partial(draw_map, axes, sizes=flow.sizes, unit=unit, interpolation="nearest")
    is_open = any_marked(flow.gap > 0)
    draw(is_open, cmap="gray", vmin=0, vmax=1)
    if flow.is_sealed:
        reached = np.where(is_open & any_marked(flow.pressure == 1), 1.0, np.nan)
        draw(reached, cmap=ListedColormap([_scale()(0.6)]))
    else:
        width = flow.sizes[1] if flow.along == "x" else flow.sizes[0]
        flux = any_marked(np.hypot(*flow.flux)) * width / flow.inflow
        norm = LogNorm(_WEAKEST_FLUX, max(flux.max(), 1.0))
        image = draw(np.where(flux > 0, flux, np.nan), cmap=_scale(), norm=norm)
        assert axes.figure is not None
        axes.figure.colorbar(
            image, ax=axes, label=r"flux over its mean, $|j|\,/\,\bar j$", shrink=0.85, extend="min"
        )
        _mark_constriction(axes, flow, drawn_sides(image))
    _mark_direction(axes, flow)
    axes.set_title(_in_words(flow, unit), fontsize=_TITLE_SIZE, pad=17 if flow.along == "x" else 6)


def _scale() -> ListedColormap:
    """Colours that darken with the flux, and stay apart from black."""
    return ListedColormap(mpl.colormaps["YlGnBu"](np.linspace(0, _DARKEST_COLOUR, 256)))


def _mark_constriction(axes: Axes, flow: Flow, sides: Sequence[float]) -> None:
    """Mark where most power is lost with a ring, and an arrow that comes across the flow."""
    assert flow.constriction is not None
    place = (np.array(flow.constriction) + 0.5) / flow.gap.shape  # of the sides
    seen: Any = [withStroke(linewidth=3.5, foreground="w")]
    look: Any = {"color": "k", "path_effects": seen, "zorder": 4}
    at = place * sides
    axes.plot(*at[:, None], "o", markersize=11, markerfacecolor="none", **look)
    length = 34  # [pt]
    if flow.along == "x":  # from where there is more room
        start = (0, -length if place[1] < 0.5 else length)
    else:
        start = (length if place[0] < 0.5 else -length, 0)
    axes.annotate(
        "",
        tuple(at),
        start,
        textcoords="offset points",
        arrowprops={"arrowstyle": "-|>", "shrinkB": 7, **look},
    )


def _mark_direction(axes: Axes, flow: Flow) -> None:
    """Write beside the map where inlet and outlet are."""
    along_x = flow.along == "x"
    axes.annotate(
        r"inlet  $\Longrightarrow$  outlet" if flow.has_ends else r"flow  $\Longrightarrow$",
        (0.5, 1.0) if along_x else (1.0, 0.5),
        (0, 4) if along_x else (4, 0),
        xycoords="axes fraction",
        textcoords="offset points",
        ha="center" if along_x else "left",
        va="bottom" if along_x else "center",
        rotation=0 if along_x else 270,  # y counts downwards
        fontsize=_TITLE_SIZE + 1,
    )


def _in_words(flow: Flow, unit: str | None) -> str:
    """Say how much flows, and what the ring is."""
    if flow.is_sealed and flow.has_ends:
        return "sealed: no way from inlet to outlet\nblue: as far as the fluid comes"
    if flow.is_sealed:
        return "sealed: no way from one repetition\nof the map to the next"
    share = flow.largest_share
    one = f"; {100 * share:.0f}% in one channel" if share > _CHANNEL_SHARE else ""
    aperture = in_words(flow.hydraulic_aperture, unit, 3)
    name = "aperture with slip $u_s$" if flow.mean_free_path else "hydraulic aperture $u_h$"
    return f"{name} = {aperture}{one}\nring: where it is throttled most"
