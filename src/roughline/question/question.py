"""What is asked of rough bodies: checked before any file is read."""

from __future__ import annotations

import math
from collections.abc import Callable
from pathlib import Path
from typing import TYPE_CHECKING, Literal, TypeVar

import numpy as np
from attrs import evolve, field, frozen

from roughline.contact.arguments import given_half_space
from roughline.contact.shear_loads import refuse_unknown_shear
from roughline.contact.strain import LARGEST_STRAIN, LINEARITY
from roughline.engineering.attraction import Attraction
from roughline.engineering.coated import Coated, Solid
from roughline.engineering.pair import MaterialPair
from roughline.engineering.sealing import Fluid
from roughline.errors import InputError
from roughline.errors.checks import as_number, refuse, shown
from roughline.errors.earlier import refuse_part
from roughline.errors.public import public
from roughline.errors.words import called
from roughline.facts.fact import Fact
from roughline.halfspace.elasticity.half_space import HalfSpace, Periodic
from roughline.halfspace.friction.law import Friction
from roughline.question.arguments import (
    bodies,
    given_pair,
    modulus,
    opposite,
    quantities,
    read_pair,
    refuse_unless_one_modulus,
)
from roughline.question.asked import (
    Adhesion,
    Asked,
    Joint,
    Shear,
    Theories,
    Ultrasound,
    asked,
    refuse_on_line,
    refuse_on_strip,
    refuse_uneven_friction,
    refuse_without_materials,
)
from roughline.question.kinds import WITHOUT_YIELD, has_spectrum, nominal_area
from roughline.question.loading import Loading
from roughline.question.reading import Reading
from roughline.topography.body import Body, Line, Surface
from roughline.topography.preparation import Preparation
from roughline.units import as_si

_Kind = TypeVar("_Kind")
_Value = TypeVar("_Value")


def _periodic(given: bool | Literal["x", "y"]) -> Periodic:
    """Along which axes a body is repeated, as those that are pressed are."""
    return given_half_space(None, 1.0, given).periodic


def _hardness(given: float | str | None) -> float | None:
    """A hardness, if one is given; without end, it stands for no yield. [Pa]"""
    if given is None:
        return None
    hardness = as_si(given, "Pa", "hardness")
    if not hardness > 0:
        elastic = called("elastic", True)
        refuse("hardness", given, f"a positive pressure is needed, or {elastic} for no yield")
    return hardness


def _reading(given: Reading | None) -> Reading:
    """How files are read."""
    if given is None:
        return Reading()
    if not isinstance(given, Reading):
        refuse("reading", given, "a Reading, as rl.Reading(...), is needed")
    return given


@public
@frozen
class Question:
    """What is asked of one rough body against a smooth or a rough one.

    Everything is in SI units; a quantity is a number, or a text with its unit.

    Parameters
    ----------
    body : Surface, Line, str or Path, or iterable of them
        What is pressed: a body in metres, or a file with a topography. A line scan (a Line of kind
        "profile") goes through its spectrum to the reduced model. Several are maps of one part,
        each from another place; they are pressed one by one, under the same loads.
    materials : pair of Material, Coated or str, or str, optional
        Of both bodies: materials or their descriptions, ("steel", "gold 0.5 um on copper"), or one
        text with a comma between, "steel,gold 0.5 um on copper".
    E_star : float or str, optional
        Contact modulus instead of materials; the result is then the curve without answers. [Pa]
    loads : float or str, or sequence of them, optional
        Total forces [N], or texts: forces, "10 N", or mean pressures over the nominal area,
        "2 MPa". Forces act on the body, or on the :class:`roughline.Joint`
        that is asked for.
    depths : float or str, or sequence of them, optional
        Depths since first touch instead of loads. [m]
    hardness : float or str, optional
        Hardness of the softer body, taken as exact; default: that of the materials, with its
        scatter, where it is known. Points that reach it yield and are indented permanently. [Pa]
    elastic : bool, optional
        Whether both bodies are elastic, whatever their hardness.
    n_loads : int, optional
        Number of forces from first touch to saturation; 20 if no loads and no depths are given.
    ask : what is asked beside the contact, or sequence of it, optional
        Any of :class:`roughline.Adhesion`, :class:`roughline.Friction`, :class:`roughline.Shear`,
        :class:`roughline.Ultrasound`, :class:`roughline.Joint`, :class:`roughline.Theories` and
        :class:`roughline.Fluid`.
    against : Surface, Line, str or Path, optional
        Topography of the second body, read and prepared like the first; without it, it is smooth.
    periodic : bool, "x" or "y", optional
        As for :func:`roughline.press`; along one direction alone only with `E_star`. Where bodies
        repeat both ways, their :attr:`~roughline.HalfSpace.interface` is pressed.
    grid_error : bool, optional
        Whether the grid's error is estimated; default: where that is cheap, and with a
        whole curve, on 64 points a side or more. Without it no interval is given.
    reading : Reading, optional
        How files are read.
    preparation : Preparation, optional
        Of each topography; default: the tilt of measured ones is removed.
    fields : bool, optional
        Whether the fields of one load are kept: of the largest, or, with `n_loads`, of the load at
        three quarters of their number.
    history : bool, optional
        Whether loads or depths follow each other as they are given, each on the surface as the
        one before left it; otherwise they rise.
    unload : bool, optional
        Whether the largest load is taken off again, in steps down to zero.
    whole_curve : bool, optional
        Whether further loads are solved for figures, from a thousandth of the largest one up.

    Raises
    ------
    InputError
        If the question does not fit together.
    UnitError
        If a text has no unit, or a wrong one.

    Examples
    --------
    >>> import roughline as rl
    >>> spectrum = rl.SelfAffine(hurst=0.8, length=1e-3, rms_height=1e-6, q_roll=2.5e4)
    >>> surface = spectrum.surface(64, rng=7)  # in metres
    >>> question = rl.Question(surface, E_star="100 GPa", loads=["1 MPa", "2 MPa"])
    >>> print(rl.assess(question).curve.stiffness.round(-5))
    [ 6900000. 10900000.]

    >>> pair, asked = ("steel", "copper"), [rl.Friction(0.3), rl.Ultrasound("5 MHz")]
    >>> question = rl.Question(surface, pair, loads="10 N", ask=asked)
    """

    body: Body | Path | tuple[Body | Path, ...] = field(converter=bodies)
    materials: tuple[Solid, Solid] | None = field(default=None, converter=read_pair)
    E_star: float | None = field(default=None, converter=modulus)
    loads: tuple[float | str, ...] = field(default=(), converter=quantities)
    depths: tuple[float | str, ...] = field(default=(), converter=quantities)
    n_loads: int | None = None
    ask: tuple[Asked, ...] = field(default=(), converter=asked)
    against: Body | Path | None = field(default=None, converter=opposite)
    periodic: Periodic = field(default=False, converter=_periodic)
    hardness: float | None = field(default=None, converter=_hardness)
    elastic: bool = False
    grid_error: bool | None = None
    reading: Reading = field(default=None, converter=_reading)
    preparation: Preparation | None = None
    fields: bool = True
    history: bool = field(default=False, kw_only=True)
    unload: bool = field(default=False, kw_only=True)
    whole_curve: bool = field(default=False, kw_only=True)
    loading: Loading = field(init=False, repr=False, eq=False)

    @loading.default
    def _loading(self) -> Loading:
        return Loading(
            self.loads,
            self.depths,
            self.n_loads,
            history=self.history,
            unload=self.unload,
            whole_curve=self.whole_curve,
            joint=self.joint,
        )

    def __attrs_post_init__(self) -> None:
        if self.hardness is not None and self.elastic:
            raise InputError(
                f"{called('hardness')} and {called('elastic', True)} contradict each other; give "
                "one of them",
                None,
                "hardness",
                "elastic",
            )
        if self.reading != Reading() and not any(
            isinstance(each, Path) for each in (*self.bodies, self.against)
        ):
            raise InputError(
                f"{called('reading')} says how files are read, but no file is given: leave it out"
            )
        if isinstance(self.periodic, str):
            refuse_on_strip(self.ask, self.periodic, has_materials=self.materials is not None)
        if self.materials is None:
            refuse_without_materials(self.ask)
        refuse_unless_one_modulus(self.E_star, self.materials)
        coated = self.coated if self.shear is None else []
        self._asked(Friction, lambda asked: refuse_uneven_friction(asked, coated))
        self._asked(Shear, lambda asked: asked.refuse_beside(self.ask))
        self._asked(Shear, lambda _: self.loading.refuse_unless_one_load())
        self._asked(Adhesion, lambda asked: asked.refuse_beside(self.ask, yields=self._yields))
        if self.is_of_several:
            self._refuse_maps()
        for body in (*self.bodies, self.against):
            if isinstance(body, Surface | Line):
                self.refuse_misfit(body)

    if not TYPE_CHECKING:  # checkers know what there is

        def __getattr__(self, name):
            refuse_part("question", name, "Question")

    def _asked(self, kind: type[_Kind], of: Callable[[_Kind], _Value]) -> _Value | None:
        """A value of what is asked of a kind, if it is."""
        return next((of(each) for each in self.ask if isinstance(each, kind)), None)

    @property
    def attraction(self) -> Attraction | None:
        """How the bodies attract each other; None if they only push."""
        return self._asked(Adhesion, lambda asked: asked.attraction)

    @property
    def friction(self) -> float | None:
        """Coefficient of friction that partial slip is asked for. [1]"""
        return self._asked(Friction, lambda asked: as_number(asked.coefficient))

    @property
    def shear(self) -> Shear | None:
        """The shear force that is asked for; None without."""
        return self._asked(Shear, lambda asked: asked)

    def shear_on(self, area: float) -> float:
        """Shear force on a body of a nominal area [m²]; of a joint, its share of it. [N]"""
        scale = self.loading.scale(area)
        force = self._asked(Shear, lambda asked: asked.newtons(area * scale))
        return 0.0 if force is None else force / scale

    @property
    def frequency_in_hertz(self) -> float | None:
        """Frequency that a reflection is asked for. [Hz]"""
        return self._asked(Ultrasound, lambda asked: asked.frequency)

    @property
    def fluid(self) -> Fluid | None:
        """What is asked of the gap: what flows through, and where it closes."""
        return self._asked(Fluid, lambda asked: asked)

    @property
    def sealing(self) -> Fluid | None:
        """What is asked of the flow of a named fluid; None if none flows."""
        return None if self.fluid is None or self.fluid.fluid is None else self.fluid

    @property
    def gap_assembly(self) -> tuple[float | None, Literal["joint", "seal"]]:
        """Nominal area of what the gap belongs to [m²], the seal or else the joint, and which."""
        seal = None if self.fluid is None else self.fluid.seal
        return (self.joint, "joint") if seal is None else (seal.area, "seal")

    @property
    def joint(self) -> float | None:
        """Nominal area of the joint; None if loads act on the body. [m²]"""
        return self._asked(Joint, lambda asked: asked.area)

    @property
    def theories(self) -> tuple[str, ...]:
        """Names of the theories that are asked."""
        return self._asked(Theories, lambda asked: asked.names) or ()

    @property
    def is_of_several(self) -> bool:
        """Whether it is asked of a list of maps of one part, be it a single one."""
        return isinstance(self.body, tuple)

    @property
    def bodies(self) -> tuple[Body | Path, ...]:
        """The body, or all maps of the part."""
        return self.body if isinstance(self.body, tuple) else (self.body,)

    def one_by_one(self) -> list[Question]:
        """Ask the question of each body alone."""
        return [evolve(self, body=body) for body in self.bodies]

    @property
    def pair(self) -> MaterialPair | None:
        """Both materials, with the hardness that is given; None without materials."""
        return given_pair(self.materials, self.hardness)

    @property
    def half_space(self) -> HalfSpace:
        """What both bodies are pressed as; where they are repeated, the interface alone."""
        pair, along = self.pair, self.repeated_along
        if pair is None:
            return given_half_space(None, self.E_star, along)
        return pair.half_space().interface if along is True else pair.half_space(periodic=along)

    @property
    def sheared_half_space(self) -> HalfSpace | None:
        """What both bodies are sheared as; None without materials."""
        pair = self.pair
        return None if pair is None else pair.sheared_half_space(periodic=self.repeated_along)

    @property
    def modulus(self) -> float:
        """Contact modulus, given or of what lies at both surfaces. [Pa]"""
        pair = self.pair
        return self.E_star or math.nan if pair is None else pair.E_star

    @property
    def coated(self) -> list[Coated]:
        """The bodies that are coated."""
        return [] if self.pair is None else self.pair.coated

    @property
    def name(self) -> str:
        """What the first body is called: its file's name, or what it is."""
        if self.is_of_several:
            count = len(self.bodies)
            return f"{count} maps" if count > 1 else "a single map"
        if isinstance(self.body, Path):
            return self.reading.name or self.body.name
        return "a surface" if isinstance(self.body, Surface) else "a line"

    @property
    def repeated_along(self) -> bool | Literal["x", "y"]:
        """Along which axes what is pressed is repeated: as asked, or all, as a joint goes on."""
        return self.periodic if self.joint is None else True

    @property
    def is_repeated(self) -> bool:
        """Whether what is pressed is repeated along both axes."""
        return self.repeated_along is True

    @property
    def _yields(self) -> bool:
        """Whether the softer body has a hardness."""
        pair = self.pair
        hardness = self.hardness if pair is None or self.hardness is not None else pair.hardness
        return hardness is not None and hardness < math.inf and not self.elastic

    def strains(self, body: Body) -> list[tuple[float, Fact]]:
        """Return how far each load strains a body: as a ratio, and the fact."""
        pressing = self.pressing(nominal_area(body))
        return self.loading.strains(body, self.half_space, pressing, is_layered=bool(self.coated))

    def pressing(self, area: float) -> list[float]:
        """Forces with which a body presses, in the order of the loads: less what a fluid carries.

        Where they are not positive, the fluid lifts the body. [N]
        """
        forces, fluid = self.loading.forces(area), self.sealing
        if fluid is None:
            return forces
        left: list[float] = fluid.force_on_bodies(np.array(forces), area).tolist()
        return left

    def refuse_misfit(self, body: Body) -> None:
        """Refuse what does not suit the kind of a body, or its size."""
        if isinstance(body, Line):
            self._refuse_line(body)
        else:
            self._asked(Joint, lambda asked: asked.refuse_map(body.area))
            self._asked(Shear, lambda asked: self._refuse_sliding(asked, body))
            if self.attraction is not None:
                self.attraction.refuse_too_strong(min(body.sizes), self.modulus)
        for ratio, fact in self.strains(body):
            if ratio > LARGEST_STRAIN:
                text = f"{fact}, and {LINEARITY}: give a smaller one, and check its unit"
                raise InputError(text, None, "loads")
        if self.theories and not has_spectrum(body):
            raise InputError(
                "theories are evaluated for a rough surface of 8 x 8 points or more, whose pixels "
                "are nearly square"
            )

    def _refuse_sliding(self, shear: Shear, body: Surface) -> None:
        """Refuse a shear force beyond what friction bears, and what is not solved with friction."""
        area, friction = body.area, self.friction
        (pressing,) = self.pressing(area)
        if friction is None or self.sheared_half_space is None:
            return
        scale = self.loading.scale(area)
        shear.refuse_beyond(self.shear_on(area) * scale, pressing * scale, friction)
        refuse_unknown_shear(self.sheared_half_space)

    def _refuse_line(self, line: Line) -> None:
        """Refuse what belongs to a surface."""
        for each in self.coated:
            raise InputError(
                f"{shown(each.name)} is coated, and the springs of a line have one modulus: give a "
                "body of one material, or press a map",
                "materials",
            )
        if line.kind == "profile" and (self.periodic or self.grid_error or self.depths):
            raise InputError(
                "periodic, grid_error and depths belong to a surface; a line scan is pressed by "
                "loads, through its spectrum: leave them out, or press a map"
            )
        given = {
            called("hardness"): self.hardness is not None,
            called("history", True): self.history,
            called("unload", True): self.unload,
        }
        if any(given.values()):
            came = " and ".join(name for name, is_given in given.items() if is_given)
            raise InputError(
                "hardness, history and unload belong to a surface; the reduced model of a line "
                f"{WITHOUT_YIELD} (rms slopes below 0.8 H / E*): leave {came} out, or press a map"
            )
        refuse_on_line(self.ask)

    def _refuse_maps(self) -> None:
        """Refuse several maps without what they are compared by."""
        if self.materials is None:
            raise InputError(
                "several maps are compared by their answers, which need two materials "
                f"({called('materials')})"
            )
        if not self.loads and not self.depths:
            raise InputError(
                f"several maps are pressed under the same loads: give them ({called('loads')})"
            )
        if self.against is not None:
            against = called("against")
            raise InputError(
                f"several maps are pressed into a smooth body: the one second topography "
                f"({against}) would be the same for all maps, and its own scatter between places "
                f"would not show; press each map against it alone, or leave {against} out"
            )
        if self.reading.name is not None:
            raise InputError(
                f"the name in {called('reading')} is that of one file, and there are several maps: "
                "leave it out"
            )
