"""Heights, spectra, contacts and curves as the page draws them, in handy units."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from typing import Any

import numpy as np
from numpy.typing import NDArray

from roughline.assessment.assessment import Assessment
from roughline.comparison.compared import ModelComparison
from roughline.computing.arrays import Real
from roughline.contact.curve import SurfaceCurve
from roughline.contact.selection import loads_with_fields
from roughline.engineering.intervals import Ends
from roughline.lab.maps import Map, ShownUnit, contact_maps, flux_map, height_map
from roughline.lab.panels import PanelContent, Points
from roughline.plot.pixels import any_marked, thinned
from roughline.question.description import Description
from roughline.report.comparison import comparison_table
from roughline.report.contact_tables import area_in_words, curve_table
from roughline.report.values import figure, up_to_three_digits
from roughline.topography.body import Body, Surface, side_lengths
from roughline.topography.preparation import outliers
from roughline.units import metres_per, prefix

Panels = dict[str, PanelContent]
Maps = dict[str, Map]
"""Maps by the words that choose them; the first of those beside each other is `height`."""

_MOST_MARKED_POINTS = 2000  # spikes, and missing points of a line
_MOST_SPOTS = 100  # points in contact that are marked
_MOST_LINE_POINTS = 8000  # that are drawn
_HEIGHT_PERCENTILES = (0.1, 99.9)  # without spikes
_PERCENTILES = {
    **{"lowest": 0, "lowest tenth below": 10, "median": 50, "highest tenth above": 90},
    "highest": 100,
}


def file_pictures(found: Description) -> tuple[Panels, Maps]:
    """Heights as the file has them, its spikes marked where there is a body, and its spectrum."""
    content, body = found.measurement, found.body
    unit = content.unit or found.unit
    metres = metres_per(unit) if unit else None
    heights = np.where(content.unknown, np.nan, np.ma.getdata(content.heights).astype(np.float64))
    spikes = np.zeros(heights.shape, bool)
    remark = "spikes are looked for once unit and size are known"
    sides, aside, otherwise = tuple(map(float, heights.shape)), None, "points"
    if body is not None and body.heights.shape == heights.shape:
        spikes = outliers(body)
        remark = f"{np.count_nonzero(spikes)} spikes"
        sides, aside = side_lengths(body), 1.0  # as they were given
    if content.sizes:
        sides, otherwise = content.sizes, "unit not stated"
        aside = metres_per(content.unit_of_sides) if content.unit_of_sides else metres
    along = _scale(max(sides), aside, otherwise)
    up = _scale(_largest(np.abs(heights)), metres, "unit not stated")
    panels = _spectrum(found)
    if heights.ndim == 2:
        caption = f"orange: missing points; rings: spikes; {remark}"
        rings = _shares(spikes, _MOST_MARKED_POINTS)
        return panels, {"height": _map(heights, sides, along, up, caption=caption, rings=rings)}
    heights *= up[0]
    x = _places(heights.size, sides[0] * along[0])
    missing = x[np.isnan(heights)][:_MOST_MARKED_POINTS]
    foot = np.full(missing.size, np.nanmin(heights, initial=np.inf))
    series = {
        "heights": _line(x, heights),
        "spikes": _xy(x[spikes][:_MOST_MARKED_POINTS], heights[spikes][:_MOST_MARKED_POINTS]),
        "missing": _xy(missing, foot),
    }
    panels["file-line"] = _along(series, along, up, rows=_rows(heights, up[1]), caption=remark)
    return panels, {}


def preparation_pictures(before: Body, after: Body, corner: Sequence[float]) -> tuple[Panels, Maps]:
    """Heights before, and after from a corner of these [m], with the same units and colours."""
    heights, sides = [_about_mean(each) for each in (before, after)], side_lengths(before)
    along, up = _scale(max(sides), 1.0), _scale(_largest(np.abs(heights[0])), 1.0)
    corner = [end * along[0] for end in corner]
    heights = [each * up[0] for each in heights]
    if not isinstance(after, Surface):
        x = [
            along[0] * _places(each.heights.size, side_lengths(each)[0]) for each in (before, after)
        ]
        series = {"before": _line(x[0], heights[0]), "after": _line(corner[0] + x[1], heights[1])}
        pairs = zip(*(_rows(each, up[1]) for each in heights), strict=True)
        rows = [[*one, other[1]] for one, other in pairs]
        return {"prepared-line": _along(series, along, up, rows=rows)}, {}
    ends = [np.percentile(each, _HEIGHT_PERCENTILES) for each in heights]
    low, high = float(np.min(ends)), float(np.max(ends))
    first, second = (
        replace(_map(each, side_lengths(body), along, (1.0, up[1])), low=low, high=high)
        for each, body in zip(heights, (before, after), strict=True)
    )
    shape = " x ".join(map(str, after.heights.shape))
    return {}, {
        "height": replace(first, caption="about the mean, as read; draw a box to keep a piece"),
        "after": replace(second, caption=f"{shape} points", corner=corner),
    }


def contact_pictures(result: Assessment) -> Maps:
    """The topography, and the contact at the load by what it shows."""
    surface = result.body
    if not isinstance(surface, Surface):
        return {}
    along, heights = _scale(max(surface.sizes), 1.0), _about_mean(surface)
    up = _scale(_largest(np.abs(heights)), 1.0)
    topography = _map(heights, surface.sizes, along, up, caption="heights about their mean")
    pressed = loads_with_fields(result.curve)
    if not pressed:
        return {"height": topography}
    load_number, fields = pressed[0]
    force = up_to_three_digits(
        float(result.curve_over_loads.force[load_number]) * result.scale, None, "N"
    )
    load = f"corrected area {area_in_words(result, load_number, up_to_three_digits)} at {force}"
    maps = contact_maps(
        fields,
        pressure=prefix(_largest(fields.pressure), "Pa"),
        gap=up,
        deflection=prefix(_largest(np.abs(fields.displacement)), "m"),
        yields=result.curve.hardness is not None,
    )
    rows = [["contact", load]]
    rows += [
        [f"largest {each.title}", f"{figure(each.high)} {each.unit}"]
        for each in maps.values()
        if each.title
    ]
    if result.flows:  # along the leakier of the directions that are asked
        flow = max(result.flows, key=lambda each: each.hydraulic_aperture)
        drawn, along_x = flux_map(flow), flow.along == "x"
        caption = f"{drawn.caption}, {'from left to right' if along_x else 'downwards'}"
        caption += ", the map repeated on all sides" if flow.sides == "periodic" else ""
        maps["flux"] = replace(drawn, caption=caption)
    spots = _shares(fields.contact, _MOST_SPOTS + 1)
    spots = spots if len(spots) <= _MOST_SPOTS else []
    for name, each in maps.items():
        rings, captions = each.rings or spots, [each.caption, load]
        captions += ["rings: the few points that touch"] if spots and rings is spots else []
        maps[name] = replace(
            each,
            values=thinned(each.values) if each.title else any_marked(each.values),
            caption="; ".join(filter(None, captions)),
            rings=rings,
            table=(["quantity", "value"], rows),
            **_frame(surface.sizes, along),
        )
    return {"height": topography, **maps}


def curve_panels(result: Assessment) -> Panels:
    """Stiffness and area over force with their intervals, and theories beside them."""
    curve, solved, scale = result.curve_over_loads, result.curve.converged, result.scale
    per_newton, force_unit = prefix(scale * _largest(curve.force[solved]), "N")
    per_stiffness, unit = prefix(scale * _largest(curve.stiffness[solved]), "N/m")
    of_y = {
        "stiffness": (scale * per_stiffness, f"stiffness k [{unit}]"),
        "area": (1.0, "real contact area A / A₀"),
    }
    drawn = {"stiffness": _load_points(result, curve.stiffness, result.stiffness_interval)}
    if isinstance(curve, SurfaceCurve):
        drawn["area"] = _load_points(result, curve.area_fraction_corrected, result.area_interval)
        if curve.hardness is not None:
            unloading = _xy(curve.force[solved], curve.unloading_stiffness[solved])
            drawn["stiffness"]["unloading"] = unloading
    for each in result.theories:
        name, forces = f"theory {each.name}", result.load_on(each.pressure * result.area)
        drawn["area"][name] = _xy(forces, each.area_fraction)
        if each.stiffness is not None:
            drawn["stiffness"][name] = _xy(forces, each.stiffness * result.area)
    on = "" if result.question.joint is None else " on the joint"
    columns, rows = curve_table(result)
    panels = {}
    for key, series in drawn.items():
        by = dict.fromkeys(("y", "low", "high"), of_y[key][0]) | {"x": scale * per_newton}
        scaled = {
            name: {axis: values * by[axis] for axis, values in points.items()}
            for name, points in series.items()
        }
        axes = (f"force F{on} [{force_unit}]", of_y[key][1])
        panels[key] = PanelContent.fitted(scaled, axes=axes, columns=columns, rows=rows)
    return panels


def _load_points(result: Assessment, values: Real, ends: Ends | None) -> dict[str, Points]:
    """A quantity over the loads that were solved, with its interval. [N, SI]"""
    curve = result.curve_over_loads
    asked = np.isin(np.arange(curve.force.size), result.asked)
    kinds = {"loads": curve.resolved, "unsure": ~curve.resolved, "asked": asked}
    masks = {kind: curve.converged & some for kind, some in kinds.items()} | {
        "line": curve.converged
    }
    series = {kind: _xy(curve.force[mask], values[mask]) for kind, mask in masks.items()}
    if ends is not None:
        mask = curve.converged & (ends[0] > 0) & np.isfinite(ends[1])
        inside = _xy(curve.force, values) | {"low": ends[0], "high": ends[1]}
        series["interval"] = {axis: each[mask] for axis, each in inside.items()}
    return series


def model_panels(found: ModelComparison) -> Panels:
    """Stiffness of both models over force, with the intervals of their means."""
    result, columns, rows = found.comparison, *comparison_table(found)
    full, reduced = result.full.mean, result.reduced
    of_lines = {"low": reduced.low, "high": reduced.high}
    series = {
        "full": _xy(result.force_bar, full) | {"low": full, "high": full},
        "reduced": _xy(result.force_bar, reduced.mean) | of_lines,
    }
    return {"models": PanelContent.fitted(series, columns=columns, rows=rows)}


def _map(
    heights: Real, sides: Sequence[float], along: ShownUnit, up: ShownUnit, **others: Any
) -> Map:
    """A map of heights; a missing point shows in each pixel that has one."""
    heights = heights * up[0]
    unknown, pixels = any_marked(~np.isfinite(heights)), np.array(thinned(heights))
    pixels[unknown[: pixels.shape[0], : pixels.shape[1]]] = np.nan
    others |= {"table": (["heights", ""], _rows(heights, up[1])), **_frame(sides, along)}
    return height_map(pixels, up[1], blank="here", **others)


def _frame(sides: Sequence[float], along: ShownUnit) -> dict[str, Any]:
    return {"sizes": [side * along[0] for side in sides], "along": along[1]}


def _along(
    series: dict[str, Points], along: ShownUnit, up: ShownUnit, **others: Any
) -> PanelContent:
    """Heights along a line."""
    axes = (f"x [{along[1]}]", f"height [{up[1]}]")
    return PanelContent.fitted(series, is_logarithmic=False, axes=axes, **others)


def _line(x: Real, heights: Real) -> Points:
    """Every few points of a line, with the digits that a picture shows."""
    step = max(1, heights.size // _MOST_LINE_POINTS)
    return _xy(*([float(f"{value:.6g}") for value in each[::step]] for each in (x, heights)))


def _spectrum(found: Description) -> Panels:
    """The spectrum with the nearest law, as the reports draw it."""
    parameters = found.roughness
    if parameters is None or parameters.spectrum is None or parameters.power is None:
        return {}
    power, fit, law = parameters.power, parameters.fit, parameters.law
    q, power = parameters.spectrum.q[power > 0], power[power > 0]
    label = f"spectrum C [{'m⁴' if isinstance(found.body, Surface) else 'm³'}]"
    some = np.unique(np.geomspace(1, q.size, 40).astype(int)) - 1
    series = {"spectrum": _xy(q, power), "law": _xy(*((), ()) if law is None else law)}
    panel = PanelContent.fitted(series, axes=("", label), columns=["q [1/m]", label])
    panel.caption = "" if fit is None else fit.in_words
    panel.rows = [[f"{q[i]:.2e}", f"{power[i]:.2e}"] for i in some]
    return {"spectrum": panel}


def _shares(marked: NDArray[np.bool_], most: int) -> list[list[float]]:
    """Where points are that are marked, up to a number of them, in sides of the map."""
    places: list[list[float]] = ((np.argwhere(marked)[:most] + 0.5) / marked.shape).tolist()
    return places


def _rows(heights: Real, unit: str) -> list[list[str]]:
    """Heights in numbers."""
    known = heights[np.isfinite(heights)]
    unit = "" if unit == "unit not stated" else unit
    return [
        [name, f"{figure(float(np.percentile(known, share)))} {unit}"]
        for name, share in _PERCENTILES.items()
        if known.size
    ]


def _about_mean(body: Body) -> Real:
    return np.asarray(body.heights - body.heights.mean())


def _places(count: int, length: float) -> Real:
    """Where points along a line are."""
    return np.asarray((np.arange(count) + 0.5) * length / count)


def _xy(x: Any, y: Any) -> dict[str, Any]:
    return {"x": x, "y": y}


def _scale(largest: float, metres: float | None, otherwise: str = "m") -> ShownUnit:
    """The factor to a handy unit, and its sign; without metres the file's own numbers stay."""
    if metres is None:
        return 1.0, otherwise
    factor, prefixed = prefix(largest * metres, "m")
    return metres * factor, prefixed


def _largest(values: Real) -> float:
    return float(np.nanmax(values, initial=0.0))
