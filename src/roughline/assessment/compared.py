"""Both models of one roughness: the table, the figure, and what the map says."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING

from roughline.assessment.source import Source
from roughline.comparison.models import Comparison, compare
from roughline.comparison.trust import Difference, trust_map
from roughline.errors import InputError, StoreError
from roughline.report.folder import make_folder
from roughline.spectra.roughness import ALIKE, isotropy
from roughline.spectra.self_affine import SelfAffine
from roughline.statistics.verdict import Verdict
from roughline.topography.body import Line, Surface
from roughline.topography.preparation import prepared

if TYPE_CHECKING:
    from matplotlib.figure import Figure


@dataclass(frozen=True)
class Compared:
    """What a comparison gave.

    Attributes
    ----------
    what : str
        What was compared.
    comparison : Comparison
        Curves and differences.
    tolerance : float
        Relative difference up to which the two models count as agreeing.
    from_map : list of Difference or None
        What the map says for each load; None for loads outside it, and for surfaces.
    files : list of Path
        What was written.
    """

    what: str
    comparison: Comparison
    tolerance: float
    from_map: list[Difference | None]
    files: list[Path]


def compare_models(
    body: SelfAffine | Source,
    *,
    n: int,
    surfaces: int,
    force_bars: list[float] | None,
    tolerance: float,
    seed: int,
    out: Path | None,
    progress: Callable[[int, int], None] | None,
) -> Compared:
    """Compare the two models for a spectrum or for the surface in a file.

    Parameters
    ----------
    body : SelfAffine or Source
        The spectrum, or a topography.
    n, surfaces, force_bars
        As for :func:`roughline.compare`.
    tolerance : float
        Relative difference up to which the two models count as agreeing.
    seed : int
        Root of all seeds.
    out : Path or None
        Folder for a table (CSV) and a figure; None writes nothing.
    progress : callable or None
        Called with (surfaces done, surfaces in all).

    Raises
    ------
    InputError
        If the tolerance is none, or the file holds a line.
    """
    if not 0 < tolerance < 1:
        raise InputError(f"tolerance is {tolerance}; a share between 0 and 1 is needed")
    given: SelfAffine | Surface
    if isinstance(body, Source):
        found = prepared(body.read())
        if isinstance(found, Line):
            raise InputError(f"{body.file} holds a line; the models are compared on a surface")
        given = found
        what = f"{body.file}, {found.shape[0]} x {found.shape[1]} points, and lines of its spectrum"
        if (alike := isotropy(found)) < ALIKE:
            what += (
                f"; its slopes differ by direction, least {alike:.2f} of the largest: a spectrum "
                "averaged over directions stands for no such surface"
            )
    else:
        given = body
        what = (
            f"{surfaces} surfaces of {n} x {n} points, D_f = {body.fractal_dimension:g}, "
            f"q_roll / q_0 = {body.q_roll / body.q_low:.3g}"
        )
    if out is not None:
        make_folder(out)
    result = compare(
        given, n=n, surfaces=surfaces, force_bars=force_bars, rng=seed, progress=progress
    )
    from_map = [_on_map(given, force_bar) for force_bar in result.force_bar]
    files = _write(result, tolerance, out) if out is not None else []
    return Compared(what, result, tolerance, from_map, files)


def compared_table(compared: Compared) -> tuple[list[str], list[list[str]]]:
    """Return header and rows; a star marks loads that the grid decides."""
    result = compared.comparison
    within = f"within {compared.tolerance:.0%}"
    header = ["F / (E* h L)", "k 1D", "k 3D", "3D over 1D, less 1", within]
    shows_map = any(entry is not None for entry in compared.from_map)
    rows = []
    for i, difference in enumerate(result.differences()):
        sure = "" if difference.resolved else " *"
        interval = f"{difference.value:+.1%} ({difference.low:+.1%} to {difference.high:+.1%})"
        row = [
            f"{result.force_bar[i]:.3g}",
            f"{result.reduced.mean[i]:.4f}",
            f"{result.full.mean[i]:.4f}",
            interval + sure,
            difference.verdict(compared.tolerance),
        ]
        entry = compared.from_map[i]
        rows.append([*row, str(entry) if entry else "-"] if shows_map else row)
    return ([*header, "the map says"] if shows_map else header), rows


def verdict(compared: Compared) -> str:
    """Say in a few sentences where the reduced model may be trusted, and of what this is true."""
    result, share = compared.comparison, f"{compared.tolerance:.0%}"
    window = result.trusted(compared.tolerance)
    verdicts = [each.verdict(compared.tolerance) for each in result.differences()]
    undecided = verdicts.count(Verdict.UNDECIDED)
    text = f"agreement within {share} is confirmed "
    text += (
        f"from F / (E* h L) = {window[0]:.3g} to {window[1]:.3g}"
        if window
        else "at no load that the grid resolves"
    )
    text += (
        f", refuted at {verdicts.count(Verdict.REFUTED)} and undecided at {undecided} of "
        f"{len(verdicts)} loads"
    )
    if result.surfaces == 1:
        return (
            f"{text}. This is about the models for surfaces of this spectrum, of which this is "
            f"one: single surfaces scatter by {result.scatter.max():.0%} or less, and the interval "
            "includes it"
        )
    return f"{text}; more surfaces decide more" if undecided else text


def compared_figure(result: Comparison, tolerance: float) -> Figure:
    """Both curves, and their relative difference with its interval."""
    from matplotlib.ticker import PercentFormatter  # here, as to draw loads slowly

    from roughline.report.style import FORCE_LABEL, PAGE, SHADE, colours, new_figure

    figure = new_figure(PAGE, 3.0)
    left, right = figure.subplots(1, 2)
    force = result.force_bar
    dark, light = colours(2)
    count = result.surfaces
    for mean, colour, label in (
        (
            result.full,
            dark,
            "full model" + (f", mean of {count} surfaces" if count > 1 else ", one surface"),
        ),
        (result.reduced, light, f"reduced model, mean of {result.lines} lines"),
    ):
        left.loglog(force, mean.mean, color=colour, marker="o", label=label)
        left.fill_between(force, mean.low, mean.high, color=colour, alpha=0.25, linewidth=0)
    left.set(xlabel=FORCE_LABEL, ylabel=r"raw stiffness $k\,/\,(E^* L)$")
    left.legend()
    right.axhspan(-tolerance, tolerance, **SHADE)
    right.axhline(0, color="k", linewidth=0.7)
    right.fill_between(force, result.low, result.high, color=dark, alpha=0.25, linewidth=0)
    right.semilogx(force, result.difference, color=dark)
    for sure, fill in ((result.resolved, "full"), (~result.resolved, "none")):
        right.semilogx(
            force[sure],
            result.difference[sure],
            color=dark,
            marker="o",
            linestyle="",
            fillstyle=fill,
        )
    right.yaxis.set_major_formatter(PercentFormatter(1, decimals=0))
    right.set(xlabel=FORCE_LABEL, ylabel="3D over 1D, less 1")
    return figure


def _on_map(body: SelfAffine | Surface, force_bar: float) -> Difference | None:
    if isinstance(body, Surface):
        return None
    try:
        return trust_map().at(body.fractal_dimension, force_bar, body.q_roll / body.q_low)
    except InputError:  # outside the map, which is no fault of the comparison
        return None


def _write(result: Comparison, tolerance: float, out: Path) -> list[Path]:
    import pandas as pd  # here because it loads slowly

    from roughline.report.style import save, styled

    frame = pd.DataFrame(
        {
            "force_bar": result.force_bar,
            "stiffness_reduced": result.reduced.mean,
            "stiffness_full": result.full.mean,
            "difference": result.difference,
            "low": result.low,
            "high": result.high,
            "scatter": result.scatter,
            "resolved": result.resolved,
        }
    )
    try:
        frame.to_csv(out / "comparison.csv", index=False)
        with styled():
            files = save(compared_figure(result, tolerance), out, "comparison")
    except OSError as error:
        raise StoreError(f"cannot write to {out} ({error}): choose another folder") from error
    return [out / "comparison.csv", *files]
