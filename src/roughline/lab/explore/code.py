"""A state as code: lines of Python, or commands, that give the same again."""

from __future__ import annotations

import shlex

from roughline.assessment.question import UNLOADING
from roughline.lab.controls import as_code
from roughline.lab.explore import adhesion
from roughline.lab.explore.state import ExploreState, state_in
from roughline.lab.frames import frame
from roughline.lab.server.tasks import Arguments, Progress

_OF_YIELD = """print("unloading_stiffness", curve.unloading_stiffness[0], "N/m")
print("plastic_fraction", curve.plastic_fraction[0])
print("largest indentation over rms height", curve.indentation[0] / surface.rms_height)
"""
_OF_FLUID = """flow = rl.flow(curve.fields[0])
print("hydraulic aperture over rms height", flow.hydraulic_aperture / surface.rms_height)
print("sealed", flow.is_sealed)
"""
_NO_COMMAND = {
    "fluid": "# the flow through the gap under a contact modulus has no command: take it as Python",
    "w": "# the way back and the pull-off need two materials: take them as Python",
}


def code(arguments: Arguments, progress: Progress) -> bytes:
    """The code of a state: `which` says in what language."""
    state = state_in(arguments)
    text = _as_python(state) if arguments.get("which") == "python" else _as_command(state)
    return frame({"text": text})


def _as_python(state: ExploreState) -> str:
    """Lines that generate the surface, and press it as the page does."""
    periodic = ", periodic=True" if state.periodic else ""
    law_lines, forces, of_law = "", "forces=[force]", ""
    if state.hardness_bar is not None:
        bar = as_code(state.hardness_bar)
        law_lines = f"hardness = {bar} * E_star * surface.rms_slope  # Pa\n"
        path = f"[force * share for share in {(1.0, *UNLOADING)}]"  # the last ones unload
        forces, of_law = f"hardness=hardness, forces={path}", _OF_YIELD
    if state.w is not None:
        law_lines, of_law = adhesion.in_python(state), adhesion.ANSWERS.format(periodic=periodic)
        forces = adhesion.FORCES
    return f"""import math

import roughline as rl

length = {as_code(state.length)}  # m
E_star = {as_code(state.E_star)}  # Pa
spectrum = rl.SelfAffine(
    fractal_dimension={as_code(state.D_f)},
    length=length,
    rms_height={as_code(state.rms_height)},
    q_roll=2 * math.pi / ({as_code(state.roll_off)} * length),
    q_high=2 * math.pi / ({as_code(state.cutoff_used)} * length),
)
surface = spectrum.surface(n={state.n}, rng={state.seed})
force = {as_code(state.F)} * E_star * surface.rms_height * surface.length  # N
{law_lines}curve = rl.press(surface, E_star=E_star, {forces}{periodic}, fields=[0])

print("stiffness_bar", curve.stiffness_bar[0])
print("area_fraction_corrected", curve.area_fraction_corrected[0])
print("depth over rms height", curve.depth[0] / surface.rms_height)
{of_law}{_OF_FLUID if state.fluid else ""}"""


def _as_command(state: ExploreState) -> str:
    """Commands that write the surface to a file, and press it."""
    borne, law = state.hardness, state.law
    generate = [
        *("roughline", "generate", "--out", "surface.nc"),
        *("--length", f"{as_code(state.length)} m"),
        *("--rms-height", f"{as_code(state.rms_height)} m"),
        *("--fractal-dimension", as_code(state.D_f)),
        *("--roll-off", f"{as_code(state.roll_off * state.length)} m"),
        *("--cutoff", f"{as_code(state.cutoff_used * state.length)} m"),
        *("--points", str(state.n), "--seed", str(state.seed)),
    ]
    press = [
        *("roughline", "press", "surface.nc"),
        *(
            "--modulus",
            f"{as_code(state.E_star)} Pa",
            "--load",
            f"{as_code(state.force(state.F))} N",
        ),
        *(["--periodic"] if state.periodic else []),
        *(["--hardness", f"{as_code(borne)} Pa", "--unload"] if borne is not None else []),
    ]
    if state.w is not None and law is not None:
        work, reach = (as_code(float(law.settings[name])) for name in ("work_of_adhesion", "range"))
        press += ["--adhesion", f"{work} J/m^2 over {reach} m"]
    without = [text for key, text in _NO_COMMAND.items() if getattr(state, key)]
    lines = [shlex.join(generate), shlex.join(press), *without]
    return "".join(f"{line}\n" for line in lines)
