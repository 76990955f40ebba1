"""A state as code: lines of Python, or commands, that give the same again."""

from __future__ import annotations

import shlex

from roughline.assessment.question import UNLOADING
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
_NO_COMMAND = (
    "# the flow through the gap under a contact modulus has no command: take it as Python\n"
)


def code(arguments: Arguments, progress: Progress) -> bytes:
    """The code of a state: `which` says in what language."""
    state = state_in(arguments)
    text = _as_python(state) if arguments.get("which") == "python" else _as_command(state)
    return frame({"text": text})


def _as_python(state: ExploreState) -> str:
    """Lines that generate the surface, and press it as the page does."""
    periodic = ", periodic=True" if state.periodic else ""
    hardness_line, forces, of_yield = "", "forces=[force]", ""
    if state.hardness_bar is not None:
        bar = _number(state.hardness_bar)
        hardness_line = f"hardness = {bar} * E_star * surface.rms_slope  # Pa\n"
        path = f"[force * share for share in {(1.0, *UNLOADING)}]"  # the last ones unload
        forces, of_yield = f"hardness=hardness, forces={path}", _OF_YIELD
    return f"""import math

import roughline as rl

length = {_number(state.length)}  # m
E_star = {_number(state.E_star)}  # Pa
spectrum = rl.SelfAffine(
    fractal_dimension={_number(state.D_f)},
    length=length,
    rms_height={_number(state.rms_height)},
    q_roll=2 * math.pi / ({_number(state.roll_off)} * length),
    q_high=2 * math.pi / ({_number(state.cutoff_used)} * length),
)
surface = spectrum.surface(n={state.n}, rng={state.seed})
force = {_number(state.F)} * E_star * surface.rms_height * surface.length  # N
{hardness_line}curve = rl.press(surface, E_star=E_star, {forces}{periodic}, fields=[0])

print("stiffness_bar", curve.stiffness_bar[0])
print("area_fraction_corrected", curve.area_fraction_corrected[0])
print("depth over rms height", curve.depth[0] / surface.rms_height)
{of_yield}{_OF_FLUID if state.fluid else ""}"""


def _as_command(state: ExploreState) -> str:
    """Commands that write the surface to a file, and press it."""
    borne = state.hardness
    generate = [
        *("roughline", "generate", "--out", "surface.nc"),
        *("--length", f"{_number(state.length)} m"),
        *("--rms-height", f"{_number(state.rms_height)} m"),
        *("--fractal-dimension", _number(state.D_f)),
        *("--roll-off", f"{_number(state.roll_off * state.length)} m"),
        *("--cutoff", f"{_number(state.cutoff_used * state.length)} m"),
        *("--points", str(state.n), "--seed", str(state.seed)),
    ]
    press = [
        *("roughline", "press", "surface.nc"),
        *(
            "--modulus",
            f"{_number(state.E_star)} Pa",
            "--load",
            f"{_number(state.force(state.F))} N",
        ),
        *(["--periodic"] if state.periodic else []),
        *(["--hardness", f"{_number(borne)} Pa", "--unload"] if borne is not None else []),
    ]
    without_flow = _NO_COMMAND if state.fluid else ""
    return f"{shlex.join(generate)}\n{shlex.join(press)}\n{without_flow}"


def _number(value: float) -> str:
    """A number that is read as the same again."""
    return repr(float(f"{value:.12g}"))
