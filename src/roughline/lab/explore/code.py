"""A state as code: lines of Python, or commands, that give the same again."""

from __future__ import annotations

import shlex
from itertools import chain

from roughline.lab.controls import as_code
from roughline.lab.explore.reading import state_in
from roughline.lab.explore.state import ExploreState
from roughline.lab.frames import frame
from roughline.lab.server.tasks import Arguments, Progress
from roughline.question.fields import FIELDS

_FLAGS = {each.name: each.first_flag for each in FIELDS}


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
    body, _ = state.body_in_python
    load = state.typed("F")
    over = f"{as_code(state.F)} * E_star * surface.rms_height * surface.length"
    force = f"load_in_newtons({load!r}, surface.area)" if load else over
    roll_off = state.in_python("roll_off", "m", f"({as_code(state.roll_off)} * length)")
    cutoff = state.in_python("cutoff", "m", f"({as_code(state.cutoff_used)} * length)")
    return f"""import math

import roughline as rl
from roughline.margins.press import facts_on_press
from roughline.units import in_si{", load_in_newtons" if load else ""}

length = in_si({state.L!r}, "m", "length")
E_star = in_si({state.E!r}, "Pa", "E_star")
spectrum = rl.SelfAffine(
    fractal_dimension={as_code(state.D_f)},
    length=length,
    rms_height={state.in_python("h", "m", as_code(state.rms_height))},  # m
    q_roll=2 * math.pi / {roll_off},
    q_high=2 * math.pi / {cutoff},
)
surface = spectrum.surface(n={state.n}, rng={state.seed})
force = {force}  # N
{lines}curve = rl.press(surface, {body}, {forces}, fields=[0])

print("k / (E* L)", curve.stiffness[0] / (E_star * length))
print("area_fraction_corrected", curve.area_fraction_corrected[0])
print("depth over rms height", curve.depth[0] / surface.rms_height)
{answers}for fact in facts_on_press(surface, curve):
    print(fact)
"""


def _as_command(state: ExploreState) -> str:
    """Commands that write the surface to a file, and press it."""
    side, in_words = state.length, state.in_words
    generate = {
        "--out": "surface.nc",
        "--length": state.L,
        "--rms-height": in_words("h", "m", state.rms_height),
        "--fractal-dimension": as_code(state.D_f),
        "--roll-off": in_words("roll_off", "m", state.roll_off * side),
        "--cutoff": in_words("cutoff", "m", state.cutoff_used * side),
        "--points": str(state.n),
        "--seed": str(state.seed),
    }
    bodies = {"materials": ", ".join(state.materials)} if state.materials else {"E_star": state.E}
    press = bodies | {"loads": in_words("F", "N", state.force(state.F))}
    words, without = [], []
    for each in state.added:
        arguments, left_out = each.in_command(state)
        words += arguments
        without += [f"# {left_out}: take it as Python"] if left_out else []
    words += [_FLAGS["periodic"]] if state.periodic else []
    flags = chain.from_iterable((_FLAGS[name], text) for name, text in press.items())
    lines = [
        shlex.join(["roughline", "generate", *chain(*generate.items())]),
        shlex.join(["roughline", "press", "surface.nc", *flags, *words]),
        *without,
    ]
    return "".join(f"{line}\n" for line in lines)
