"""Files of the view "Explore": what its plots and maps show, as pictures and as numbers."""

from __future__ import annotations

from dataclasses import dataclass
from importlib import import_module
from pathlib import Path

from roughline.lab.controls import STRANGE, ControlError
from roughline.lab.explore.state import state_in
from roughline.lab.frames import frame
from roughline.lab.server.tasks import Arguments, Progress


@dataclass(frozen=True)
class _File:
    """A file that can be saved; the ending of its name says of what type it is."""

    label: str  # what the page calls it
    maker: str  # function of this package that writes it


FILES = {
    "contact.png": _File("both maps, PNG", "figures.write_maps"),
    "contact.pdf": _File("both maps, PDF", "figures.write_maps"),
    "maps.nc": _File("all maps, NetCDF", "numbers.write_maps"),
    "curve.png": _File("curves, PNG", "figures.write_curves"),
    "curve.pdf": _File("curves, PDF", "figures.write_curves"),
    "curve.csv": _File("curves, CSV", "numbers.write_curves"),
    "curve.nc": _File("curves, NetCDF", "numbers.write_curves"),
    "surface.nc": _File("surface, NetCDF", "numbers.write_surface"),
}
"""All files that can be saved, by their names."""


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
    folder = Path(arguments["session"]["folder"]) / "results"
    folder.mkdir(parents=True, exist_ok=True)
    module, maker = FILES[name].maker.split(".")
    write = getattr(import_module(f"roughline.lab.explore.{module}"), maker)
    write(state, points, folder / name, progress)
    return frame({"file": name})
