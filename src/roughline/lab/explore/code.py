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
    added = [each.code(state) for each in state.added]
    usual = f"half_space = rl.Homogeneous(E_star{', periodic=True' if state.periodic else ''})\n"
    half_space = next(filter(None, (each.half_space for each in added)), usual)
    before, after = ("".join(getattr(each, at) for each in added) for at in ("before", "after"))
    forces = "".join(each.arguments for each in added) or "forces=[force]"
    load = state.typed("F")
    over = f"{as_code(state.F)} * E_star * surface.rms_height * surface.length"
    force = f"load_in_newtons({load!r}, surface.area)" if load else over
    roll_off = state.in_python("roll_off", "m", f"({as_code(state.roll_off)} * length)")
    cutoff = state.in_python("cutoff", "m", f"({as_code(state.cutoff_used)} * length)")
    return f"""import math

import roughline as rl
from roughline.margins.press import facts_on_press
from roughline.units import in_si{", load_in_newtons" * ("load_in_newtons" in force + before)}

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
{half_space}{before}curve = rl.press(surface, half_space=half_space, {forces}, fields=[0])

print("k / (E* L)", curve.stiffness[0] / (E_star * length))
print("area_fraction_corrected", curve.area_fraction_corrected[0])
print("depth over rms height", curve.depth[0] / surface.rms_height)
{after}for fact in facts_on_press(surface, curve):
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
    added = [each.code(state) for each in state.added]
    materials = next(filter(None, (each.materials for each in added)), "")
    bodies = {"materials": materials} if materials else {"E_star": state.E}
    press = bodies | {"loads": in_words("F", "N", state.force(state.F))}
    words = [*chain(*(each.command for each in added)), *[_FLAGS["periodic"]] * state.periodic]
    flags = chain.from_iterable((_FLAGS[name], text) for name, text in press.items())
    lines = [
        shlex.join(["roughline", "generate", *chain(*generate.items())]),
        shlex.join(["roughline", "press", "surface.nc", *flags, *words]),
        *(f"# {each.left_out}: take it as Python" for each in added if each.left_out),
    ]
    return "".join(f"{line}\n" for line in lines)
