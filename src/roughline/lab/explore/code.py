"""A state as code: lines of Python, or commands, that give the same again."""

from __future__ import annotations

import shlex
from itertools import chain

from roughline.assessment.fields import FIELDS
from roughline.assessment.question import UNLOADING
from roughline.lab.controls import Texts, as_code, has_unit, texts_of
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
_FLAGS = {each.name: each.first_flag for each in FIELDS}
_NO_COMMAND = {
    "fluid": "# the flow through the gap under a contact modulus has no command: take it as Python",
    "w": "# the way back and the pull-off need two materials: take them as Python",
}


def code(arguments: Arguments, progress: Progress) -> bytes:
    """The code of a state: `which` says in what language."""
    state, said = state_in(arguments), texts_of(arguments)
    write = _as_python if arguments.get("which") == "python" else _as_command
    return frame({"text": write(state, said)})


def _typed(said: Texts, key: str, state: ExploreState) -> str:
    """A text with a unit as it was typed, if it counts; else none."""
    text = said.get(key, "").strip()
    counts = {"h": state.rms == "height", "cutoff": state.cutoff == state.cutoff_used}
    return text if has_unit(text) and counts.get(key, True) else ""


def _as_python(state: ExploreState, said: Texts) -> str:
    """Lines that generate the surface, and press it as the page does."""

    def value(key: str, unit: str, otherwise: str) -> str:
        """A quantity as it was typed, or else a number times what it is over."""
        text = _typed(said, key, state)
        return f"in_si({text!r}, {unit!r}, {key!r})" if text else otherwise

    periodic = ", periodic=True" if state.periodic else ""
    law_lines, forces, of_law = "", "forces=[force]", ""
    if state.hardness_bar is not None:
        over = f"{as_code(state.hardness_bar)} * E_star * surface.rms_slope"
        law_lines = f"hardness = {value('hardness_bar', 'Pa', over)}  # Pa\n"
        path = f"[force * share for share in {(1.0, *UNLOADING)}]"  # the last ones unload
        forces, of_law = f"hardness=hardness, forces={path}", _OF_YIELD
    if state.w is not None:
        work = f"{as_code(state.w)} * E_star * surface.rms_height**2 / length"
        reach = f"{as_code(state.h0)} * surface.rms_height"
        law_lines = adhesion.LAW.format(
            work=value("w", "J/m**2", work), reach=value("h0", "m", reach)
        )
        forces, of_law = adhesion.FORCES, adhesion.ANSWERS.format(periodic=periodic)
    load = _typed(said, "F", state)
    over = f"{as_code(state.F)} * E_star * surface.rms_height * surface.length"
    force = f"load_in_newtons({load!r}, surface.area)" if load else over
    roll_off = value("roll_off", "m", f"({as_code(state.roll_off)} * length)")
    cutoff = value("cutoff", "m", f"({as_code(state.cutoff_used)} * length)")
    return f"""import math

import roughline as rl
from roughline.units import in_si{", load_in_newtons" if load else ""}

length = in_si({state.L!r}, 'm', 'length')
E_star = in_si({state.E!r}, 'Pa', 'E_star')
spectrum = rl.SelfAffine(
    fractal_dimension={as_code(state.D_f)},
    length=length,
    rms_height={value("h", "m", as_code(state.rms_height))},  # m
    q_roll=2 * math.pi / {roll_off},
    q_high=2 * math.pi / {cutoff},
)
surface = spectrum.surface(n={state.n}, rng={state.seed})
force = {force}  # N
{law_lines}curve = rl.press(surface, E_star=E_star, {forces}{periodic}, fields=[0])

print("stiffness_bar", curve.stiffness_bar[0])
print("area_fraction_corrected", curve.area_fraction_corrected[0])
print("depth over rms height", curve.depth[0] / surface.rms_height)
{of_law}{_OF_FLUID if state.fluid else ""}"""


def _as_command(state: ExploreState, said: Texts) -> str:
    """Commands that write the surface to a file, and press it."""

    def value(key: str, unit: str, number: float) -> str:
        """A quantity as it was typed, or else with its unit."""
        return _typed(said, key, state) or f"{as_code(number)} {unit}"

    side = state.length
    generate = {
        "--out": "surface.nc",
        "--length": state.L,
        "--rms-height": value("h", "m", state.rms_height),
        "--fractal-dimension": as_code(state.D_f),
        "--roll-off": value("roll_off", "m", state.roll_off * side),
        "--cutoff": value("cutoff", "m", state.cutoff_used * side),
        "--points": str(state.n),
        "--seed": str(state.seed),
    }
    press = {"E_star": state.E, "loads": value("F", "N", state.force(state.F))}
    switches = ["periodic"] if state.periodic else []
    if state.hardness is not None:
        press["hardness"] = value("hardness_bar", "Pa", state.hardness)
        switches.append("unload")
    if state.w is not None and state.law is not None:
        work, reach = (float(state.law.settings[name]) for name in ("work_of_adhesion", "range"))
        press["adhesion"] = f"{value('w', 'J/m^2', work)} over {value('h0', 'm', reach)}"
    words = [word for name, text in press.items() for word in (_FLAGS[name], text)]
    words += [_FLAGS[name] for name in switches]
    lines = [
        shlex.join(["roughline", "generate", *chain(*generate.items())]),
        shlex.join(["roughline", "press", "surface.nc", *words]),
        *(text for key, text in _NO_COMMAND.items() if getattr(state, key)),
    ]
    return "".join(f"{line}\n" for line in lines)
