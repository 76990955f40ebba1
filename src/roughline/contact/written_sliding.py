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
from roughline.halfspace.friction.slip_path import ShearLoad, Slid, slide_path
from roughline.halfspace.search.problem import Contact, Load, Method, Outcome, Problem


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
        return SlidingCurve(friction=self._shear.friction, **given)

    def _with_shear(self, load: int, plain: Fields | None) -> SlidingFields | None:
        if plain is None or load not in self._kept:
            return None
        given: dict[str, Any] = {each.name: getattr(plain, each.name) for each in fields(plain)}
        shear, slip, total, sticks = self._kept[load]
        return SlidingFields(**given, shear=shear, slip=slip, slip_total=total, stick=sticks)
