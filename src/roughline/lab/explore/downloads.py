"""Files of the view "Explore" with its numbers, computed anew as the tasks of the page do."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path
from urllib.parse import urlencode

import xarray

import roughline as rl
from roughline.computing.disk import write_dataset
from roughline.lab.controls import STRANGE, ControlError
from roughline.lab.explore import pictures
from roughline.lab.explore.controls import FILES
from roughline.lab.explore.reading import state_in
from roughline.lab.explore.state import ExploreState
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
    write_dataset(pressed.to_dataset().assign_attrs(_link(state)), path)


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
    attributes = maps.attrs | heights.attrs | _link(state)
    write_dataset(heights.merge(maps).assign_attrs(attributes), path)


def _write_surface(state: ExploreState, points: int, path: Path, progress: Progress) -> None:
    rl.write(state.surface(points), path)


def _link(state: ExploreState) -> dict[str, str]:
    """What opens the same state again; all else the library says of bodies and loads."""
    return {"lab_link": f"?view=explore&{urlencode(state.address())}"}


_WRITERS: dict[str, Callable[[ExploreState, int, Path, Progress], None]] = {
    "maps": _write_maps,
    "curve": _write_loads,
    "surface": _write_surface,
}
