"""Files of the view "Explore": figures, curves and the surface."""

from __future__ import annotations

import shutil
from pathlib import Path
from tempfile import TemporaryDirectory

import roughline as rl
from roughline.lab.controls import ControlError
from roughline.lab.explore.state import state_in
from roughline.lab.frames import frame
from roughline.lab.server.tasks import Arguments, Progress
from roughline.report.contact_figures import write_contact

FILES = (
    *("contact.png", "contact.pdf", "curve.png", "curve.pdf", "curve.csv", "curve.nc"),
    "surface.nc",
)
"""What can be saved."""


def download(arguments: Arguments, progress: Progress) -> bytes:
    """Write one of the files of a state to the folder of the session."""
    name = arguments.get("name")
    if name not in FILES:
        raise ControlError(f"there is no such file; there are {', '.join(FILES)}")
    state = state_in(arguments)
    folder = Path(arguments["session"]["folder"]) / "results"
    folder.mkdir(parents=True, exist_ok=True)
    surface = state.surface(state.n)
    if name == "surface.nc":
        rl.write(surface, folder / name)
        return frame({"file": name})
    result = rl.assess_body(
        rl.Question(
            surface,
            E_star=state.E_star,
            loads=state.force(state.F),
            hardness=state.hardness,
            ask=[
                rl.WholeCurve(),
                *([rl.Theories(*state.theories)] if state.theories else []),
                *([rl.Unloading()] if state.hardness_bar is not None else []),
            ],
            periodic=state.periodic,
            grid_error=False,
        ),
        progress=progress,
    )
    if name == "curve.csv":
        result.curve.write(folder / name)
        return frame({"file": name})
    with TemporaryDirectory(dir=folder) as written:
        write_contact(result, Path(written))
        shutil.move(Path(written) / name, folder / name)
    return frame({"file": name})
