"""Pictures of bodies that are sheared: their loop, and where they stick and slip."""

from __future__ import annotations

import numpy as np
from matplotlib.axes import Axes
from matplotlib.colors import ListedColormap

from roughline.computing.arrays import Mask, Real
from roughline.contact.sliding import SlidingFields
from roughline.plot.pixels import any_marked, draw_map, drawn_sides, look_at
from roughline.plot.style import in_unit, ink

_OPEN_SLIP_STICK = ListedColormap(["white", "tab:orange", "black"])
_ARROWS = 14  # along a side of a map


def draw_loop(axes: Axes, slide: Real, force: Real, per_cycle: int) -> None:
    """Draw shear force over slide [m], [N]; what the last cycle dissipates is filled."""
    x_label, x = in_unit("slide $u$", slide, "m")
    y_label, y = in_unit("shear force $Q$", force, "N")
    axes.fill(
        slide[-1 - per_cycle :] * x,
        force[-1 - per_cycle :] * y,
        color="tab:orange",
        alpha=0.3,
        linewidth=0,
        label="dissipated in a cycle",
    )
    axes.plot(slide * x, force * y, ".-", color=ink(), markersize=3, linewidth=0.8)
    axes.axhline(0, color="0.7", linewidth=0.7, zorder=-1)
    axes.set(xlabel=x_label, ylabel=y_label)
    axes.legend(loc="upper left")


def draw_stick_and_slip(axes: Axes, fields: SlidingFields, never_slips: Mask, unit: str) -> None:
    """Draw where bodies never slip, where they do, and arrows along their last slip."""
    slips = fields.contact & ~never_slips
    marks = np.where(fields.contact, np.where(slips, 1, 2), 0)
    image = draw_map(
        axes, any_marked(marks), fields.sizes, unit, cmap=_OPEN_SLIP_STICK, vmin=0, vmax=2
    )
    image.set_interpolation("nearest")
    look_at(axes, image, fields.contact)
    places, slip = _largest_slips(np.where(slips[..., np.newaxis], fields.slip, 0.0))
    if not places.size:
        return
    steps = np.array(drawn_sides(image)) / marks.shape
    at, length = (places + 0.5) * steps, np.hypot(*slip.T)
    along = slip / length.max() * np.ptp(axes.get_xlim()) / _ARROWS * 1.5
    axes.quiver(
        *at.T,
        *along.T,
        angles="xy",
        scale_units="xy",
        scale=1,
        color="tab:blue",
        width=0.006,
        zorder=3,
    )


def _largest_slips(slip: Real) -> tuple[Real, Real]:
    """Return the points with the largest slip of each piece of what slips, and their slips."""
    size = np.hypot(slip[..., 0], slip[..., 1])
    places = []
    slipping = [np.flatnonzero(size.any(axis=1 - axis)) for axis in (0, 1)]
    if not slipping[0].size:
        return np.empty((0, 2)), np.empty((0, 2))
    edges = [
        np.linspace(each[0], each[-1] + 1, min(int(np.ptp(each)) + 1, _ARROWS) + 1).astype(int)
        for each in slipping
    ]
    for first, end in zip(edges[0][:-1], edges[0][1:], strict=True):
        for low, high in zip(edges[1][:-1], edges[1][1:], strict=True):
            piece = size[first:end, low:high]
            i, j = np.unravel_index(int(piece.argmax()), piece.shape)
            if piece[i, j] > 0:
                places.append((first + i, low + j))
    found = np.array(places, dtype=int).reshape(-1, 2)
    return found.astype(float), slip[found[:, 0], found[:, 1]]
