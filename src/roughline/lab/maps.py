"""Maps as the page draws them: of heights, of a contact, and of a flow."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from typing import Any

import numpy as np
from numpy.typing import NDArray

import roughline as rl

_PALEST_FLUX = -2.0  # decimal logarithm of it over its mean
_NO_FLOW = -3.0  # stands for the logarithm where nothing flows
_PRESSED_SHARE = 1e-6  # of the largest pressure: where less presses, the paper shows
_MEANINGS = {  # of colours of the theme
    "ink": "in contact",
    "plastic": "of this at the hardness",
    "reach": "reached by the fluid",
    "pull": "pulled across a gap",
}

ShownUnit = tuple[float, str]
"""Factor to the numbers that are shown, and their unit."""


@dataclass(frozen=True, eq=False)
class Map:
    """Numbers over a surface, and all that the page needs to draw them."""

    values: NDArray[Any]
    palette: str | tuple[str, ...]  # of Bokeh, or "flux"; or colours of the theme, by their names
    low: float
    high: float
    title: str = ""  # of its scale, and of what is told of a point; empty where colours are marks
    unit: str = ""
    nothing: str = ""  # what is said where it is zero or none
    blank: str = "paper"  # colour of the theme where there is none
    is_logarithmic: bool = False
    caption: str = ""
    rings: Sequence[Sequence[float]] = ()  # places that are marked, in sides of the surface
    sizes: Sequence[float] = (1.0, 1.0)  # sides, in the unit of its axes
    along: str = "/ L"  # that unit
    corner: Sequence[float] = (0.0, 0.0)  # where it lies in the frame
    scale: float = 0.0  # of heights: their unit over that of its axes, where that is known
    table: tuple[list[str], list[list[str]]] | None = None  # for those who do not see it
    called: Mapping[str, str] = field(default_factory=dict)  # what colours mean, if it is not usual

    @property
    def meanings(self) -> dict[str, str]:
        """What colours of the theme mean in it, by their names."""
        marks = self.palette if isinstance(self.palette, tuple) else ()
        known = {**_MEANINGS, **self.called}
        return {name: known[name] for name in (*marks, self.blank) if name in known}

    @property
    def look(self) -> dict[str, Any]:
        """How it is drawn, without its numbers."""
        unsent = ("values", "called")
        look = {name: value for name, value in vars(self).items() if name not in unsent}
        return look | {"meanings": self.meanings}


def height_map(values: NDArray[Any], unit: str, **others: Any) -> Map:
    """Heights, from the lowest that is known to the highest."""
    known = values[np.isfinite(values)].astype(np.float32)  # as the page has them
    low, high = (float(known.min()), float(known.max())) if known.size else (0.0, 1.0)
    return Map(values, "Cividis256", low, high, "height", unit, **others)


def contact_maps(
    fields: rl.Fields, *, pressure: ShownUnit, gap: ShownUnit, deflection: ShownUnit, yields: bool
) -> dict[str, Map]:
    """The maps of a contact, by the words that choose them."""
    open_gap = np.where(fields.contact, np.nan, np.maximum(fields.gap, 0))
    marked = fields.contact.astype(np.uint8) + fields.plastic
    colours = ("paper", "ink", "plastic") if yields else ("paper", "ink")
    return {
        "area": Map(marked, colours, 0, len(colours) - 1),
        "pressure": _scaled(
            fields.pressure,
            pressure,
            "pressure",
            "blank where nothing touches",
            low=_PRESSED_SHARE,
            palette="Viridis256",
        ),
        "gap": _scaled(open_gap, gap, "gap", "blank where they touch", nothing="in contact"),
        "displacement": _scaled(fields.displacement, deflection, "deflection", "of the half-space"),
    }


def _scaled(
    values: NDArray[Any], scale: ShownUnit, title: str, caption: str, low: float = 0.0, **look: Any
) -> Map:
    """A map from a share of its largest number, or zero, to that."""
    scaled = values * scale[0]
    high = float(np.nanmax(scaled, initial=0.0))
    look = {"palette": "Cividis256", "caption": caption, **look}
    return Map(scaled, low=low * high, high=high or 1.0, title=title, unit=scale[1], **look)


def flux_map(flow: rl.Flow) -> Map:
    """Where the fluid goes: the flux over its mean; of a sealed gap, how far the fluid comes."""
    is_open = flow.gap > 0
    if flow.is_sealed:
        reached = flow.pressure == 1
        marks = np.where(is_open, 2 * reached, 1).astype(np.uint8)
        caption = "sealed: no way through"
        return Map(marks, ("paper", "ink", "reach"), 0, 2, caption=caption)
    flux = np.hypot(*flow.flux) * _width(flow) / flow.inflow
    logarithm = np.full(flux.shape, _NO_FLOW)
    np.log10(flux, out=logarithm, where=flux > 0)
    logarithm[flux > 0] = np.maximum(logarithm[flux > 0], _PALEST_FLUX)
    logarithm[~is_open] = np.nan
    high = max(float(np.log10(flux.max())), 0.0)
    return Map(
        values=logarithm,
        palette="flux",
        low=_PALEST_FLUX,
        high=high,
        title="flux",
        unit="of its mean",
        is_logarithmic=True,
        nothing="no flow",
        blank="ink",
        caption="ring: throttled most",
        rings=[throttled_at(flow)],
    )


def throttled_at(flow: rl.Flow) -> tuple[float, float]:
    """Where the fluid is throttled most, in sides of the surface."""
    assert flow.constriction is not None
    x, y = ((i + 0.5) / n for i, n in zip(flow.constriction, flow.gap.shape, strict=True))
    return x, y


def _width(flow: rl.Flow) -> float:
    """Side across the flow. [length]"""
    return flow.sizes[1] if flow.along == "x" else flow.sizes[0]
