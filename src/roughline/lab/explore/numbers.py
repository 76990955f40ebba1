"""What the plots and maps of the view "Explore" show, as numbers in files."""

from __future__ import annotations

from dataclasses import dataclass, field
from pathlib import Path
from typing import Any
from urllib.parse import urlencode

import numpy as np
import pandas as pd
import xarray

import roughline as rl
from roughline.assessment.question import UNLOADING
from roughline.computing.disk import write_dataset
from roughline.contact.quantities import QUANTITIES
from roughline.contact.scaling import PAPER_PUNCH
from roughline.lab.controls import rounded
from roughline.lab.explore import adhesion, fluid
from roughline.lab.explore.pictures import CURVE_FORCES, CURVE_POINTS, lines_over_force, of_theory
from roughline.lab.explore.pressing import borne, pressed_under
from roughline.lab.explore.state import ExploreState
from roughline.lab.server.tasks import Progress
from roughline.theories.theory_curve import TheoryCurve

_APERTURE = "hydraulic_aperture_x"


@dataclass
class Curves:
    """All that the plots over the force show of a state; None or empty what they do not."""

    loads: rl.Curve  # of the full model
    here: rl.Curve  # of the present load, on the grid of the maps
    line: dict[str, Any]  # of the reduced model
    theories: list[dict[str, Any]]
    back: rl.Curve | None = None  # the way back from the present load, if points yield
    flow: rl.Curve | None = None
    of_flow: list[TheoryCurve] = field(default_factory=list)
    cycle: adhesion.Cycle | None = None


def curves_of(state: ExploreState, points: int, progress: Progress) -> Curves:
    """Compute them as the page does: on its grids, under its loads."""
    surface = state.surface(state.points(CURVE_POINTS))
    measures = fluid.measures(state)
    steps = _Steps(progress, 2 + (state.hardness_bar is not None) + bool(state.fluid))

    def pressed(force_bar: Any, **others: Any) -> rl.Curve:
        return pressed_under(state, surface, np.asarray(force_bar), steps.next(), **others)

    found = Curves(
        loads=pressed(borne(state, CURVE_FORCES)),
        here=at_load(state, points, steps.next()),
        line=lines_over_force(state),
        theories=[of_theory(name, surface, state) for name in state.theories],
    )
    if state.hardness_bar is not None:
        found.back = pressed(state.F * np.array([1.0, *UNLOADING]), measures=measures)
    if state.fluid:
        found.flow = pressed(borne(state, fluid.FORCES), measures=measures)
        found.of_flow = fluid.theories(state, surface)
    if state.w is not None:
        found.cycle = adhesion.cycle(state, adhesion.points(state), progress, measures)
    return found


class _Steps:
    """Steps of several presses, one after the other."""

    def __init__(self, progress: Progress, presses: int) -> None:
        self._progress, self._presses, self._begun = progress, presses, 0

    def next(self) -> Progress:
        """Begin a press; returns what it tells its steps to."""
        before, self._begun = self._begun, self._begun + 1
        return lambda done, total: self._progress(before * total + done, self._presses * total)


def at_load(state: ExploreState, points: int, progress: Progress) -> rl.Curve:
    """The contact at the present load, with its fields."""
    surface, force_bar = state.surface(points), np.array([state.F])
    of_grid = points == state.n  # as on the page, where a coarser grid is but a first look
    measures = fluid.measures(state)
    return pressed_under(
        *(state, surface, force_bar, progress), fields=True, grid_error=of_grid, measures=measures
    )


def write_curves(state: ExploreState, points: int, path: Path, progress: Progress) -> None:
    """Write all that the plots over the force show, as NetCDF or as a table."""
    found = curves_of(state, points, progress)
    series, told = _series(state, found), _settings(state, points, found.here)
    if found.cycle is not None:
        depth, pull = found.cycle.pull_off
        told |= {"pull_off_depth": depth, "pull_off_depth_units": "m"}
        told |= {"pull_off_force": pull, "pull_off_force_units": "N"}
    if path.suffix == ".csv":
        _write_table(series, told, path)
        return
    named = [
        each.rename({name: f"{name}{key}" for name in (*each.variables, *each.dims)})
        for key, each in series.items()
    ]
    data = xarray.merge(named, compat="no_conflicts", join="outer")
    write_dataset(data.assign_attrs(told), path)


def write_maps(state: ExploreState, points: int, path: Path, progress: Progress) -> None:
    """Write the heights as `rl.write` does, and with them the maps of the contact."""
    write_surface(state, points, path, progress)
    pressed = at_load(state, points, progress)
    maps = pressed.to_dataset().isel(force=0).drop_vars("force")
    fields = pressed.fields[0]
    if state.fluid and fields is not None:
        flow, along = rl.flow(fields), ("x", "y")
        meaning = "flow per width along {}, times 12 viscosity / pressure difference"
        for name, flux in zip(along, flow.flux, strict=True):
            told = {"units": "m^2", "long_name": meaning.format(name)}
            maps[f"flux_{name}"] = (along, flux, told)
    centres = (np.arange(points) + 0.5) * (state.length / points)
    sides = {name: (name, centres, {"units": "m"}) for name in ("x", "y")}
    heights = xarray.load_dataset(path, engine="h5netcdf")
    data = heights.merge(maps).assign_coords(sides)
    write_dataset(data.assign_attrs(_settings(state, points, pressed) | heights.attrs), path)


def write_surface(state: ExploreState, points: int, path: Path, progress: Progress) -> None:
    """Write the heights alone."""
    rl.write(state.surface(points), path)


def _series(state: ExploreState, found: Curves) -> dict[str, xarray.Dataset]:
    """What is drawn, by the ends of the names of its quantities in files."""
    cycle = found.cycle
    curves = {"": found.loads, "_here": found.here, "_back": found.back, "_flow": found.flow}
    if cycle is not None:
        curves |= {"_both_ways": cycle.by_depths, "_turned": cycle.by_forces}
    series = {key: _of_curve(each) for key, each in curves.items() if each is not None}
    of_lines = state.E_star * state.length
    series["_1d"] = _of_bars(state, found.line, of_lines)
    for each in found.theories:
        series[_end(each["name"])] = _of_bars(state, each, PAPER_PUNCH * of_lines)
    for theory in found.of_flow:
        force = theory.pressure * state.length**2
        rows = {"force_bar": force / state.force(1.0), "force": force}
        series[_end(theory.name)] = _dataset(rows | {_APERTURE: theory.hydraulic_aperture})
    return series


def _end(theory: str) -> str:
    return f"_{theory.replace('-', '_')}"


def _of_curve(curve: rl.Curve) -> xarray.Dataset:
    """A curve over its loads, with what is drawn of it."""
    data = curve.to_dataset().drop_dims(["x", "y", "field_load"], errors="ignore")
    bars = {name: getattr(curve, name) for name in ("force_bar", "stiffness_bar")}
    return data.merge(_dataset(bars, str(next(iter(data.dims)))))


def _of_bars(state: ExploreState, bars: dict[str, Any], stiffness: float) -> xarray.Dataset:
    """A dimensionless curve as the page draws it; its stiffness is over the one that is given."""
    rows = {"force_bar": bars["force_bar"], "force": state.force(bars["force_bar"])}
    for key, end in (("stiffness_bar", ""), ("low", "_low"), ("high", "_high")):
        if (values := bars.get(key)) is not None:
            rows |= {f"stiffness_bar{end}": values, f"stiffness{end}": values * stiffness}
    if "area" in bars:
        rows["area_fraction"] = bars["area"]
    return _dataset(rows)


def _dataset(rows: dict[str, Any], dim: str = "force") -> xarray.Dataset:
    """Quantities over loads, with their units and what they are."""
    return xarray.Dataset({name: (dim, values, _told(name)) for name, values in rows.items()})


def _told(name: str) -> dict[str, str]:
    """Unit and meaning of a quantity, or of an end of its range."""
    declared = QUANTITIES.get(name.removesuffix("_low").removesuffix("_high"))
    if declared is None:
        return {"units": "m", "long_name": "gap of flat plates that let as much through"}
    return {"long_name": declared.meaning} | declared.attributes("m")


def _settings(state: ExploreState, points: int, pressed: rl.Curve) -> dict[str, Any]:
    """What files say of a state: what it is made of, how it was pressed, and a link to it."""
    side, link = state.length, f"?view=explore&{urlencode(state.address())}"
    told: dict[str, Any] = {
        "fractal_dimension": state.D_f,
        "roll_off": state.roll_off * side,
        "cutoff": state.cutoff_used * side,
        "seed": state.seed,
        "points": state.n,
        "points_of_curves": state.points(CURVE_POINTS),
        "points_of_maps": points,
        "force_bar": state.F,
        "force": state.force(state.F),
    }
    by_curve = pressed.to_dataset().attrs.items()
    told |= {name: value for name, value in by_curve if not name.startswith("body_")}
    told |= {f"{name}_units": unit for name, unit in _UNITS.items() if name in told}
    exact = {key: rounded(each) if isinstance(each, float) else each for key, each in told.items()}
    return exact | {"lab_link": link}


_UNITS = dict.fromkeys(("roll_off", "cutoff", "rms_height", "length", "range"), "m")
_UNITS |= {"force": "N", "hardness": "Pa", "work_of_adhesion": "J/m^2"}
"""Units of settings beside those that a curve tells."""


def _write_table(series: dict[str, xarray.Dataset], told: dict[str, Any], path: Path) -> None:
    """Write a row for each load of each series, below the names of the columns and remarks.

    The names come first, where both NumPy and pandas look for them.
    """
    tables = [
        each.to_dataframe().reset_index().assign(series=key.removeprefix("_") or "3d")
        for key, each in series.items()
    ]
    attrs = {name: each.attrs for data in series.values() for name, each in data.variables.items()}
    columns = {
        name: f"{name} [{unit}]" if (unit := each.get("units")) else str(name)
        for name, each in attrs.items()
    }
    lines = [
        f"{name} = {value} {told.get(f'{name}_units', '')}"
        for name, value in told.items()
        if not name.endswith("_units")
    ]
    lines += [f"{columns[name]}: {each.get('long_name', name)}" for name, each in attrs.items()]
    rows = pd.concat(tables)[["series", *columns]].rename(columns=columns)
    head, body = rows.to_csv(index=False, na_rep="nan", lineterminator="\n").split("\n", 1)
    remarks = "".join(f"# {' '.join(line.split())}\n" for line in lines)
    path.write_text(f"{head}\n{remarks}{body}", encoding="utf-8")
