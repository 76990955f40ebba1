"""What a notebook shows: of a body its heights, of a curve a table of its loads."""

from __future__ import annotations

import base64
import io
from collections.abc import Iterable, Sequence
from html import escape

import numpy as np
from matplotlib.figure import Figure

from roughline.computing.arrays import Real
from roughline.computing.notebook import in_notebook
from roughline.contact.curve import Curve
from roughline.contact.quantities import unit_of
from roughline.contact.status import Status
from roughline.topography.body import Body, Surface, sides_of
from roughline.topography.borders import whole_or_piece
from roughline.units import MOST_DIGITS, decimal, digits_known, in_words

_WIDTH, _HEIGHT = 3.2, 1.6  # of a thumbnail [inch]
_MOST_POINTS = 2000  # of a line in a thumbnail
_MOST_PIXELS = 200  # of a surface in a thumbnail, along a side
_FIRST, _LAST = 12, 4  # loads of a long curve that are shown


@in_notebook.register
def _of_body(body: Body) -> str:
    """A table, and a picture of the heights."""
    is_surface = isinstance(body, Surface)
    rows = [
        ("points", " × ".join(map(str, body.heights.shape))),
        (
            "sizes" if is_surface else "length",
            " × ".join(in_words(side, body.unit) for side in sides_of(body)),
        ),
        ("rms height", in_words(body.rms_height, body.unit)),
        ("peak to valley", in_words(float(np.ptp(body.heights)), body.unit)),
        ("rms slope", decimal(body.rms_slope, MOST_DIGITS)),
        ("unit of lengths", body.unit or "not stated"),
        ("trend removed", body.removed_trend),
        ("borders" if is_surface else "ends", whole_or_piece(body)),
    ]
    kind = "Surface" if isinstance(body, Surface) else f"Line, {body.kind}"
    return _html(kind, ("", ""), rows, _thumbnail(body.heights))


@in_notebook.register
def _of_curve(curve: Curve) -> str:
    """A table of the loads."""
    # name, values, their errors and their dimension; None for numbers
    columns: list[tuple[str, Real, Real | None, str | None]] = [
        ("depth d", curve.depth, None, "length"),
        ("force F", curve.force, None, "force"),
        ("stiffness k", curve.stiffness, curve.stiffness_error, "force/length"),
    ]
    if curve.hardness is not None and curve.unloading_stiffness is not None:
        unloading = curve.unloading_stiffness, curve.unloading_stiffness_error
        columns.append(("unloading stiffness", *unloading, "force/length"))
    if curve.area_fraction is not None:
        columns.append(("raw area", curve.area_fraction, None, None))
    if curve.area_fraction_corrected is not None:
        area = curve.area_fraction_corrected, curve.area_fraction_error
        columns.append(("corrected area A/A_0", *area, None))
    model = "reduced model" if curve.area_fraction is None else "full model"
    place = "" if curve.area_fraction is None else f", {curve.half_space.boundary} half-space"
    title = f"Curve of the {model}{place}, E* = {_with_unit(curve.E_star, 'pressure', curve.unit)}"
    header = ["load", *(name for name, *_ in columns), "remark"]
    reached = np.flatnonzero(curve.status != Status.INTERRUPTED)
    rows = [
        [
            str(i),
            *(_cell(i, values, errors, kind, curve.unit) for _, values, errors, kind in columns),
            _remark(curve, i),
        ]
        for i in reached[_shown(reached.size)].tolist()
    ]
    if len(rows) < reached.size:
        rows.insert(_FIRST, ["…"] * len(header))
    if left := curve.status.size - reached.size:  # told once
        missing = ["–"] * len(columns)
        rows.append([f"{left} of {curve.status.size}", *missing, Status.INTERRUPTED.reason])
    return _html(title, header, rows)


def _html(
    title: str, header: Sequence[str], rows: Iterable[Sequence[str]], picture: bytes = b""
) -> str:
    """Return a table under a title as HTML, with a picture (PNG) beside it."""
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
    return f'<div><b>{escape(title)}</b><div style="{side_by_side}">{table}{image}</div></div>'


def _thumbnail(heights: Real) -> bytes:
    """Draw heights on few pixels: a surface from above, a line from the side."""
    figure = Figure(figsize=(_WIDTH, _HEIGHT), dpi=100)
    axes = figure.add_axes((0, 0, 1, 1))
    axes.set_axis_off()
    if heights.ndim == 2:
        nx, ny = (max(1, n // _MOST_PIXELS) for n in heights.shape)
        axes.imshow(heights[::nx, ::ny].T, origin="lower", cmap="cividis")
    else:
        axes.plot(heights[:: max(1, heights.size // _MOST_POINTS)], linewidth=0.6)
    written = io.BytesIO()
    figure.savefig(written, format="png", transparent=True)
    return written.getvalue()


def _with_unit(
    value: float, dimension: str | None, unit: str | None, error: float | None = None
) -> str:
    """Write a value with the digits that its error supports, in SI where lengths are in metres."""
    named = unit_of(dimension, "m") if dimension and unit == "m" else None
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


def _shown(count: int) -> list[int]:
    """Return which loads are shown: the first and the last of many."""
    if count <= _FIRST + _LAST:
        return list(range(count))
    return [*range(_FIRST), *range(count - _LAST, count)]
