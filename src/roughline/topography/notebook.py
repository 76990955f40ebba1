"""How bodies are displayed: as a line of text at a prompt, with a picture in a notebook."""

from __future__ import annotations

import base64
import io
from collections.abc import Iterable, Sequence
from html import escape
from typing import Any

import numpy as np

from roughline.computing.arrays import Real
from roughline.topography.borders import whole_or_piece
from roughline.units import MOST_DIGITS, decimal, in_words

_WIDTH, _HEIGHT = 3.2, 1.6  # of a thumbnail [inch]
_MOST_POINTS = 2000  # of a line in a thumbnail
_MOST_PIXELS = 200  # of a surface in a thumbnail, along a side


def described(body: Any) -> str:
    """Describe a body in a line: its points, sizes, rms height, and whether it is a piece."""
    points = " × ".join(map(str, body.heights.shape))
    sizes = " × ".join(in_words(side, body.unit) for side in _sizes(body))
    rms = in_words(body.rms_height, body.unit)
    name, kind = type(body).__name__, whole_or_piece(body)
    return f"<{name}: {points} points, {sizes}, rms height {rms}, {kind}>"


def html_of_body(body: Any) -> str:
    """Return what a notebook shows of a body: a table and a picture of its heights."""
    surface = body.heights.ndim == 2
    rows = [
        ("points", " × ".join(map(str, body.heights.shape))),
        (
            "sizes" if surface else "length",
            " × ".join(in_words(x, body.unit) for x in _sizes(body)),
        ),
        ("rms height", in_words(body.rms_height, body.unit)),
        ("peak to valley", in_words(float(np.ptp(body.heights)), body.unit)),
        ("rms slope", decimal(body.rms_slope, MOST_DIGITS)),
        ("unit of lengths", body.unit or "not stated"),
        ("trend removed", body.removed_trend),
        ("borders" if surface else "ends", whole_or_piece(body)),
    ]
    kind = "Surface" if surface else f"Line, {body.kind}"
    return html(kind, ("", ""), rows, _thumbnail(body.heights))


def html(
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


def _sizes(body: Any) -> tuple[float, ...]:
    return body.sizes if body.heights.ndim == 2 else (body.length,)


def _thumbnail(heights: Real) -> bytes:
    """Draw heights on few pixels: a surface from above, a line from the side."""
    from matplotlib.figure import Figure  # here because it loads slowly

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
