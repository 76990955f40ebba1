"""Loads of a question on a body, its hardness, and the settings with which it is pressed again."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace
from typing import TypeVar

import numpy as np

from roughline.computing.arrays import Indices, Mask
from roughline.contact.arguments import given_law, sticking_law, yielding_law
from roughline.contact.curve import Curve, SurfaceCurve
from roughline.contact.loads import GivenLoads, surface_loads
from roughline.contact.measures import Measure
from roughline.contact.pressing import Pressing
from roughline.contact.selection import among_loads, at_loads
from roughline.contact.status import Status
from roughline.engineering.attraction import Attraction
from roughline.errors import InputError
from roughline.errors.words import called
from roughline.halfspace.elasticity.half_space import HalfSpace, Periodic
from roughline.halfspace.friction.law import Friction
from roughline.halfspace.laws.law import ContactLaw
from roughline.question.kinds import is_map, nominal_area
from roughline.question.loading import DEFAULT_LOADS
from roughline.question.question import Question
from roughline.topography.body import Body, Line, Surface
from roughline.units import engineering

_CurveType = TypeVar("_CurveType", bound=Curve)

LoadProgress = Callable[[int, int], None]
"""Called with (loads done, loads in all)."""

_FORCE_ROUNDING = 1e-9  # of the force under which all of the area is at the hardness
_LIGHT_PRESSURE = 1e-6  # over the contact modulus; any body can be pressed under it


@dataclass(frozen=True)
class Hardness:
    """Hardness of the softer body: it lies between value / factor and value * factor."""

    value: float  # [Pa]
    factor: float

    @property
    def ends(self) -> tuple[float, float]:
        """The softest and the hardest that the body may be. [Pa]"""
        return self.value / self.factor, self.value * self.factor


def find_hardness(question: Question) -> Hardness | None:
    """Return the hardness that a question is answered with; None if the bodies are elastic."""
    if question.elastic:
        return None
    if question.hardness is not None:
        return Hardness(question.hardness, 1.0) if question.hardness < float("inf") else None
    pair = question.pair
    if pair is None or pair.hardness is None:
        return None
    return Hardness(pair.hardness, pair.hardness_factor)


@dataclass(frozen=True, eq=False)
class LoadCase:
    """A body, and the loads and settings under which it is pressed."""

    body: Body
    half_space: HalfSpace
    forces: list[float]  # with which it presses, in the order in which they are applied [N]
    depths: list[float]  # instead of forces [m]
    n_loads: int | None  # instead of both: forces spaced from first touch to saturation
    asked: Sequence[int] = ()  # which loads were asked for, in the order asked; none if not named
    grid_error: bool = False
    levelled: bool = False  # without its tilt, which a periodic half-space cannot have
    hardness: float | None = None  # None if both bodies are elastic [Pa]
    attraction: Attraction | None = None  # of bodies that stick, with its range
    fields: Sequence[int] = ()
    measures: Sequence[Measure] = ()
    rtol: float = 1e-6
    among: Mask | None = None  # which loads of a curve that is known these are; None for all
    lifted: Mask | None = None  # of forces, under which a fluid lifts the body; None for none
    friction: Friction | None = (
        None  # of a body that is sheared, and its shear forces along x and y
    )
    shear_forces: Sequence[tuple[float, float]] = ()

    @classmethod
    def of(cls, question: Question, body: Body) -> LoadCase:
        """The loads of a question on a body, spaced ones of a line scan included."""
        area, loading = nominal_area(body), question.loading
        pressing = question.pressing(area)
        forces, asked = loading.path(pressing)
        depths, asked_depths = loading.path(loading.heights())
        n_loads, hardness, attraction = loading.n_loads, None, question.attraction
        if isinstance(body, Surface):
            if attraction is not None:
                attraction = attraction.on_grid(max(body.spacing), question.half_space.softest)
                forces = forces or ([] if depths else _spaced(question, body))
                n_loads = None
            _refuse_beyond_hardness(question, area)
            known = find_hardness(question)
            hardness = None if known is None else known.value
        elif body.kind == "profile" and not forces:
            forces = _forces_of_a_scan(body, question.modulus, n_loads or DEFAULT_LOADS)
            n_loads = None
        return cls(
            body,
            question.half_space,
            forces,
            depths,
            n_loads,
            asked or asked_depths,
            levelled=question.joint is not None and is_map(body),
            hardness=hardness,
            attraction=attraction,
            lifted=_lifted(question, forces) if pressing else None,
        )

    @property
    def periodic(self) -> Periodic:
        """Along which axes the body is repeated."""
        return self.half_space.periodic

    @property
    def count(self) -> int:
        """Number of loads."""
        return len(self.forces) or len(self.depths) or self.n_loads or 0

    @property
    def largest(self) -> int:
        """Number of the largest load; of spaced ones, the last."""
        values = self.forces or self.depths
        return values.index(max(values)) if values else self.count - 1

    def asked_loads(self, curve: Curve) -> Indices:
        """Which loads of the curve were asked for, in the order asked; all if none was named."""
        return np.array(self.asked) if self.asked else np.arange(curve.status.size)

    def solved_loads(self, curve: Curve) -> Mask:
        """Which loads of a curve were solved, and leave some of the area below the hardness."""
        if self.hardness is None or not isinstance(curve, SurfaceCurve):
            return curve.converged
        most = self.hardness * curve.length**2
        return curve.converged & (np.nan_to_num(curve.force) < most * (1 - _FORCE_ROUNDING))

    def under_forces_from(self, curve: Curve) -> LoadCase:
        """These loads as the forces of a curve that were solved, and that the body bears."""
        solved = self.solved_loads(curve)
        forces, numbers = curve.force[solved].tolist(), np.cumsum(solved) - 1
        fields = [int(numbers[load]) for load in self.fields if solved[load]]
        others = replace(self, forces=forces, depths=[], n_loads=None, fields=fields)
        return replace(others, among=solved, lifted=None)

    def alone_under(self, forces: Sequence[float]) -> LoadCase:
        """The body under other forces, without all that is found beside. [N]"""
        others = replace(self, forces=[*forces], asked=(), fields=(), measures=())
        return replace(others, grid_error=False, lifted=None)

    def sheared(
        self, half_space: HalfSpace, friction: float, shear_forces: Sequence[tuple[float, float]]
    ) -> LoadCase:
        """The same loads on a half-space that knows shear, each with its shear forces [N]."""
        rubbing = Friction(friction)
        return replace(self, half_space=half_space, friction=rubbing, shear_forces=shear_forces)

    def with_hardness(self, hardness: float | None, loads: Mask, curve: Curve) -> LoadCase:
        """Some of the same loads on a body of another hardness.

        Spaced loads are those of the curve that was solved under them.
        """
        values = np.array(self.depths or self.forces or curve.force)[loads].tolist()
        forces, depths = ([], values) if self.depths else (values, [])
        others = replace(self, forces=forces, depths=depths, n_loads=None)
        return replace(others, hardness=hardness, among=loads, lifted=None)

    def spread(self, curve: _CurveType) -> _CurveType:
        """A curve under these loads over all those that they are among, lifted ones included."""
        if self.lifted is not None:
            if self.lifted.all():
                curve = replace(at_loads(curve, np.array([], int)), facts=())  # none of its own
            curve = among_loads(curve, ~self.lifted, Status.LIFTED)
        if self.among is None or self.among.all():
            return curve
        return among_loads(curve, self.among)

    def alone(self, curve: SurfaceCurve) -> SurfaceCurve:
        """A curve over all loads that these are among, under these alone; without its fields."""
        if self.among is not None:
            curve = at_loads(curve, np.flatnonzero(self.among))
        return curve if self.lifted is None else at_loads(curve, np.flatnonzero(~self.lifted))

    @property
    def sticking(self) -> ContactLaw | None:
        """The law of bodies that stick; None of others."""
        pull = self.attraction
        if pull is None or pull.range is None:
            return None
        return sticking_law(pull.law, pull.work, pull.range)

    def pressing(self) -> Pressing:
        """How a surface is pressed under those of these loads that press it."""
        assert isinstance(self.body, Surface)
        surface = self.body.detrended() if self.levelled else self.body
        forces = self.forces
        if self.lifted is not None:
            forces = np.array(forces)[~self.lifted].tolist()
        law = given_law(self.sticking, self.hardness)
        given = GivenLoads(self.depths or None, forces or None, self.n_loads)
        loads = surface_loads(surface, self.half_space, given, self.rtol, single=False, law=law)
        return Pressing(surface, self.half_space, law, loads, self.rtol, self.measures)

    def beside_lifted(self, lifted: Mask) -> LoadCase:
        """The loads that press, or a light one where there is none, as a curve has one."""
        numbers = np.flatnonzero(~lifted).tolist()
        fields = [numbers.index(load) for load in self.fields if not lifted[load]]
        light = _LIGHT_PRESSURE * self.half_space.softest * nominal_area(self.body)
        forces = [self.forces[load] for load in numbers] or [light]
        return replace(self, forces=forces, fields=fields, lifted=None)


def _lifted(question: Question, forces: Sequence[float]) -> Mask | None:
    """Under which forces a fluid lifts a body; None where it does under none."""
    if question.sealing is None or question.sealing.excess == 0:
        return None  # without a fluid, a force of zero unloads
    lifted = np.array(forces) <= 0
    return lifted if question.sealing.carries is not False and lifted.any() else None


def _spaced(question: Question, body: Surface) -> list[float]:
    """Forces for bodies that stick, those of the same ones if they only push. [N]"""
    spaced = GivenLoads(None, None, question.loading.n_loads)
    loads = surface_loads(
        body, question.half_space, spaced, 1e-6, single=False, law=yielding_law(None)
    )
    return [float(each) for each in loads.values]


def _forces_of_a_scan(line: Line, E_star: float, count: int) -> list[float]:
    """Forces for a line scan, from light contact to nearly saturated. [N]"""
    scale = E_star * line.rms_height * line.length
    return (scale * np.geomspace(1e-3, 3, count)).tolist()


def _refuse_beyond_hardness(question: Question, area: float) -> None:
    """Refuse loads under which all of a body of some nominal area [m²] would yield."""
    hardness = find_hardness(question)
    if hardness is None:
        return
    bearer = "the softer body" if question.pair is None else question.pair.bearer
    loading = question.loading
    loads = zip(loading.headings, loading.forces(area), question.pressing(area), strict=False)
    for heading, force, pressing in loads:
        if pressing >= hardness.value * area * (1 - 1e-12):  # of a joint it is rounded
            carried = force - pressing
            most = engineering((hardness.value * area + carried) * loading.scale(area), "N")
            on, joint = "the joint", ""
            if question.joint is None:
                joint = f"the area of the joint that carries them ({called('rl.Joint')}), "
                on = "the map"
            raise InputError(
                f"load {heading} is a mean pressure of {engineering(force / area, 'Pa')}, and "
                f"{bearer}, of hardness {engineering(hardness.value, 'Pa')}, bears less than "
                f"{most} on {on} (H A_0): give smaller loads, {joint}or a larger hardness "
                f"({called('hardness')}) if the body has it"
            )
