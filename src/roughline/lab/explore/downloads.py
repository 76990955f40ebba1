"""Files of the view "Explore": figures, curves and the surface."""

from __future__ import annotations

import shutil
from pathlib import Path
from tempfile import TemporaryDirectory

import numpy as np
from matplotlib.axes import Axes

import roughline as rl
from roughline.assessment.question import UNLOADING
from roughline.lab.controls import ControlError
from roughline.lab.explore import adhesion
from roughline.lab.explore.fluid import FORCES, measures, theories
from roughline.lab.explore.pressing import borne, pressed_under
from roughline.lab.explore.state import ExploreState, state_in
from roughline.lab.frames import frame
from roughline.lab.server.tasks import Arguments, Progress
from roughline.plot.style import PAGE, new_figure, save, styled
from roughline.report.contact_figures import write_contact

FILES = (
    *("contact.png", "contact.pdf", "curve.png", "curve.pdf", "curve.csv", "curve.nc"),
    "surface.nc",
)
OF_FLUID = ("flow.png", "flow.pdf", "aperture.png", "aperture.pdf")
"""What can be saved, and what beside it if a fluid flows through the gap."""

_HEIGHT = 4.8  # of a figure of the flow [inch]


def download(arguments: Arguments, progress: Progress) -> bytes:
    """Write one of the files of a state to the folder of the session."""
    name = str(arguments.get("name"))
    state = state_in(arguments)
    known = (*FILES, *OF_FLUID) if state.fluid else FILES
    if name not in known:
        raise ControlError(f"there is no such file; there are {', '.join(known)}")
    folder = Path(arguments["session"]["folder"]) / "results"
    folder.mkdir(parents=True, exist_ok=True)
    surface = state.surface(state.n)
    if name == "surface.nc":
        rl.write(surface, folder / name)
        return frame({"file": name})
    stem, kind = name.split(".")
    drawn = _OF_FLUID | (adhesion.PICTURES if state.w is not None else {})
    if stem in drawn and kind in ("png", "pdf"):
        with TemporaryDirectory(dir=folder) as written, styled():
            figure = new_figure(PAGE, _HEIGHT)
            drawn[stem](figure.subplots(), state, surface, progress)
            save(figure, Path(written), stem)
            shutil.move(Path(written) / name, folder / name)
        return frame({"file": name})
    if state.w is not None:
        found = adhesion.cycle(state, adhesion.points(state), progress, measures(state))
        found.by_depths.write(folder / name)
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
        curve = result.curve
        if state.fluid:  # once more, with what flows
            forces = curve.force / state.force(1.0)
            curve = pressed_under(*(state, surface, forces, progress), measures=measures(state))
        curve.write(folder / name)
        return frame({"file": name})
    with TemporaryDirectory(dir=folder) as written:
        write_contact(result, Path(written))
        shutil.move(Path(written) / name, folder / name)
    return frame({"file": name})


def _draw_flow(axes: Axes, state: ExploreState, surface: rl.Surface, progress: Progress) -> None:
    """Where the fluid goes at the load."""
    curve = pressed_under(*(state, surface, np.array([state.F]), progress), fields=True)
    if curve.fields[0] is None:
        raise ControlError("the load was not solved, so that no flow is known", "F")
    rl.plot.flow(rl.flow(curve.fields[0]), "m", axes)


def _draw_apertures(
    axes: Axes, state: ExploreState, surface: rl.Surface, progress: Progress
) -> None:
    """How much comes through over the load, and on the way back from it if points yield."""
    forces = np.union1d(borne(state, FORCES), state.F)
    if state.hardness_bar is not None:
        back = state.F * np.array(UNLOADING[:-1])  # without zero, which has no place on the axis
        forces = np.concatenate([forces[forces <= state.F], back])
    curve = pressed_under(*(state, surface, forces, progress), measures=measures(state))
    rl.plot.hydraulic_aperture(curve, theories(state, surface), axes=axes)


_OF_FLUID = {"flow": _draw_flow, "aperture": _draw_apertures}
