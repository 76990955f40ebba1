"""A state as code: lines of Python, or commands, that give the same again."""

from __future__ import annotations

import shlex

import roughline as rl
from roughline.lab.controls import as_code
from roughline.lab.explore.reading import state_in
from roughline.lab.explore.state import ExploreState
from roughline.lab.frames import frame
from roughline.lab.server.tasks import Arguments, Progress


def code(arguments: Arguments, progress: Progress) -> bytes:
    """The code of a state: `which` says in what language."""
    state = state_in(arguments)
    text = _as_python(state) if arguments.get("which") == "python" else _as_command(state)
    return frame({"text": text})


def _as_python(state: ExploreState) -> str:
    """Lines that generate the surface, and press it as the page does."""
    lines, answers, forces = "", "", "forces=[force]"
    for each in state.added:
        before, arguments, after = each.in_python(state)
        lines, answers, forces = lines + before, answers + after, arguments or forces
    is_layered = not isinstance(state.half_space, rl.Homogeneous)
    over_base = " * half_space.E_star / E_star" if is_layered else ""  # else over that of the layer
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
{lines}curve = rl.press(surface, {state.body_as_code}, {forces}, fields=[0])

print("stiffness_bar", curve.stiffness_bar[0]{over_base})
print("area_fraction_corrected", curve.area_fraction_corrected[0])
print("depth over rms height", curve.depth[0] / surface.rms_height)
{answers}"""


def _as_command(state: ExploreState) -> str:
    """Commands that write the surface to a file, and press it."""
    generate = [
        *("roughline", "generate", "--out", "surface.nc"),
        *("--length", f"{as_code(state.length)} m"),
        *("--rms-height", f"{as_code(state.rms_height)} m"),
        *("--fractal-dimension", as_code(state.D_f)),
        *("--roll-off", f"{as_code(state.roll_off * state.length)} m"),
        *("--cutoff", f"{as_code(state.cutoff_used * state.length)} m"),
        *("--points", str(state.n), "--seed", str(state.seed)),
    ]
    press = ["roughline", "press", "surface.nc", "--load", f"{as_code(state.force(state.F))} N"]
    without = []
    for each in state.added:
        arguments, left_out = each.in_command(state)
        press += arguments
        without += [f"# {left_out}: take it as Python"] if left_out else []
    bodies = state.materials
    modulus = ["--modulus", f"{as_code(state.E_star)} Pa"]
    press += ["--materials", ", ".join(bodies)] if bodies else modulus
    press += ["--periodic"] if state.periodic else []
    lines = [shlex.join(generate), shlex.join(press), *without]
    return "".join(f"{line}\n" for line in lines)
