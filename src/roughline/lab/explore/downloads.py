"""Files of the view "Explore" with its numbers, computed anew as the tasks of the page do."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path
from typing import Any
from urllib.parse import urlencode

import xarray

import roughline as rl
from roughline.computing.disk import write_dataset
from roughline.lab.controls import STRANGE, ControlError, rounded
from roughline.lab.explore import pictures
from roughline.lab.explore.controls import FILES
from roughline.lab.explore.reading import state_in
from roughline.lab.explore.state import CURVE_POINTS, ExploreState
from roughline.lab.frames import frame
from roughline.lab.server.tasks import Arguments, Progress


def download(arguments: Arguments, progress: Progress) -> bytes:
    """Write one of the files to the folder of the session.

    It is of a state as it was answered, on the `points` along a side that its maps have.
    """
    name, state = str(arguments.get("name")), state_in(arguments)
    if name not in FILES:
        raise ControlError(f"there is no such file; there are {', '.join(FILES)}")
    points = arguments.get("points", state.n)
    if not isinstance(points, int) or not 2 <= points <= state.n:
        raise ControlError(STRANGE)
    path = Path(arguments["session"]["folder"]) / "results" / name
    path.parent.mkdir(parents=True, exist_ok=True)
    _WRITERS[path.stem](state, points, path, progress)
    return frame({"file": name})


def _write_loads(state: ExploreState, points: int, path: Path, progress: Progress) -> None:
    """Write the loads of the full model with all their quantities, in SI units."""
    forces = pictures.drawn_forces(state)
    pressed = state.press(state.surface_of_curves, progress, forces, measures=state.measures)
    write_dataset(pressed.to_dataset().assign_attrs(_settings(state, points)), path)


def _write_maps(state: ExploreState, points: int, path: Path, progress: Progress) -> None:
    """Write the heights as `rl.write` does, and with them the maps of the contact."""
    surface = state.surface(points)
    rl.write(surface, path)
    pressed = state.press(surface, progress, [state.F], fields=True)
    maps = pressed.to_dataset().isel(force=0).drop_vars("force")
    if (fields := pressed.fields[0]) is not None:
        for each in state.added:
            for name, (values, unit, meaning) in each.saved_fields(fields).items():
                maps[name] = (("x", "y"), values, {"units": unit, "long_name": meaning})
    heights = xarray.load_dataset(path)
    settings = _settings(state, points) | heights.attrs
    write_dataset(heights.merge(maps).assign_attrs(settings), path)


def _write_surface(state: ExploreState, points: int, path: Path, progress: Progress) -> None:
    rl.write(state.surface(points), path)


def _settings(state: ExploreState, points: int) -> dict[str, Any]:
    """What files say of a state: what it is made of, how it is pressed, and a link to it."""
    side, height = state.length, state.rms_height
    numbers = {
        "E_star [Pa]": state.E_star,
        "length L [m]": side,
        "rms_height h [m]": height,
        "rms_slope": state.rms_slope,
        "fractal_dimension": state.D_f,
        "roll_off [m]": state.roll_off * side,
        "cutoff [m]": state.cutoff_used * side,
        "force F [N]": state.force(state.F),
        "force_bar": state.F,
        "E* h L, unit of force_bar [N]": state.force(1.0),
        "E* L, unit of stiffness_bar [N/m]": state.E_star * side,
    }
    return {
        "roughline_version": rl.__version__,
        **{name: rounded(value) for name, value in numbers.items()},
        "seed": state.seed,
        "boundary": state.boundary,
        "points along a side": state.n,
        "points along a side of the maps": points,
        "points along a side of the curves": state.points(CURVE_POINTS),
        **{key: value for each in state.added for key, value in each.numbers.items()},
        "lab_link": f"?view=explore&{urlencode(state.address())}",
    }


_WRITERS: dict[str, Callable[[ExploreState, int, Path, Progress], None]] = {
    "maps": _write_maps,
    "curve": _write_loads,
    "surface": _write_surface,
}
