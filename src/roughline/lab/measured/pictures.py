"""Heights, spectra, contacts and curves as the page draws them, in handy units.

A panel is told its map, the columns of its sources, what its axes are called, its caption and its
table; None hides it. A column that is a text is an array by its name.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np
from numpy.typing import NDArray

import roughline as rl
from roughline.assessment.assessment import Assessment
from roughline.assessment.comparison import ModelComparison
from roughline.assessment.description import Description
from roughline.contact.fields import Fields
from roughline.lab.maps import flux_map
from roughline.plot.pixels import any_marked, thinned
from roughline.report.comparison import comparison_table
from roughline.report.contact_tables import area_in_words, curve_table
from roughline.report.values import three_digits
from roughline.topography.body import Body, Surface, sides_of
from roughline.topography.preparation import outliers
from roughline.units import engineering, metres_per, prefix

_Real = NDArray[np.float64]
_Mask = NDArray[np.bool_]
_Unit = tuple[float, str]  # factor to a handy unit, and its sign
Panel = dict[str, Any]
Drawn = tuple[dict[str, Panel | None], dict[str, NDArray[Any]]]
"""Panels by their names, and arrays that they show."""

_MOST_SPIKES = 2000  # that are marked
_MOST_SPOTS = 100  # points in contact that are marked
_MOST_LINE_POINTS = 8000  # that are drawn
_MOST = (0.1, 99.9)  # of heights, without spikes [%]
_CURVES = {"stiffness": "stiffness", "area": "real contact area"}
_SHARES = {"lowest": 0, "lowest tenth below": 10, "median": 50, "highest tenth above": 90}


def of_file(found: Description) -> Drawn:
    """Heights as the file has them, its spikes marked where there is a body, and its spectrum."""
    content, body = found.measurement, found.body
    metres = metres_per(content.unit) if content.unit else None
    heights = np.array(np.ma.getdata(content.heights), dtype=np.float64)
    heights[content.unknown] = np.nan
    spikes = None
    if body is not None and body.heights.shape == heights.shape:
        spikes = outliers(body)
    sides = content.sizes or tuple(map(float, heights.shape))
    otherwise = "unit not stated" if content.sizes else "points"
    along = _unit(max(sides), metres if content.sizes else None, otherwise)
    up = _unit(_span(heights), metres, "unit not stated")
    known = heights[np.isfinite(heights)] * up[0]
    panel, arrays = _heights("file", heights, sides, along, up)
    marked = _marked(spikes, sides, along[0], heights * up[0])
    told = "spikes are looked for once unit and size are known"
    if spikes is not None:
        told = f"{np.count_nonzero(spikes)} spikes"
    panel["table"] = [["heights", ""], _rows(known, up[1])]
    if heights.ndim == 2:
        panel["sources"] = {"file rings": marked}
        panel["caption"] = f"orange: missing points; rings: spikes; {told}"
        panels = {"measured-file": panel, "measured-file-line": None}
    else:
        missing = _places(heights.size, sides[0] * along[0])[~np.isfinite(heights)][:_MOST_SPIKES]
        foot = np.full(missing.size, known.min(initial=np.inf))
        panel["sources"] |= {"file line spikes": marked, "file line missing": _xy(missing, foot)}
        panel["caption"] = f"crosses: missing points; rings: spikes; {told}"
        panels = {"measured-file": None, "measured-file-line": panel}
    return {**panels, "measured-spectrum": _spectrum(found)}, arrays


def of_preparation(before: Body, after: Body, crop: Sequence[float] | None) -> Drawn:
    """Heights before and after, with the same units and colours; the piece that is kept [m]."""
    along, up = _unit(max(sides_of(before)), 1.0), _unit(_span(_about_mean(before)), 1.0)
    corner = [end * along[0] for end in (crop or (0.0, 0.0, 0.0, 0.0))[::2]]
    is_map, drawn, spans = isinstance(after, Surface), list[Panel](), list[_Real]()
    arrays: dict[str, NDArray[Any]] = {}
    for name, body in (("before", before), ("after", after)):
        heights, shift = _about_mean(body), corner if name == "after" else [0.0, 0.0]
        full = name if is_map else f"prepared line {name}"
        panel, some = _heights(full, heights, sides_of(body), along, up, shift)
        panel["table"] = [["heights", ""], _rows(heights.ravel() * up[0], up[1])]
        spans.append(np.percentile(heights * up[0], _MOST))
        drawn.append(panel)
        arrays |= some
    old, new = drawn
    hidden: Panel = dict.fromkeys(("measured-before", "measured-after", "measured-prepared-line"))
    if not is_map:
        rows = zip(old["table"][1], new["table"][1], strict=True)
        table = [["heights", "before", "after"], [[*one, other[1]] for one, other in rows]]
        both = {"sources": old["sources"] | new["sources"], "table": table}
        return {**hidden, "measured-prepared-line": old | both}, arrays
    for panel in drawn:
        panel["map"]["look"] |= {
            "low": min(low for low, _ in spans),
            "high": max(high for _, high in spans),
        }
    width, height = new["map"]["sizes"]
    box = {"left": corner[0], "right": corner[0] + width, "bottom": corner[1]}
    old["models"] = {"crop box": {"visible": crop is not None, "top": corner[1] + height, **box}}
    old["caption"] = "about the mean, as read; draw a box to keep a piece"
    new["caption"] = f"{' x '.join(map(str, after.heights.shape))} points"
    return {**hidden, "measured-before": old, "measured-after": new}, arrays


def _about_mean(body: Body) -> _Real:
    return np.asarray(body.heights - body.heights.mean())


def _heights(
    name: str,
    heights: _Real,
    sides: Sequence[float],
    along: _Unit,
    up: _Unit,
    corner: Sequence[float] = (0.0, 0.0),
) -> tuple[Panel, dict[str, NDArray[Any]]]:
    """A map or a line of heights, and its arrays."""
    sizes = [side * along[0] for side in sides]
    if heights.ndim == 1:
        step = max(1, heights.size // _MOST_LINE_POINTS)
        x = corner[0] + _places(heights.size, sizes[0])[::step]
        columns = {"x": f"{name} x", "y": f"{name} heights"}
        source = "file line heights" if name == "file" else name
        panel: Panel = {"sources": {source: columns}, "extent": f"{sizes} {along[1]}"}
        panel["axes"] = [f"x [{along[1]}]", f"height [{up[1]}]"]
        return panel, {f"{name} x": x, f"{name} heights": heights[::step] * up[0]}
    unknown = ~np.isfinite(heights)
    marked, shown = any_marked(unknown), thinned(heights) * up[0]
    shown[marked[: shown.shape[0], : shown.shape[1]]] = np.nan
    known = heights[~unknown] * up[0]
    ends = [float(known.min()), float(known.max())] if known.size else [0.0, 1.0]
    array = f"{name} heights"
    look: dict[str, Any] = {"palette": "Cividis256", "low": ends[0], "high": ends[1]}
    look |= {"title": "height", "unit": up[1], "array": array}
    image: dict[str, Any] = {"name": name, "array": array, "sizes": sizes, "corner": corner}
    image |= {"look": look, "layers": {"height": look}, "along": along[1]}
    image["frame"] = sizes if name != "after" else None  # which lies in that of before
    return {"map": image}, {array: shown.T}


def _spectrum(found: Description) -> Panel | None:
    """The spectrum with the nearest law, as the reports draw it."""
    parameters = found.roughness
    if parameters is None or parameters.spectrum is None or parameters.power is None:
        return None
    power, fit, law = parameters.power, parameters.fit, parameters.law
    q, power = parameters.spectrum.q[power > 0], power[power > 0]
    label = f"spectrum C [{'m⁴' if isinstance(found.body, Surface) else 'm³'}]"
    some = np.unique(np.geomspace(1, q.size, 40).astype(int)) - 1
    waves, kept = ([], []) if law is None else (each[np.isfinite(law[1])] for each in law)
    return {
        "sources": {
            "spectrum": _xy(q, power),
            "spectrum law": _xy(waves, kept),
        },
        "axes": [None, label],
        "caption": "" if fit is None else f"H = {fit.hurst_in_words}",
        "table": [["q [1/m]", label], [[f"{q[i]:.3g}", f"{power[i]:.3g}"] for i in some]],
    }


def _marked(
    marks: _Mask | None, sides: Sequence[float], scale: float, heights: _Real
) -> dict[str, Any]:
    """Where some points are marked, up to a number that can be seen."""
    if marks is None:
        return _xy((), ())
    shown = np.argwhere(marks)[:_MOST_SPIKES]
    columns = [
        (shown[:, i] + 0.5) * scale * side / n
        for i, (side, n) in enumerate(zip(sides, marks.shape, strict=True))
    ]
    return _xy(columns[0], columns[1] if marks.ndim == 2 else heights[marks][:_MOST_SPIKES])


def _rows(known: _Real, unit: str) -> list[list[str]]:
    """Heights in numbers, for those who do not see the map."""
    if not known.size:
        return []
    unit = "" if unit == "unit not stated" else unit
    return [
        [name, f"{three_digits(float(np.percentile(known, share)))} {unit}"]
        for name, share in (_SHARES | {"highest": 100}).items()
    ]


def _places(count: int, length: float) -> _Real:
    """Where points along a line are."""
    return np.asarray((np.arange(count) + 0.5) * length / count)


def _xy(x: Any, y: Any) -> dict[str, Any]:
    return {"x": x, "y": y}


def _span(heights: _Real) -> float:
    known = heights[np.isfinite(heights)]
    return float(np.abs(known).max()) if known.size else 0.0


def _unit(largest: float, metres: float | None, otherwise: str = "m") -> _Unit:
    """The factor to a handy unit, and its sign; without metres the file's own numbers stay."""
    if metres is None:
        return 1.0, otherwise
    factor, prefixed = prefix(largest * metres, "m")
    return metres * factor, prefixed


def of_contact(
    result: Assessment,
) -> tuple[dict[str, Panel | None], dict[str, Panel], dict[str, NDArray[Any]]]:
    """The topography, the contact at the load with fields by what it shows, and their arrays."""
    surface = result.body
    if not isinstance(surface, Surface):
        return {"measured-topography": None}, {}, {}
    along = _unit(max(surface.sizes), 1.0)
    heights = _about_mean(surface)
    up = _unit(_span(heights), 1.0)
    topography, arrays = _heights("topography", heights, surface.sizes, along, up)
    topography["caption"] = "heights about their mean"
    topography["table"] = [["heights", ""], _rows(heights.ravel() * up[0], up[1])]
    shown = next((i for i, each in enumerate(result.curve.fields) if each is not None), None)
    if shown is None:
        unsolved: Panel = {"caption": "the load was not solved"}
        return {"measured-topography": topography}, {"area": unsolved}, arrays
    fields = result.curve.fields[shown]
    assert fields is not None
    force = engineering(float(result.curve.force[shown]) * result.scale, "N", 3)
    load = f"corrected area {area_in_words(result, shown)} at {force}"
    few = np.count_nonzero(fields.contact) <= _MOST_SPOTS
    spots = _marked(fields.contact if few else None, surface.sizes, along[0], heights)
    marks = fields.contact.astype(np.uint8) + fields.plastic
    yields = ["plastic"] if result.curve.hardness is not None else []
    looks, some = _of_fields(fields)
    looks["area"] = {"palette": "marks", "caption": "", "marks": ["ink", *yields], "title": ""}
    looks["area"] |= {"low": 0, "high": 2}
    arrays |= some | {"area": any_marked(marks).T}
    largest = [
        [f"largest {name}", f"{three_digits(each['high'])} {each['unit']}"]
        for name, each in looks.items()
        if name != "area"
    ]
    if result.flows:  # along the leakier of the directions that are asked
        flow = max(result.flows, key=lambda each: each.hydraulic_aperture)
        arrays["flux"], looks["flux"] = _flux(flow, topography["map"]["sizes"])
    topography["map"]["layers"] |= looks
    if "gap" in looks:
        looks["gap"]["factor"] = up[0] / looks["gap"]["per_metre"]  # to the unit of the heights
    told = f"; {load}" + ("; rings: the few points that touch" if few and len(spots["x"]) else "")
    panels = {
        name: topography
        | {
            "map": topography["map"] | {"name": "contact", "array": name, "look": look},
            "sources": {"contact rings": look.get("ring") or spots},
            "caption": look["caption"],
            "marks": look.get("marks", []),
            "more": told,
            "table": [["quantity", "value"], [["contact", load], *largest]],
        }
        for name, look in sorted(looks.items(), key=lambda each: each[0] != "area")
    }
    return {"measured-topography": topography}, panels, arrays


def _of_fields(fields: Fields) -> tuple[dict[str, dict[str, Any]], dict[str, NDArray[Any]]]:
    """How the fields of a contact are drawn, and their arrays."""
    looks, arrays = {}, {}
    for name, values, unit, title, palette in (
        ("pressure", fields.pressure, "Pa", "pressure", "Viridis256"),
        ("gap", np.maximum(fields.gap, 0), "m", "gap", "Cividis256"),  # rounding leaves it below
        ("displacement", fields.displacement, "m", "deflection", "Cividis256"),
    ):
        factor, prefixed = prefix(_largest(np.abs(values)), unit)
        arrays[name] = thinned(values).T * factor
        look: dict[str, Any] = {"palette": palette, "caption": "", "title": title}
        look |= {
            "unit": prefixed,
            "low": 0,
            "high": _largest(values) * factor or 1.0,
            "per_metre": factor,
        }
        looks[name] = look | {"nothing": "in contact" if name == "gap" else "", "blank": "paper"}
    return looks, arrays


def _flux(flow: rl.Flow, sizes: Sequence[float]) -> tuple[NDArray[Any], dict[str, Any]]:
    """The map of a flow, with its ring in the units of the axes."""
    drawn = flux_map(flow)
    caption = f"{drawn.caption}; {'from left to right' if flow.along == 'x' else 'upwards'}"
    if flow.sides == "periodic":
        caption += ", the map repeated on all sides"
    ring = [share * side for share, side in zip(drawn.ring or (), sizes, strict=False)]
    look = {**drawn.look, "caption": caption, "ring": _xy(ring[:1], ring[1:])}
    return thinned(drawn.values).T, look


def of_curve(result: Assessment) -> dict[str, Panel | None]:
    """Stiffness and area over force with their intervals, and theories beside them."""
    curve, solved, scale = result.curve, result.curve.converged, result.scale
    per_force, force_unit = prefix(scale * _largest(curve.force[solved]), "N")
    per_stiffness, unit = prefix(scale * _largest(curve.stiffness[solved]), "N/m")
    per_force, per_stiffness = scale * per_force, scale * per_stiffness
    force = curve.force[solved] * per_force
    kinds = {"line": None, "loads": curve.resolved[solved], "unsure": ~curve.resolved[solved]}
    kinds["asked"] = np.isin(np.flatnonzero(solved), result.asked)
    theories: dict[str, list[tuple[Any, ...]]] = {"stiffness": [], "area": []}
    for each in result.theories:
        x = each.pressure * result.area * per_force
        theories["area"].append((x, each.area_fraction, each.name))
        if each.stiffness is not None:
            y = each.stiffness * result.area * per_stiffness
            theories["stiffness"].append((x, y, each.name))
    axis = f"force F{'' if result.question.joint is None else ' on the joint'} [{force_unit}]"
    panels: dict[str, Panel | None] = {"measured-area": None}
    for name, values, ends, factor, label in (
        ("stiffness", curve.stiffness, result.stiffness_interval, per_stiffness, f"k [{unit}]"),
        ("area", curve.area_fraction_corrected, result.area_interval, 1.0, "A / A₀"),
    ):
        if values is None:
            continue
        shown = values[solved] * factor
        sources = {f"{name} {kind}": _points(force, shown, some) for kind, some in kinds.items()}
        low, high = [end[solved] * factor for end in ends] if ends else 2 * [shown * np.nan]
        kept = (low > 0) & np.isfinite(high)
        sources[f"{name} interval"] = {"x": force[kept], "low": low[kept], "high": high[kept]}
        xs, ys, names = zip(*theories[name], strict=True) if theories[name] else ((), (), ())
        sources[f"{name} theories"] = {"xs": xs, "ys": ys, "name": names}
        panels[f"measured-{name}"] = {
            "sources": sources,
            "axes": [axis, f"{_CURVES[name]} {label}"],
            "caption": f"dashed: {', '.join(names)}" if names else "",
            "table": curve_table(result),
            "extent": f"{force} {shown}",
        }
    back = None if curve.hardness is None else curve.unloading_stiffness
    unloading = _xy((), ()) if back is None else _points(force, back[solved] * per_stiffness)
    panels["measured-stiffness"] |= {  # type: ignore[operator]
        "sources": panels["measured-stiffness"]["sources"] | {"stiffness unloading": unloading},  # type: ignore[index]
    }
    return panels


def _points(force: _Real, values: _Real, wanted: _Mask | None = None) -> dict[str, Any]:
    """Points of a curve that are known, and wanted."""
    kept = np.isfinite(values) if wanted is None else np.isfinite(values) & wanted
    return _xy(force[kept], values[kept])


def of_models(found: ModelComparison) -> Panel:
    """Stiffness of both models over force, with the intervals of their means."""
    result = found.comparison
    x, full, reduced = result.force_bar, result.full.mean, result.reduced
    return {
        "sources": {
            "models full": {"x": x, "y": full, "low": full, "high": full},
            "models reduced": {
                "x": x,
                "y": reduced.mean,
                "low": reduced.low,
                "high": reduced.high,
            },
        },
        "table": comparison_table(found),
        "extent": f"{x} {full}",
    }


def _largest(values: _Real) -> float:
    return float(np.nanmax(values, initial=0.0))
