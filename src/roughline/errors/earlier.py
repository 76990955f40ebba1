"""Spellings of version 0.3 that are gone, each with the one that says the same now."""

from __future__ import annotations

from typing import NoReturn

from roughline.errors import InputError

EARLIER = {
    "rl.Inlet": 'rl.Fluid("water", inlet="6 bar", seal="100 mm x 2 mm")',
    "rl.Outlet": 'rl.Fluid("water", inlet="6 bar", outlet="2 bar", seal="100 mm x 2 mm")',
    "rl.Seal": 'rl.Fluid("water", inlet="6 bar", seal="20 mm .. 24 mm")',
    "rl.FlowAlong": 'rl.Fluid("water", along="x")',
    "rl.Closure": "rl.Fluid(closure=True)",
    "rl.History": "rl.Question(..., history=True)",
    "rl.Unloading": "rl.Question(..., unload=True)",
    "rl.WholeCurve": "rl.Question(..., whole_curve=True)",
    "question.headings": "question.loading.headings",
    "question.forces": "question.loading.forces",
    "question.heights": "question.loading.heights",
    "question.scale": "question.loading.scale",
    "question.flow_along": "question.fluid.along",
    "question.finds_closing": "question.fluid.closure",
    "material.elasticity": "material.half_space()",
    "law.reach": "law.cutoff",
    "Question(friction=)": "ask=rl.Friction(0.3)",
    "Question(frequency=)": 'ask=rl.Ultrasound("5 MHz")',
    "Question(joint_area=)": 'ask=rl.Joint("2 cm^2")',
    "Question(theories=)": 'ask=rl.Theories("persson")',
    "Ensemble(work_bar=)": "law=rl.Dugdale(work_of_adhesion=0.2, range=0.4)",
    "Ensemble(range_bar=)": "law=rl.Dugdale(work_of_adhesion=0.2, range=0.4)",
    "Ensemble(attraction=)": "law=rl.Exponential(work_of_adhesion=0.2, range=0.4)",
    "Surface(removed_trend=)": 'rl.Surface(heights, sizes).detrended("tilt")',
    "Line(removed_trend=)": 'rl.Line(heights, length).detrended("tilt")',
    "press(max_iterations=)": "solver=rl.Solver(max_iterations=20000)",
    "press(precision=)": 'solver=rl.Solver(precision="float64")',
    "press_creep(E_star=)": "half_space=rl.Homogeneous(E_star=1.0)",
    "press_creep(periodic=)": "half_space=rl.Homogeneous(E_star=1.0, periodic=True)",
    "sealing_pressure(E_star=)": "half_space=rl.Homogeneous(E_star=1.0, periodic=True)",
    "sealing_pressure(periodic=)": "half_space=rl.Homogeneous(E_star=1.0, periodic=True)",
    "sealing_pressure(hardness=)": "law=rl.Yielding(hardness=0.05)",
    "read(most_missing=)": "missing=rl.Missing(most=0.3)",
    "read(mask=)": 'missing=rl.Missing(mask="leave-out")',
    "Reading(most_missing=)": "missing=rl.Missing(most=0.3)",
    "Reading(mask=)": 'missing=rl.Missing(mask="leave-out")',
}
"""Names of the package, and parts and keywords of what it offers, with what is to be written."""


def refuse_part(of: str, name: str, kind: str) -> NoReturn:
    """Refuse a part that a value has not: one that is gone with what is to be written."""
    if new := EARLIER.get(f"{of}.{name}"):
        raise InputError(f"there is no {of}.{name} any more; write {new}")
    raise AttributeError(f"{kind!r} object has no attribute {name!r}")
