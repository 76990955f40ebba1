"""Files of the view "Explore": figures, curves and the surface."""

from __future__ import annotations

import shutil
from pathlib import Path
from tempfile import TemporaryDirectory

import roughline as rl
from roughline.lab.controls import ControlError
from roughline.lab.explore.adhesion import both_ways
from roughline.lab.explore.pressing import pressed_under
from roughline.lab.explore.reading import state_in
from roughline.lab.frames import frame
from roughline.lab.server.tasks import Arguments, Progress
from roughline.plot.style import PAGE, new_figure, save, styled
from roughline.report.contact_figures import write_contact

FILES = (
    *("contact.png", "contact.pdf", "curve.png", "curve.pdf", "curve.csv", "curve.nc"),
    "surface.nc",
)
"""What can be saved of every state; figures of what is added stand beside it."""

_HEIGHT = 4.8  # of a figure of the flow [inch]


def download(arguments: Arguments, progress: Progress) -> bytes:
    """Write one of the files of a state to the folder of the session."""
    name = str(arguments.get("name"))
    state = state_in(arguments)
    more = [stem for each in state.added for stem in each.files]
    known = (*FILES, *(f"{stem}.{kind}" for stem in more for kind in ("png", "pdf")))
    if name not in known:
        raise ControlError(f"there is no such file; there are {', '.join(known)}")
    folder = Path(arguments["session"]["folder"]) / "results"
    folder.mkdir(parents=True, exist_ok=True)
    surface = state.surface(state.n)
    if name == "surface.nc":
        rl.write(surface, folder / name)
        return frame({"file": name})
    stem, kind = name.split(".")
    drawn = {each: draw for kind in state.added for each, draw in kind.drawings.items()}
    if stem in drawn and kind in ("png", "pdf"):
        with TemporaryDirectory(dir=folder) as written, styled():
            figure = new_figure(PAGE, _HEIGHT)
            drawn[stem](figure.subplots(), state, surface, progress)
            save(figure, Path(written), stem)
            shutil.move(Path(written) / name, folder / name)
        return frame({"file": name})
    if (found := both_ways(state, progress)) is not None:
        found.write(folder / name)
        return frame({"file": name})
    law = state.law
    result = rl.assess_body(
        rl.Question(
            surface,
            **({"materials": state.materials} if state.materials else {"E_star": state.E_star}),
            loads=state.force(state.F),
            hardness=law.hardness if isinstance(law, rl.Yielding) else None,
            ask=[
                rl.WholeCurve(),
                *([rl.Theories(*state.theories)] if state.theories else []),
                *([rl.Unloading()] if isinstance(law, rl.Yielding) else []),
            ],
            periodic=state.periodic,
            grid_error=False,
        ),
        progress=progress,
    )
    if name == "curve.csv":
        curve = result.curve
        if state.measures:  # once more, with what flows
            forces = state.force_bars(curve)
            curve = pressed_under(state, surface, forces, progress, measures=state.measures)
        curve.write(folder / name)
        return frame({"file": name})
    with TemporaryDirectory(dir=folder) as written:
        write_contact(result, Path(written))
        shutil.move(Path(written) / name, folder / name)
    return frame({"file": name})
