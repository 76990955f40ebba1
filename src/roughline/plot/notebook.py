"""What a notebook shows: a table of numbers, and a picture where there is one."""

from __future__ import annotations

import base64
import io
from collections.abc import Iterable, Sequence
from html import escape

import numpy as np
from matplotlib.figure import Figure

from roughline.computing.arrays import Real
from roughline.computing.notebook import in_notebook
from roughline.contact.curve import Curve, LineCurve, SurfaceCurve
from roughline.contact.fields import Fields
from roughline.contact.quantities import unit_name
from roughline.contact.status import Status
from roughline.creep.press_creep import CreepCurve
from roughline.fluid.flow import Flow
from roughline.fluid.reopening import Reopening
from roughline.fluid.sealing_pressure import SealingPressure
from roughline.plot.bodies import draw_pressure
from roughline.plot.flows import draw_flow
from roughline.plot.pixels import show_map
from roughline.plot.style import COLUMN, new_figure, styled
from roughline.topography.body import Body, Surface, side_lengths
from roughline.topography.borders import whole_or_piece
from roughline.units import MOST_DIGITS, decimal, digits_known, in_words

_WIDTH, _HEIGHT = 3.2, 1.6  # of a thumbnail [inch]
_PICTURE_HEIGHT = 2.6  # height of a picture with axes [inch]
_DPI = 100
_MOST_POINTS = 2000  # of a line in a thumbnail
_MOST_PIXELS = 200  # of a surface in a thumbnail, along a side
_FIRST_LOADS, _LAST_LOADS = 12, 4  # loads of a long curve that are shown


@in_notebook.register
def _body_html(body: Body) -> str:
    """A table, and a picture of the heights."""
    is_surface = isinstance(body, Surface)
    rows = [
        ("points", " × ".join(map(str, body.heights.shape))),
        (
            "sizes" if is_surface else "length",
            " × ".join(in_words(side, body.unit) for side in side_lengths(body)),
        ),
        ("rms height", in_words(body.rms_height, body.unit)),
        ("peak to valley", in_words(float(np.ptp(body.heights)), body.unit)),
        ("rms slope", decimal(body.rms_slope, MOST_DIGITS)),
        ("unit of lengths", body.unit or "not stated"),
        ("trend removed", body.removed_trend),
        ("borders" if is_surface else "ends", whole_or_piece(body)),
    ]
    kind = "Surface" if isinstance(body, Surface) else f"Line, {body.kind}"
    return html(kind, ("", ""), rows, _thumbnail(body.heights))


@in_notebook.register
def _curve_html(curve: Curve) -> str:
    """A table of the loads."""
    # name, values, their errors and their dimension; None for numbers
    columns: list[tuple[str, Real, Real | None, str | None]] = [
        ("depth d", curve.depth, None, "length"),
        ("force F", curve.force, None, "force"),
    ]
    model = "reduced model"
    if isinstance(curve, SurfaceCurve):
        model = f"full model, {curve.half_space.boundary} half-space"
        columns.append(("stiffness k", curve.stiffness, curve.stiffness_error, "force/length"))
        if curve.hardness is not None:
            unloading = curve.unloading_stiffness, curve.unloading_stiffness_error
            columns.append(("unloading stiffness", *unloading, "force/length"))
        area = curve.area_fraction_corrected, curve.area_fraction_error
        columns.append(("raw area", curve.area_fraction, None, None))
        columns.append(("corrected area A/A_0", *area, None))
    else:
        columns.append(("stiffness k", curve.stiffness, None, "force/length"))
    if isinstance(curve, LineCurve) and curve.area_fraction is not None:
        columns.append(("area A/A_0", curve.area_fraction, None, None))
    title = f"Curve of the {model}, E* = {_with_unit(curve.E_star, 'pressure', curve.unit)}"
    header = ["load", *(name for name, *_ in columns), "remark"]
    reached = np.flatnonzero(curve.status != Status.INTERRUPTED)
    rows = [
        [
            str(i),
            *(_cell(i, values, errors, kind, curve.unit) for _, values, errors, kind in columns),
            _remark(curve, i),
        ]
        for i in reached[_listed_loads(reached.size)].tolist()
    ]
    if len(rows) < reached.size:
        rows.insert(_FIRST_LOADS, ["…"] * len(header))
    if left := curve.status.size - reached.size:  # told once
        missing = ["–"] * len(columns)
        rows.append([f"{left} of {curve.status.size}", *missing, Status.INTERRUPTED.reason])
    return html(title, header, rows, remarks=curve.warnings)


@in_notebook.register
def _creep_html(curve: CreepCurve) -> str:
    """A table of the times, and the quantities over them."""
    unit = curve.elastic.unit
    columns: list[tuple[str, Real, str | None]] = [
        ("depth d", curve.depth, "length"),
        ("force F", curve.force, "force"),
        ("instantaneous stiffness", curve.instantaneous_stiffness, "force/length"),
    ]
    if curve.area_fraction_corrected is not None:
        columns.append(("corrected area A/A_0", curve.area_fraction_corrected, None))
    rows = [
        [decimal(float(curve.time[i]), MOST_DIGITS)]
        + [_cell(i, values, None, kind, unit) for _, values, kind in columns]
        for i in _listed_loads(curve.time.size)
    ]
    if len(rows) < curve.time.size:
        rows.insert(_FIRST_LOADS, ["…"] * (1 + len(columns)))
    with styled():
        figure = new_figure(COLUMN, _PICTURE_HEIGHT)
        # the one of both that is not held, as a rule
        changes = [float(np.ptp(values) / np.abs(values).max()) for _, values, _ in columns[:2]]
        name, drawn, _ = columns[int(np.argmax(changes))]
        axes = figure.subplots()
        axes.plot(curve.time, drawn, ".-")
        axes.set(xlabel="time", ylabel=name)
        picture = png(figure)
    E_star = _with_unit(curve.elastic.E_star, "pressure", unit)
    header = ["time", *(name for name, *_ in columns)]
    title = f"Contact that creeps, E* = {E_star} at once"
    return html(title, header, rows, picture, curve.warnings)


@in_notebook.register
def _fields_html(fields: Fields) -> str:
    """A table of means, and the pressure."""
    rows = [
        ("points", " × ".join(map(str, fields.gap.shape))),
        ("sizes", " × ".join(_number(side) for side in fields.sizes)),
        ("mean pressure", _number(float(fields.pressure.mean()))),
        ("largest pressure", _number(float(fields.pressure.max()))),
        ("contact area A/A_0", _number(float(fields.contact.mean()))),
        ("mean gap", _number(float(fields.gap.mean()))),
    ]
    with styled():
        figure = new_figure(COLUMN, _PICTURE_HEIGHT)
        draw_pressure(figure.subplots(), fields, None)
        picture = png(figure)
    return html("Fields of a load", ("", ""), rows, picture)


@in_notebook.register
def _flow_html(flow: Flow) -> str:
    """A table of what flows, and where."""
    aperture = "0, sealed" if flow.is_sealed else _number(flow.hydraulic_aperture)
    rows = [
        ("cells", " × ".join(map(str, flow.gap.shape))),
        ("sizes", " × ".join(_number(side) for side in flow.sizes)),
        ("sides", flow.sides),
        ("hydraulic aperture u_h", aperture),
        ("permeance Λ", _number(flow.permeance)),
        ("share of the strongest channel", _number(flow.largest_share)),
        ("imbalance of the flows", f"{flow.imbalance:.1g}"),
    ]
    with styled():
        figure = new_figure(COLUMN, COLUMN)
        draw_flow(figure.subplots(), flow, None)
        picture = png(figure)
    remarks = [flow.validity] if flow.validity else []
    return html(f"Flow along {flow.along}", ("", ""), rows, picture, remarks)


@in_notebook.register
def _sealing_html(found: SealingPressure) -> str:
    """Both ends, the interval, and what coarser grid and quarters give."""
    areas = " to ".join(map(_number, found.area_fractions))
    title = f"Mean pressure at which the gap seals, along {found.along}"
    return _search_html(found, title, [("contact area A/A_0", areas)])


@in_notebook.register
def _reopening_html(found: Reopening) -> str:
    """Both shares, the interval, and what coarser grid and quarters give."""
    apertures = ", ".join(map(_number, found.apertures))
    title = f"Share of the load down to which less than {_number(found.times)} times as much leaks"
    return _search_html(found, title, [("apertures under the load and at both shares", apertures)])


def _search_html(
    found: SealingPressure | Reopening, title: str, further: list[tuple[str, str]]
) -> str:
    """A table of what was found, and a picture of what leaves it open."""
    rows = [("found", f"{_number(found.low)} to {_number(found.high)}"), *further]
    on: list[tuple[str, Sequence[float]]] = [("found", [found.low, found.high])]
    if np.isfinite(found.interval).all():
        rows.append(("interval", " to ".join(map(_number, found.interval))))
        on.append(("interval", found.interval))
    if np.isfinite(found.on_half):
        rows.append(("on half as many points", _number(found.on_half)))
        on.append(("half as many points", [found.on_half]))
    if len(found.on_quarters):
        rows.append(("of the four quarters", ", ".join(map(_number, found.on_quarters))))
        on.append(("quarters", found.on_quarters))
    with styled():
        figure = new_figure(COLUMN, _HEIGHT)
        axes = figure.subplots()
        for place, (name, values) in enumerate(on):
            look = "|-" if name in ("found", "interval") else "o"
            axes.plot(values, [place] * len(values), look, color="k")
        axes.set_yticks(range(len(on)), [name for name, _ in on])
        axes.set_ylim(len(on) - 0.5, -0.5)
        picture = png(figure)
    return html(title, ("", ""), rows, picture)


def _number(value: float) -> str:
    return decimal(value, MOST_DIGITS)


def html(
    title: str,
    header: Sequence[str],
    rows: Iterable[Sequence[str]],
    picture: bytes = b"",
    remarks: Iterable[str] = (),
) -> str:
    """Return a table under a title as HTML, with a picture (PNG) beside it, and remarks below."""
    heads = "".join(f"<th>{escape(cell)}</th>" for cell in header) if any(header) else ""
    body = "".join(
        "<tr>" + "".join(f"<td>{escape(cell)}</td>" for cell in row) + "</tr>" for row in rows
    )
    table = f"<table><thead><tr>{heads}</tr></thead><tbody>{body}</tbody></table>"
    image = ""
    if picture:
        data = base64.b64encode(picture).decode()
        image = f'<img alt="{escape(title)}" src="data:image/png;base64,{data}">'
    side_by_side = "display:flex;flex-wrap:wrap;gap:1em;align-items:center"
    below = "".join(f"<div>{escape(remark)}</div>" for remark in remarks)
    beside = f'<div style="{side_by_side}">{table}{image}</div>'
    return f"<div><b>{escape(title)}</b>{beside}{below}</div>"


def png(figure: Figure, *, transparent: bool = False) -> bytes:
    """Return a figure as a PNG."""
    written = io.BytesIO()
    figure.savefig(written, format="png", dpi=_DPI, transparent=transparent)
    return written.getvalue()


def _thumbnail(heights: Real) -> bytes:
    """Draw heights on few pixels: a surface from above, a line from the side."""
    figure = Figure(figsize=(_WIDTH, _HEIGHT), dpi=_DPI)
    axes = figure.add_axes((0, 0, 1, 1))
    axes.set_axis_off()
    if heights.ndim == 2:
        nx, ny = (max(1, n // _MOST_PIXELS) for n in heights.shape)
        few = heights[::nx, ::ny]
        show_map(axes, few, (few.shape[0], few.shape[1]), cmap="cividis")
    else:
        axes.plot(heights[:: max(1, heights.size // _MOST_POINTS)], linewidth=0.6)
    return png(figure, transparent=True)


def _with_unit(
    value: float, dimension: str | None, unit: str | None, error: float | None = None
) -> str:
    """Write a value with the digits that its error supports, in SI where lengths are in metres."""
    named = unit_name(dimension, "m") if dimension and unit == "m" else None
    return in_words(value, named, digits_known(value, error))


def _cell(
    load: int, values: Real, errors: Real | None, dimension: str | None, unit: str | None
) -> str:
    value = float(values[load])
    if not np.isfinite(value):
        return "infinite" if np.isinf(value) else "–"
    return _with_unit(value, dimension, unit, None if errors is None else float(errors[load]))


def _remark(curve: Curve, load: int) -> str:
    status = Status(curve.status[load])
    if status != Status.CONVERGED:
        return status.reason
    return "" if curve.resolved[load] or curve.force[load] == 0 else "the grid decides"


def _listed_loads(count: int) -> list[int]:
    """Return which loads are shown: the first and the last of many."""
    if count <= _FIRST_LOADS + _LAST_LOADS:
        return list(range(count))
    return [*range(_FIRST_LOADS), *range(count - _LAST_LOADS, count)]
