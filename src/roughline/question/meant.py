"""How a question was meant on a body: its loads, pressures and strains, before it is pressed."""

from __future__ import annotations

from collections.abc import Iterator, Sequence

from roughline.contact.strain import LARGE_STRAIN
from roughline.facts.fact import Fact
from roughline.question.arguments import has_forces, several
from roughline.question.kinds import is_map, nominal_area
from roughline.question.question import Question
from roughline.topography.body import Body, side_lengths

STEEP_SLOPE = 0.5
"""Rms slope above which a warning says that half-spaces assume small slopes."""


def facts_on_strain(body: Body, strains: Sequence[tuple[float, Fact]]) -> Iterator[Fact]:
    """Say where heights are steep, and which load strains bodies beyond what is linear elastic."""
    if body.rms_slope > STEEP_SLOPE:
        yield Fact("steep", slope=body.rms_slope, limit=STEEP_SLOPE)
    if large := [each for each in strains if each[0] > LARGE_STRAIN]:
        yield Fact("strained", strain=max(large, key=lambda each: each[0])[1])


def facts_on_loads(question: Question, body: Body) -> Iterator[Fact]:
    """Say of each load what it is in all, and over which area, and which pressures are absolute."""
    area, joint, loading = nominal_area(body), question.joint, question.loading
    loads = loading.headings[: len(several(question.loads))]  # unloading speaks for itself
    for load, force in dict(zip(loads, loading.forces(area), strict=False)).items():
        numbers = {"load": load, "pressure": force / area, "sides": side_lengths(body)}
        if force and joint is None:
            yield Fact("load_on_body", **numbers, force=force)
        elif force:
            on_joint = {"force": force * loading.scale(area), "joint": joint, "on_map": force}
            yield Fact("load_on_joint", **numbers, **on_joint)
    if has_forces(question.loads) and joint is None and is_map(body):
        yield Fact("forces_on_map_alone")
    sealing = question.sealing
    if sealing is not None and sealing.inlet is not None:
        pressures = {"inlet": sealing.inlet, "outlet": sealing.outlet}
        yield Fact("absolute_pressures", fluid=sealing.medium.name, **pressures)
    if question.attraction is not None and question.pair is None:
        is_strip = isinstance(question.periodic, str)
        yield Fact("no_pull_off_of_strip" if is_strip else "no_pull_off_without_materials")
