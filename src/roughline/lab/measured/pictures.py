"""Heights, spectra and contacts as the page draws them: numbers in handy units."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

import roughline as rl
from roughline.assessment.assessment import Assessment
from roughline.assessment.description import Description
from roughline.engineering.intervals import Ends
from roughline.lab.maps import Map, flux_map
from roughline.plot.pixels import any_marked, thinned
from roughline.report.contact_tables import area_in_words
from roughline.topography.body import Body, Surface, sides_of
from roughline.topography.files.measurement import Measurement
from roughline.topography.preparation import outliers
from roughline.units import decimal, engineering, metres_per, prefix

_Real = NDArray[np.float64]
_Mask = NDArray[np.bool_]

_MOST_SPIKES = 2000  # that are marked
_MOST_SPOTS = 100  # points in contact that are marked
_MOST_LINE_POINTS = 8000  # that are drawn
_MOST = (0.1, 99.9)  # of heights, without spikes [%]


@dataclass(frozen=True, eq=False)
class Drawing:
    """Heights as the page draws them."""

    header: dict[str, Any]  # sides, units, ranges of all and of most heights, and where spikes are
    arrays: dict[str, NDArray[Any]]  # heights, rows along x; NaN where they are missing


def drawing_of_file(content: Measurement, body: Body | None) -> Drawing:
    """Heights as the file has them; spikes are marked where there is a body."""
    metres = metres_per(content.unit) if content.unit else None
    unknown = content.unknown
    heights = np.array(np.ma.getdata(content.heights), dtype=np.float64)
    heights[unknown] = np.nan
    spikes = None
    if body is not None and body.heights.shape == heights.shape:
        spikes = outliers(body)
    sides = content.sizes or tuple(map(float, heights.shape))
    otherwise = "unit not stated" if content.sizes else "points"
    along = _unit(max(sides), metres if content.sizes else None, otherwise)
    up = _unit(_span(heights), metres, "unit not stated")
    return _drawn("file", heights, sides, along, up, spikes)


def drawing_of_body(body: Body) -> Drawing:
    """Heights of a body about their mean, with its spikes."""
    heights = body.heights - body.heights.mean()
    sides = sides_of(body)
    return _drawn("body", heights, sides, _unit(max(sides), 1.0), _unit(_span(heights), 1.0))


def spectrum_of(found: Description) -> dict[str, Any] | None:
    """The spectrum with the nearest law, as the reports draw it."""
    parameters = found.roughness
    if parameters is None or parameters.spectrum is None or parameters.power is None:
        return None
    spectrum, power, fit = parameters.spectrum, parameters.power, parameters.fit
    known = power > 0
    of_surface = isinstance(found.body, Surface)
    law = parameters.law
    kept = None
    if law is not None:
        finite = np.isfinite(law[1])
        kept = {"q": law[0][finite], "power": law[1][finite]}
    title = ""
    if fit is not None:
        title = f"H = {fit.hurst_in_words}"
    return {
        "q": spectrum.q[known],
        "power": power[known],
        "law": kept,
        "label": "C_2d [m⁴]" if of_surface else "C_profile [m³]",
        "title": title,
        "rows": _spectrum_rows(spectrum.q[known], power[known]),
    }


def _spectrum_rows(q: _Real, power: _Real) -> list[list[str]]:
    """Some of the spectrum for a table."""
    shown = np.unique(np.geomspace(1, q.size, 40).astype(int)) - 1
    return [[f"{q[i]:.3g}", f"{power[i]:.3g}"] for i in shown]


def _drawn(
    name: str,
    heights: _Real,
    sides: tuple[float, ...],
    along: tuple[float, str],
    up: tuple[float, str],
    spikes: _Mask | None = None,
) -> Drawing:
    """Heights of a map or a line in their units."""
    known = heights[np.isfinite(heights)] * up[0]
    header: dict[str, Any] = {
        "is_map": heights.ndim == 2,
        "sizes": [side * along[0] for side in sides],
        "along": along[1],
        "up": up[1],
        "metres": 1 / along[0],
        "range": [float(known.min()), float(known.max())] if known.size else [0.0, 1.0],
        "most": np.percentile(known, _MOST) if known.size else [0.0, 1.0],
        "spikes": _spikes(spikes, sides, along[0], heights * up[0]),
        "rows": _height_rows(known, up[1]),
    }
    if heights.ndim == 2:
        marked = any_marked(~np.isfinite(heights))
        shown = thinned(heights) * up[0]
        shown[marked[: shown.shape[0], : shown.shape[1]]] = np.nan
        return Drawing(header, {f"{name} heights": shown.T})
    step = max(1, heights.size // _MOST_LINE_POINTS)
    x = (np.arange(heights.size) + 0.5) * sides[0] / heights.size * along[0]
    header["missing"] = x[~np.isfinite(heights)][:_MOST_SPIKES]
    return Drawing(header, {f"{name} x": x[::step], f"{name} heights": heights[::step] * up[0]})


def _spikes(
    spikes: _Mask | None, sides: tuple[float, ...], scale: float, heights: _Real
) -> dict[str, Any] | None:
    """Where spikes are, up to a number that can be seen."""
    if spikes is None:
        return None
    places = np.argwhere(spikes)
    shown = places[:_MOST_SPIKES]
    steps = [scale * side / n for side, n in zip(sides, spikes.shape, strict=True)]
    columns = [(shown[:, i] + 0.5) * step for i, step in enumerate(steps)]
    y = columns[1] if spikes.ndim == 2 else heights[spikes][:_MOST_SPIKES]
    return {"count": len(places), "x": columns[0], "y": y}


def _height_rows(known: _Real, unit: str) -> list[list[str]]:
    """Heights in numbers, for those who do not see the map."""
    if not known.size:
        return []
    unit = "" if unit == "unit not stated" else unit
    shares = {"lowest": 0, "lowest tenth below": 10, "median": 50, "highest tenth above": 90}
    rows = [
        [name, f"{decimal(float(np.percentile(known, share)), 4)} {unit}"]
        for name, share in (shares | {"highest": 100}).items()
    ]
    return rows


def _span(heights: _Real) -> float:
    known = heights[np.isfinite(heights)]
    return float(np.abs(known).max()) if known.size else 0.0


def _unit(largest: float, metres: float | None, otherwise: str = "m") -> tuple[float, str]:
    """The factor to a handy unit, and its sign; without metres the file's own numbers stay."""
    if metres is None:
        return 1.0, otherwise
    factor, prefixed = prefix(largest * metres, "m")
    return metres * factor, prefixed


def contact_drawing(result: Assessment) -> Drawing:
    """The contact at the load whose fields were kept, beside the topography."""
    surface = result.body
    assert isinstance(surface, Surface)
    body = drawing_of_body(surface)
    shown = next((i for i, each in enumerate(result.curve.fields) if each is not None), None)
    if shown is None:
        return Drawing({**body.header, "load": "", "fields": {}}, body.arrays)
    fields = result.curve.fields[shown]
    assert fields is not None
    force = engineering(float(result.curve.force[shown]) * result.scale, "N")
    marks = fields.contact.astype(np.uint8) + fields.plastic
    arrays: dict[str, NDArray[Any]] = {"area": any_marked(marks).T}
    units: dict[str, Any] = {
        "area": {"unit": "", "range": [0, 2]}
    }  # gap, contact, contact at the hardness
    for name, values, unit in (
        ("pressure", fields.pressure, "Pa"),
        ("gap", np.maximum(fields.gap, 0), "m"),  # rounding leaves it just below in contact
        ("displacement", fields.displacement, "m"),
    ):
        factor, prefixed = prefix(float(np.nanmax(np.abs(values), initial=0.0)), unit)
        arrays[name] = thinned(values).T * factor
        largest = float(np.nanmax(values, initial=0.0)) * factor
        units[name] = {"unit": prefixed, "range": [0, largest or 1.0]}
    if result.flows:  # along the leakier of the directions that are asked
        through = max(result.flows, key=lambda each: each.hydraulic_aperture)
        map_of_flow = flux_map(through)
        arrays["flux"] = thinned(map_of_flow.values).T
        units["flux"] = _in_sides(map_of_flow, body.header["sizes"], through)
    header = {
        **body.header,
        "load": f"corrected area {area_in_words(result, shown)} at {force}",
        "fields": units,
        "yields": result.curve.hardness is not None,
        "spots": _spots(fields.contact, surface, body.header["metres"]),
    }
    return Drawing(header, body.arrays | arrays)


def _in_sides(drawn: Map, sizes: Sequence[float], flow: rl.Flow) -> dict[str, Any]:
    """How the map of a flow is drawn, with its ring in the units of the axes."""
    ring: list[list[float]] = [[], []]
    if drawn.ring is not None:
        ring = [[share * side] for share, side in zip(drawn.ring, sizes, strict=True)]
    caption = f"{drawn.caption}; {'from left to right' if flow.along == 'x' else 'upwards'}"
    if flow.sides == "periodic":
        caption += ", the map repeated on all sides"
    look = {**drawn.look, "caption": caption, "ring": {"x": ring[0], "y": ring[1]}}
    return {**look, "unit": "", "range": [drawn.low, drawn.high]}


def _spots(contact: _Mask, surface: Surface, metres: float) -> dict[str, Any]:
    """Where points touch, if they are so few that a map does not show them."""
    places = np.argwhere(contact)
    if len(places) > _MOST_SPOTS:
        places = places[:0]
    x, y = ((places[:, i] + 0.5) * spacing / metres for i, spacing in enumerate(surface.spacing))
    return {"x": x, "y": y}


def curve_drawing(result: Assessment) -> dict[str, Any]:
    """Stiffness and area over force with their intervals, and theories beside them."""
    curve, solved = result.curve, result.curve.converged
    scale = result.scale
    force_factor, force_unit = prefix(scale * _largest(curve.force[solved]), "N")
    factor, unit = prefix(scale * _largest(curve.stiffness[solved]), "N/m")
    force_factor, factor = scale * force_factor, scale * factor
    drawn: dict[str, Any] = {
        "force": curve.force[solved] * force_factor,
        "force_unit": force_unit,
        "is_of_joint": result.question.joint is not None,
        "stiffness": curve.stiffness[solved] * factor,
        "stiffness_unit": unit,
        "resolved": curve.resolved[solved],
        "asked": np.isin(np.flatnonzero(solved), result.asked),
        "stiffness_interval": _ends(result.stiffness_interval, solved, factor),
        "unloading": None,
        "area": None,
        "area_interval": _ends(result.area_interval, solved, 1.0),
        "theories": [
            {
                "name": each.name,
                "force": each.pressure * result.area * force_factor,
                "area": each.area_fraction,
                "stiffness": None
                if each.stiffness is None
                else each.stiffness * result.area * factor,
            }
            for each in result.theories
        ],
    }
    if curve.area_fraction_corrected is not None:
        drawn["area"] = curve.area_fraction_corrected[solved]
    if curve.hardness is not None and curve.unloading_stiffness is not None:
        drawn["unloading"] = curve.unloading_stiffness[solved] * factor
    return drawn


def _ends(ends: Ends | None, solved: _Mask, factor: float) -> list[_Real] | None:
    return None if ends is None else [end[solved] * factor for end in ends]


def _largest(values: _Real) -> float:
    return float(np.nanmax(values, initial=0.0))
