"""Data of the lab's figures of the paper that no computing changes: curves, exponents, the map.

The lab's script chooses among them, and asks its server for the fits in a window alone. What panels
show is as they are declared.
"""

from __future__ import annotations

from collections.abc import Mapping
from itertools import pairwise
from typing import Any

import numpy as np
from matplotlib.colors import to_hex

from roughline.comparison.trust import TrustMap, trust_map
from roughline.contact import scaling
from roughline.paper.mean_curve import MeanCurve, mean_curve
from roughline.paper.results import PaperResults
from roughline.paper.tables import three_digits, trust_cell
from roughline.plot.models import TRUST_LEVELS, trust_colours
from roughline.statistics.averages import Averaging
from roughline.statistics.power_law import linear_exponent, scaling_exponent

AVERAGES: tuple[Averaging, ...] = ("arithmetic", "geometric")
PUNCHES = {"paper": scaling.PAPER_PUNCH, "exact": scaling.EXACT_PUNCH, "raw": 1.0}
"""What the stiffness of surfaces is divided by, as the lab's choice calls it."""
_MARKS = 24  # at most, of a curve


def lab_figures(results: PaperResults) -> dict[str, Any]:
    """Return it all, with curves by what is chosen for them."""
    whole = trust_map()
    colours = [to_hex(colour) for colour in trust_colours()]
    between = [f"{a:+.0%} to {b:+.0%}" for a, b in pairwise(TRUST_LEVELS)]
    levels = [f"below {TRUST_LEVELS[0]:+.0%}", *between, f"above {TRUST_LEVELS[-1]:+.0%}"]
    cells: dict[str, Any] = {}
    tables: dict[str, Any] = {}
    for i in range(whole.roll_off_ratios.size):
        cells |= _cells(whole, i, colours)
        tables[f"published-trust-{whole.roll_off_ratios[i]:g}"] = _trust_table(whole, i)
    return {
        "panels": {"exponents": {"series": _exponents(results)}},
        "sources": cells,
        "tables": tables,
        "legend": list(zip(colours, levels, strict=True)),
        "curves": _curves(results),
    }


def _curves(results: PaperResults) -> dict[str, Any]:
    """Figure 3 by its mean, Figure 4 by its mean and normaliser."""
    found = {}
    for mean in AVERAGES:
        found[f"1D {mean}"] = _stiffness(results, "1D", 1.0, mean)
        for name, punch in PUNCHES.items():
            found[f"3D {mean} {name}"] = _stiffness(results, "3D", punch, mean)
    return found


def _stiffness(
    results: PaperResults, model: str, punch: float, averaging: Averaging
) -> dict[str, Any]:
    data = results.reduced if model == "1D" else results.full
    dimensions = results.full.fractal_dimension.values
    found = {
        float(d): mean_curve(data.sel(fractal_dimension=d), punch, averaging) for d in dimensions
    }
    over = "" if punch == 1 else f"{punch:g} "
    limit = 1.0 if model == "1D" else scaling.EXACT_PUNCH / punch
    forces = next(iter(found.values())).force_bar[[0, -1]]
    series = _series(found) | {"saturated": {"x": forces, "y": [limit, limit]}}
    panel = {"series": series, "axes": ["", f"stiffness k̄ = k / ({over}E* L)"]}
    return {
        "panels": {f"stiffness-{model}": panel},
        "tables": {f"published-stiffness-{model}": _table("k̄", found)},
    }


def _series(curves: Mapping[float, MeanCurve]) -> dict[str, Any]:
    """Return curves with their standard errors, and lines and marks where the grid does not decide.

    Names begin with the fractal dimension.
    """
    found: dict[str, Any] = {}
    for dimension, curve in curves.items():
        x, y = curve.force_bar, curve.mean
        kept = np.flatnonzero(curve.resolved)
        some = kept[:: max(1, x.size // _MARKS)]
        found |= {
            f"{dimension:g} mean": {"x": x, "y": y, "low": curve.low, "high": curve.high},
            f"{dimension:g} sure": {"x": x[kept], "y": y[kept]},
            f"{dimension:g} marks": {"x": x[some], "y": y[some]},
        }
    return found


def _table(symbol: str, curves: Mapping[float, MeanCurve]) -> dict[str, Any]:
    """Return means over force in a table; a star is where the grid decides."""
    every = list(curves.values())
    header = ["F̄", *(f"{symbol} at D_f = {each:.1f}" for each in curves)]
    rows = [
        [
            three_digits(force),
            *(three_digits(one.mean[i]) + " *" * (not one.resolved[i]) for one in every),
        ]
        for i, force in enumerate(every[0].force_bar)
    ]
    return {"header": header, "rows": rows}


def _exponents(results: PaperResults) -> dict[str, Any]:
    """Return the exponents of the reduced model in three windows, and the two predictions."""
    fine = np.linspace(2, 3, 101)
    data = results.exponents
    windows = [data.isel(window=i) for i in range(data.sizes["window"])]
    found = {
        f"{i}": {
            "x": one.fractal_dimension.values,
            "y": one.exponent.values,
            "low": one.low.values,
            "high": one.high.values,
        }
        for i, one in enumerate(windows)
    }
    return {
        **found,
        "scaling": {"x": fine, "y": scaling_exponent(fine)},
        "linear": {"x": fine, "y": linear_exponent(fine)},
    }


def _cells(whole: TrustMap, i: int, colours: list[str]) -> dict[str, Any]:
    """Return the cells of a panel, each around its point, and again where the grid decides."""
    across, up = np.exp(_edges(np.log(whole.force_bars))), _edges(whole.fractal_dimensions)
    shape = whole.difference[i].shape
    left, right = (np.broadcast_to(x, shape).ravel() for x in (across[:-1], across[1:]))
    bottom, top = (np.repeat(y, shape[1]) for y in (up[:-1], up[1:]))
    colour = np.array(colours)[np.digitize(whole.difference[i], TRUST_LEVELS).ravel()]
    cells = {"left": left, "right": right, "bottom": bottom, "top": top, "colour": colour}
    unsure = ~whole.resolved[i].ravel()
    name = f"trust {whole.roll_off_ratios[i]:g}"
    return {name: cells, f"{name} unsure": {key: each[unsure] for key, each in cells.items()}}


def _trust_table(whole: TrustMap, i: int) -> dict[str, Any]:
    """Return a panel as a table, with loads downwards."""
    roll_off = float(whole.roll_off_ratios[i])
    dimensions = whole.fractal_dimensions[::2]
    rows = [
        [three_digits(force), *(trust_cell(whole.at(d, force, roll_off)) for d in dimensions)]
        for force in whole.force_bars
    ]
    return {"header": ["F̄", *(f"D_f = {d:.1f}" for d in dimensions)], "rows": rows}


def _edges(middles: np.ndarray) -> np.ndarray:
    """Return the edges of the cells around evenly spaced points."""
    half = (middles[1] - middles[0]) / 2
    return np.append(middles - half, middles[-1] + half)
