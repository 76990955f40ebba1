"""Figures of one topography: its heights, its spectrum, its curve, and its contact."""

from __future__ import annotations

from functools import partial
from itertools import cycle
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from roughline.contact.curve import SurfaceCurve
from roughline.contact.selection import loads_with_fields, without_fields
from roughline.plot.bodies import draw_contact, draw_heights, yield_key
from roughline.plot.curves import draw_loads, rising
from roughline.plot.pixels import any_marked, label_sides
from roughline.plot.spectra import draw_spectrum
from roughline.plot.style import PAGE, in_unit, new_figure, save, say, styled
from roughline.report.contact_tables import area_in_words
from roughline.report.folder import make_folder
from roughline.topography.body import Surface
from roughline.units import engineering

if TYPE_CHECKING:
    from roughline.assessment.assessment import Assessment
    from roughline.contact.curve import Curve
    from roughline.contact.measures import Measured
    from roughline.engineering.intervals import Ends
    from roughline.engineering.slip import PartialSlip

_PANEL_HEIGHT, _MOST_HEIGHT = 2.6, 8.2  # heights of a row of panels, and of all at most [inch]
_DASHES = ("--", ":", "-.", (0, (6, 1)), (0, (3, 1, 1, 1, 1, 1)))  # for each theory one
_BAND_END = 0.1  # of the least value: where the band of an interval ends that goes down to zero
_APERTURE_PREFIX = "hydraulic_aperture_"  # measures along either side begin so


def write_contact(assessment: Assessment, out: Path) -> list[Path]:
    """Write ``curve.nc``, and figures of the curve and of the contact; returns the files.

    The folder is made if it does not exist.

    Raises
    ------
    StoreError
        If the folder cannot be written.
    """
    make_folder(out)
    without_fields(assessment.curve).write(out / "curve.nc")
    written = [out / "curve.nc"]
    with styled():
        written += save(curve_figure(assessment), out, "curve")
        if isinstance(assessment.body, Surface):
            written += save(_contact_figure(assessment.body, assessment), out, "contact")
    return written


def curve_figure(assessment: Assessment) -> Figure:
    """Force over depth, and stiffness over force; open marks where the grid decides."""
    figure = new_figure(PAGE, 3.0)
    left, right = figure.subplots(1, 2)
    _draw_force(left, assessment)
    draw_stiffness(right, assessment)
    return figure


def _contact_figure(surface: Surface, assessment: Assessment) -> Figure:
    """Topography, and the real contact area at the last load with stored fields."""
    figure = new_figure(PAGE, 3.2)
    left, right = figure.subplots(1, 2)
    draw_heights(left, surface, "m")
    draw_filled(left, assessment)
    draw_last_contact(right, surface, assessment)
    return figure


def overview(assessment: Assessment) -> Figure:
    """Two panels abreast, of what is known."""
    body, panels = assessment.body, [partial(_draw_body, assessment=assessment)]
    if assessment.roughness is not None:
        panels.append(partial(draw_spectrum, found=assessment.roughness, unit="m"))
    panels.append(partial(draw_stiffness, assessment=assessment))
    if isinstance(body, Surface):
        panels.append(partial(_draw_area, assessment=assessment))
        panels.append(partial(draw_last_contact, surface=body, assessment=assessment))
    if _apertures(assessment):
        panels.append(partial(_draw_apertures, assessment=assessment))
    if (separation := assessment.sought.separation) is not None:
        panels.append(partial(_draw_separation, assessment=assessment, drawn=separation.curve))
    if _has_falling_loads(assessment):
        panels.append(partial(_draw_force, assessment=assessment))
    if _has_closed_form(assessment):
        panels.append(partial(_draw_partial_slip, slip=assessment.partial_slip))
    rows = -(-len(panels) // 2)
    figure = new_figure(PAGE, min(_PANEL_HEIGHT * rows, _MOST_HEIGHT))
    axes = figure.subplots(rows, 2, squeeze=False).ravel()
    for draw, each in zip(panels, axes, strict=False):
        draw(each)
    for empty in axes[len(panels) :]:
        empty.set_axis_off()
    return figure


def _draw_body(axes: Axes, assessment: Assessment) -> None:
    """Heights, with the points that were filled."""
    draw_heights(axes, assessment.body, "m")
    draw_filled(axes, assessment)


def overview_in_words(assessment: Assessment) -> str:
    """Say what the panels of the overview show."""
    question, yields = assessment.question, assessment.curve.hardness is not None
    marked = any(part.filled_region is not None for part in assessment.topographies)
    marks = ["open marks: fewer than ten points in contact"]
    marks += ["dashed: on unloading"] if yields else []
    marks += ["blue: after a larger load"] if _has_falling_loads(assessment) else []
    panels = [
        ("Heights of the map" if question.joint is not None else "Heights")
        + (" (red: filled points)" if marked else ""),
        "spectrum with the nearest self-affine law",
        f"stiffness over force ({'; '.join(marks)})",
    ]
    if isinstance(assessment.body, Surface):
        red = " (red: at the hardness)" if yields else ""
        panels.append(
            "contact area, corrected for the outline's steps as in the table, over force; the "
            f"points in contact at the largest load{red}"
        )
    if _apertures(assessment):
        panels.append("hydraulic aperture over force")
    if assessment.sought.separation is not None:
        panels.append("force over depth as the bodies are drawn apart after the largest load")
    if _has_falling_loads(assessment):
        panels.append("force over depth")
    if _has_closed_form(assessment):
        panels.append("partial slip at the largest load")
    with_theories = "; with theories for the same spectrum" if assessment.theories else ""
    return f"{'; '.join(panels)}{with_theories}."


def _draw_force(axes: Axes, assessment: Assessment) -> None:
    """Force over depth; with falling loads on linear scales, which show loading and unloading."""
    curve, falls = assessment.curve_over_loads, _has_falling_loads(assessment)
    x_label, depth = in_unit("depth since touch $d$", curve.depth, "m")
    y_label, force = _force_axis(assessment)
    draw_loads(axes, curve.depth * depth, curve.force * force, curve, linear=falls)
    axes.set(xlabel=x_label, ylabel=y_label)
    if falls:
        axes.plot([], [], "o", color="tab:blue", label="after a larger load")
        axes.legend()


def _draw_separation(axes: Axes, assessment: Assessment, drawn: Curve) -> None:
    """Force over depth on the way in, and as the bodies are drawn apart; a ring at the pull-off."""
    loaded = rising(assessment.curve)
    x_label, depth = in_unit("depth since touch $d$", drawn.depth, "m")
    y_label, force = _force_axis(assessment)
    attracted = slice(int(np.flatnonzero(drawn.force)[-1]) + 2)  # to the first depth without force
    axes.plot(
        drawn.depth[attracted] * depth,
        drawn.force[attracted] * force,
        ".-",
        color="tab:blue",
        label="drawn apart",
    )
    x, y = assessment.curve.depth[loaded], assessment.curve.force[loaded]
    axes.plot(x * depth, y * force, "k.", label="on the way in")
    off = drawn.pull_off_depth * depth, drawn.pull_off_force * force
    axes.plot(*off, "o", color="tab:red", markerfacecolor="none", label="pull-off")
    axes.axhline(0, color="0.7", linewidth=0.7, zorder=-1)
    axes.set(xlabel=x_label, ylabel=y_label)
    axes.legend()


def draw_stiffness(axes: Axes, assessment: Assessment) -> None:
    """Stiffness over force with its interval, and theories; for the joint, if one is given."""
    curve, area = assessment.curve_over_loads, assessment.area
    x_label, force = _force_axis(assessment)
    symbol = "k"
    if assessment.question.joint is not None:
        symbol = "k_i" if curve.hardness is None else r"k_\mathrm{load}"
    name = f"stiffness ${symbol}$"
    y_label, stiffness = in_unit(name, curve.stiffness, "N/m", assessment.scale)
    draw_loads(axes, curve.force * force, curve.stiffness * stiffness, curve)
    _draw_interval(axes, curve, assessment.stiffness_interval, (force, stiffness))
    if isinstance(curve, SurfaceCurve) and curve.hardness is not None:
        loading = rising(curve)
        unloading = curve.unloading_stiffness[loading] * stiffness
        of_unloading = "k_u" if assessment.question.joint is None else "k_i"
        label = f"unloading ${of_unloading}$"
        axes.loglog(curve.force[loading] * force, unloading, "--.", color="tab:red", label=label)
        _draw_interval(axes, curve, assessment.unloading_interval, (force, stiffness), "tab:red")
        axes.legend()
    _draw_theories(axes, assessment, "stiffness", (force, area * stiffness))
    axes.set(xlabel=x_label, ylabel=y_label)


def _draw_area(axes: Axes, assessment: Assessment) -> None:
    """Contact area over force with its interval, and theories."""
    curve = assessment.curve_over_loads
    if not isinstance(curve, SurfaceCurve):
        return
    label, force = _force_axis(assessment)
    draw_loads(axes, curve.force * force, curve.area_fraction_corrected, curve)
    _draw_interval(axes, curve, assessment.area_interval, (force, 1.0))
    _draw_theories(axes, assessment, "area_fraction", (force, 1.0))
    axes.set(xlabel=label, ylabel="contact area $A/A_0$")


def _draw_apertures(axes: Axes, assessment: Assessment) -> None:
    """Hydraulic aperture over force with its interval, along each side, and theories."""
    curve, found = assessment.curve_over_loads, _apertures(assessment)
    x_label, force = _force_axis(assessment)
    held = np.concatenate([each.values for each in found.values()])
    y_label, length = in_unit("hydraulic aperture $u_h$", held, "m")
    loading = rising(curve)
    for (name, each), colour in zip(found.items(), ("k", "tab:orange"), strict=False):
        label = f"along {name.removeprefix(_APERTURE_PREFIX)}"
        rows = np.where(each.rows > 0, each.rows, np.nan) * length
        x = curve.force * force
        look: dict[str, Any] = {"color": colour, "markersize": 3}
        axes.loglog(x[loading], rows[0][loading], ".-", label=label, **look)
        axes.loglog(x[~loading], rows[0][~loading], ".", markerfacecolor="none", **look)
        if len(rows) == 3:
            ends = np.fmax(rows[1:], _BAND_END * np.nanmin(rows, initial=np.inf)) / length
            _draw_interval(axes, curve, (ends[0], ends[1]), (force, length), colour)
        if (sealed := x[each.values == 0]).size:  # which a logarithmic axis cannot show
            foot = np.full(sealed.size, 0.04)
            axes.plot(sealed, foot, "x", transform=axes.get_xaxis_transform(), **look)
    if any((each.values == 0).any() for each in found.values()):
        axes.plot([], [], "x", color="0.4", label="sealed")
    _draw_theories(axes, assessment, "hydraulic_aperture", (force, length))
    axes.legend()
    axes.set(xlabel=x_label, ylabel=y_label)


def _apertures(assessment: Assessment) -> dict[str, Measured]:
    """Hydraulic apertures over the loads, along each side that was asked for."""
    taken = assessment.measured.items()
    return {name: each for name, each in taken if name.startswith(_APERTURE_PREFIX)}


def _draw_theories(
    axes: Axes, assessment: Assessment, quantity: str, factors: tuple[float, float]
) -> None:
    """Draw one quantity of theories of the same spectrum; those of flow have an aperture alone."""
    for theory, dashes in zip(assessment.theories, cycle(_DASHES), strict=False):
        values, of_flow = getattr(theory, quantity), theory.hydraulic_aperture is not None
        if values is not None and of_flow == (quantity == "hydraulic_aperture"):
            positive = np.where(values > 0, values, np.nan) * factors[1]
            x = assessment.load_on(theory.pressure * assessment.area) * factors[0]
            axes.plot(x, positive, linestyle=dashes, label=theory.name)
            axes.legend()


def _draw_partial_slip(axes: Axes, slip: PartialSlip | None) -> None:
    """Tangential force over displacement at the largest load, until the whole contact slides."""
    if slip is None:
        say(axes, "largest load not solved")
        return
    x_label, x = in_unit("slip displacement $u_x$", slip.displacement, "m")
    y_label, y = in_unit("tangential force $Q$", slip.force, "N")
    axes.plot(slip.displacement * x, slip.force * y, color="k")
    axes.set(xlabel=x_label, ylabel=y_label)


def _has_closed_form(assessment: Assessment) -> bool:
    """Whether partial slip is drawn by its closed form: a shear force has a picture of its own."""
    question = assessment.question
    return question.friction is not None and question.shear is None


def draw_filled(axes: Axes, assessment: Assessment) -> None:
    """Mark on a map of heights where points were missing and have been filled."""
    if not isinstance(assessment.body, Surface):
        return
    _, size = in_unit("x", assessment.body.sizes, "m")
    bounds = axes.axis()
    for i, part in enumerate(assessment.topographies):
        marks = part.filled_region
        if isinstance(marks, Surface) and 0 < marks.heights.mean() < 1:
            # the second of two bodies is turned over
            filled = any_marked(marks.heights if i == 0 else marks.heights[::-1])
            x, y = (
                (np.arange(n) + 0.5) / n * side * size
                for n, side in zip(filled.shape, marks.sizes, strict=True)
            )
            axes.contourf(x, y, filled.T, levels=[0.5, 1], colors="tab:red", alpha=0.3)
            axes.contour(x, y, filled.T, levels=[0.5], colors="tab:red", linewidths=0.7)
    axes.axis(bounds)


def draw_last_contact(axes: Axes, surface: Surface, assessment: Assessment) -> None:
    """Real contact area at the last load with stored fields; red where it yields."""
    curve = assessment.curve_over_loads
    pressed = loads_with_fields(curve)
    if not pressed:
        label_sides(axes, surface.sizes, "m")
        return
    load, fields = pressed[-1]
    draw_contact(axes, fields, "m")
    force = engineering(curve.force[load] * assessment.scale, "N")
    share = area_in_words(assessment, load)
    axes.set_title(f"corrected area {share} at {force}{yield_key(fields)}", fontsize=8)


def _has_falling_loads(assessment: Assessment) -> bool:
    """Whether a load is smaller than one before it."""
    return not bool(rising(assessment.curve).all())


def _draw_interval(
    axes: Axes, curve: Curve, ends: Ends | None, factors: tuple[float, float], colour: str = "0.35"
) -> None:
    """Draw an interval over the force on loading; factors lead to the units of both axes."""
    if ends is not None:
        loading = rising(curve)
        low, high = (end[loading] * factors[1] for end in ends)
        x = curve.force[loading] * factors[0]
        axes.fill_between(x, low, high, color=colour, alpha=0.2, linewidth=0, zorder=-5)


def _force_axis(assessment: Assessment) -> tuple[str, float]:
    """Return the label of the axis of the force, and the factor from the curve's force to it."""
    on = "" if assessment.question.joint is None else " on the joint"
    force = assessment.curve_over_loads.force
    return in_unit(f"force $F${on}", force, "N", assessment.scale)
