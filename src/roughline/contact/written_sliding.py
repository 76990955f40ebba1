"""What friction adds to the curve of a surface, written load by load."""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from dataclasses import fields
from typing import Any

import numpy as np

from roughline.computing.arrays import Mask, Real
from roughline.contact.curve import SurfaceCurve
from roughline.contact.fields import Fields
from roughline.contact.scaled_surface import ScaledSurface
from roughline.contact.shear_loads import ShearLoads
from roughline.contact.sliding import SlidingCurve, SlidingFields
from roughline.contact.status import Status
from roughline.facts.fact import Fact
from roughline.halfspace.friction.slid import ShearLoad, Slid
from roughline.halfspace.friction.slip_path import slide_path
from roughline.halfspace.search.problem import Contact, Load, Method, Outcome, Problem

# Error of the depth of two materials in one load from first touch, over beta²: at most so much on
# rough contacts with beta of 0.29 and 0.5, mu of 0.1 to 1, free and repeated; in N even loads it
# falls as this power of 1 / N.
_GROWTH_ERROR, _GROWTH_POWER = 0.035, 1.6
_WARNED_GROWTH = 3e-4  # from which on it is told

# Of a load that turns by a right angle 4 parts are off by 0.4 to 1.7 % of the slide, 16 by 0.1 to
# 0.25 %.
_LARGEST_TURN, _FINE_TURN = math.radians(25), math.radians(90 / 16)


class WrittenSliding:
    """What friction adds to a curve, written load by load."""

    def __init__(self, curve: SurfaceCurve, scaled: ScaledSurface, shear: ShearLoads) -> None:
        self._curve, self._scaled, self._shear = curve, scaled, shear
        count = curve.status.size
        self._vectors = {name: np.full((count, 2), math.nan) for name in ("shear_force", "slide")}
        self._tensors = {
            name: np.full((count, 2, 2), math.nan)
            for name in ("shear_stiffness", "shear_stiffness_back")
        }
        self._numbers = {
            name: np.full(count, math.nan)
            for name in ("stick_fraction", "shear_limit", "dissipated")
        }
        self._total: Real = np.zeros(scaled.surface.shape)
        self._kept: dict[int, tuple[Real, Real, Real, Mask]] = {}

    def contacts(
        self, bodies: Problem, path: Sequence[Load], method: Method, kept: frozenset[int]
    ) -> Iterator[Contact]:
        """Solve for the state under each load in turn, write it, and hand on the contact.

        The loads are in the units of the scaled surface.
        """
        scaled, shear = self._scaled, self._shear
        friction = shear.friction.scaled(scaled.pressure)
        if shear.control == "slides":
            along = [ShearLoad(slide=(x, y)) for x, y in (shear.values / scaled.height).tolist()]
        else:
            along = [ShearLoad(force=(x, y)) for x, y in (shear.values / scaled.force).tolist()]
        loads = list(zip(path, along, strict=True))
        for load, slid in enumerate(slide_path(bodies, friction, loads, method)):
            self._write(load, slid, keep=load in kept)
            yield slid.contact_as_solved

    def _write(self, load: int, slid: Slid, *, keep: bool) -> None:
        """Write a state under one load, in the units of the scaled surface."""
        scaled = self._scaled
        self._numbers["shear_limit"][load] = slid.limit * scaled.force
        if slid.outcome is not Outcome.CONVERGED:
            return
        nodes, stiffness = slid.contact.nodes, scaled.force / scaled.height
        slip = slid.slip * scaled.height
        self._total.flat[nodes] += np.hypot(slip[:, 0], slip[:, 1])
        self._vectors["shear_force"][load] = slid.force * scaled.force
        self._vectors["slide"][load] = slid.slide * scaled.height
        prescribed = "slide" if self._shear.control == "slides" else "shear_force"
        self._vectors[prescribed][load] = self._shear.values[load]
        if slid.tangents is not None:
            self._tensors["shear_stiffness"][load] = slid.tangents.on * stiffness
            self._tensors["shear_stiffness_back"][load] = slid.tangents.back * stiffness
        self._numbers["stick_fraction"][load] = slid.sticks.mean() if nodes.size else 0.0
        self._numbers["dissipated"][load] = slid.dissipated * scaled.force * scaled.height
        if keep:
            shape = scaled.surface.shape
            shear, slipped = np.zeros((2, *shape, 2))
            sticks = np.zeros(shape, dtype=bool)
            shear.reshape(-1, 2)[nodes] = slid.shear * scaled.pressure
            slipped.reshape(-1, 2)[nodes] = slip
            sticks.flat[nodes] = slid.sticks
            self._kept[load] = shear, slipped, self._total.copy(), sticks

    def extended(self, curve: SurfaceCurve) -> SlidingCurve:
        """Return a curve with what friction adds, NaN where it was not solved."""
        for values in (*self._vectors.values(), *self._tensors.values(), *self._numbers.values()):
            solved = curve.converged | (curve.status == Status.SLIDES)
            values[~solved] = np.nan
        given: dict[str, Any] = {each.name: getattr(curve, each.name) for each in fields(curve)}
        given["fields"] = tuple(self._with_shear(i, each) for i, each in enumerate(curve.fields))
        given |= self._vectors | self._tensors | self._numbers
        turns = _facts_on_turns(self._shear.values)
        given["facts"] = (*curve.facts, *_facts_on_growth(curve, self._scaled), *turns)
        return SlidingCurve(friction=self._shear.friction, **given)

    def _with_shear(self, load: int, plain: Fields | None) -> SlidingFields | None:
        if plain is None or load not in self._kept:
            return None
        given: dict[str, Any] = {each.name: getattr(plain, each.name) for each in fields(plain)}
        shear, slip, total, sticks = self._kept[load]
        return SlidingFields(**given, shear=shear, slip=slip, slip_total=total, stick=sticks)


def _facts_on_growth(curve: SurfaceCurve, scaled: ScaledSurface) -> Iterator[Fact]:
    """Say by how much coupled bodies are off under the largest load, if they grew in few loads."""
    loads = (curve.force if curve.control == "forces" else curve.depth)[curve.converged]
    if not (scaled.half_space.is_coupled and loads.size and loads.max() > 0):
        return
    nearest = np.maximum.accumulate(np.append(0.0, loads))
    step = float(np.diff(nearest).max() / nearest[-1])
    q = np.array([math.pi / max(scaled.spacing)])
    beta = float((scaled.half_space.coupling_spectrum(q) / scaled.half_space.spectrum(q))[0])
    error = _GROWTH_ERROR * beta**2 * step**_GROWTH_POWER
    if error > _WARNED_GROWTH:
        yield Fact("grown_in_few_loads", beta=abs(beta), error=error)


def _facts_on_turns(shear: Real) -> Iterator[Fact]:
    """Say how finely to cut, where the line along which bodies are sheared turns within a load."""
    before, after = shear[:-1], shear[1:]
    along = np.abs((before * after).sum(axis=1))
    across = np.abs(before[:, 0] * after[:, 1] - before[:, 1] * after[:, 0])
    angles = np.arctan2(across, along)
    if angles.size and (most := float(angles.max())) > _LARGEST_TURN:
        at, parts = int(angles.argmax()) + 1, math.ceil(most / _FINE_TURN)
        yield Fact("turns_within_a_load", load=at, angle=math.degrees(most), parts=parts)
