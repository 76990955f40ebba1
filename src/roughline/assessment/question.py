"""What is asked of rough bodies: checked before any file is read."""

from __future__ import annotations

import math
from collections.abc import Iterable, Sequence
from dataclasses import dataclass, field, replace
from pathlib import Path
from typing import Any

from roughline.assessment.consistency import (
    refuse_inconsistent_joint,
    refuse_inconsistent_loads,
    refuse_inconsistent_maps,
)
from roughline.assessment.given import (
    as_si,
    bodies_or_paths,
    body_or_path,
    checked_friction,
    pair_of,
    several,
)
from roughline.assessment.hardness import checked_hardness
from roughline.assessment.misfit import refuse_misfit
from roughline.assessment.nominal import area_of_joint
from roughline.assessment.reading import Reading
from roughline.engineering.pair import MaterialPair, contact_modulus
from roughline.errors import InputError
from roughline.errors.checks import number, refuse
from roughline.errors.public import public
from roughline.errors.words import called
from roughline.topography.body import Body, Line, Surface
from roughline.topography.preparation import Preparation
from roughline.units import engineering, load_in_newtons

DEFAULT_LOADS = 20

UNLOADING = (0.75, 0.5, 0.25, 0.1, 0.0)
"""Loads over the largest one, on the way back to none."""


@public
@dataclass(frozen=True)
class Question:
    """What is asked of one rough body against a smooth or a rough one.

    Everything is in SI units; a quantity is a number, or a text with its unit.

    Parameters
    ----------
    body : Surface, Line, str or Path, or iterable of them
        What is pressed: a body in metres, or a file with a topography. A line scan (a Line of kind
        "profile") goes through its spectrum to the reduced model. Several are maps of one part,
        each from another place; they are pressed one by one, under the same loads.
    materials : pair of Material or str, or str, optional
        Of both bodies: materials or their descriptions, ("steel", "copper"), or one text with a
        comma between, "steel,copper".
    E_star : float or str, optional
        Contact modulus instead of materials; the result is then the curve without answers. [Pa]
    loads : float or str, or sequence of them, optional
        Total forces [N], or texts: forces, "10 N", or mean pressures over the nominal area,
        "2 MPa". Forces act on the body, or on the joint whose area is given.
    joint_area : float or str, optional
        Nominal area of the joint that a surface is a map of, such as "2 cm^2", not below that of
        the map. The map is pressed at the joint's mean pressure, and answers are the joint's. [m²]
    depths : float or str, or sequence of them, optional
        Depths since first touch instead of loads. [m]
    hardness : float or str, optional
        Hardness of the softer body, taken as exact; default: that of the materials, with its
        scatter, where it is known. Points that reach it yield and are indented permanently. [Pa]
    elastic : bool, optional
        Whether both bodies are elastic, whatever their hardness.
    history : bool, optional
        Whether loads or depths are applied in the order given, each to the surface as the last one
        left it; default: in rising order.
    unload : bool, optional
        Whether the largest load is taken off again, in steps down to zero.
    n_loads : int, optional
        Number of forces from first touch to saturation; 20 if no loads and no depths are given.
    against : Surface, Line, str or Path, optional
        Topography of the second body, read and prepared like the first; without it, it is smooth.
    periodic : bool, optional
        As for :func:`roughline.press`.
    friction : float, optional
        Coefficient of friction, above 0 and up to 5; adds partial slip at the largest load. [1]
    frequency : float or str, optional
        Of an ultrasonic wave; adds its reflection. [Hz]
    theories : str or sequence of str, optional
        As for :func:`roughline.theory`.
    grid_error : bool, optional
        Whether the grid's error is estimated; default: where that is cheap, and with `whole_curve`,
        on 64 points a side or more. Without it no interval is given.
    reading : Reading, optional
        How files are read.
    preparation : Preparation, optional
        Of each topography; default: the tilt of measured ones is removed.
    whole_curve : bool, optional
        Whether further loads, from a thousandth of the largest one up, are solved too, for figures.
    fields : bool, optional
        Whether the fields of one load are kept: of the largest, or, with `n_loads`, of the load at
        three quarters of their number.

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
    """

    body: Body | str | Path | Iterable[Body | str | Path]
    materials: Any = None
    E_star: float | str | None = None
    loads: float | str | Sequence[float | str] = ()
    depths: float | str | Sequence[float | str] = ()
    n_loads: int | None = None
    against: Body | str | Path | None = None
    periodic: bool = False
    friction: float | None = None
    frequency: float | str | None = None
    theories: str | Sequence[str] = ()
    grid_error: bool | None = None
    reading: Reading = field(default_factory=Reading)
    preparation: Preparation | None = None
    whole_curve: bool = False
    fields: bool = True
    joint_area: float | str | None = None
    hardness: float | str | None = None
    elastic: bool = False
    history: bool = False
    unload: bool = False

    def __post_init__(self) -> None:
        checked = {
            "body": bodies_or_paths(self.body, "body"),
            "against": None if self.against is None else body_or_path(self.against, "against"),
            "loads": several(self.loads),
            "depths": several(self.depths),
            "theories": several(self.theories),
            "hardness": checked_hardness(self.hardness, elastic=self.elastic),
        }
        for name, value in checked.items():
            object.__setattr__(self, name, value)
        if self.reading != Reading() and not any(
            isinstance(each, Path) for each in (*self.bodies, self.against)
        ):
            raise InputError(
                f"{called('reading')} says how files are read, but no file is given: leave it out"
            )
        if self.joint_area is not None:
            object.__setattr__(self, "joint_area", area_of_joint(self.joint_area))
        if self.n_loads is None and not self.loads and not self.depths:
            object.__setattr__(self, "n_loads", DEFAULT_LOADS)
        refuse_inconsistent_joint(self)
        refuse_inconsistent_loads(self)
        self.forces(1.0)  # reads and checks them; a pressure waits for its area
        self.heights()
        self._check_materials()
        refuse_inconsistent_maps(self)
        if self.theories:
            from roughline.theories.theory import refuse_unknown  # here because it loads slowly

            for theory in self.theories:
                refuse_unknown(theory, "theories")
        for body in (*self.bodies, self.against):
            if isinstance(body, Surface | Line):
                refuse_misfit(self, body)

    @property
    def is_of_several(self) -> bool:
        """Whether it was asked of a number of maps of one part, be it a single one."""
        return isinstance(self.body, tuple)

    @property
    def bodies(self) -> tuple[Body | Path, ...]:
        """The body, or all maps of the part."""
        return self.body if isinstance(self.body, tuple) else (self.body,)

    def of_each(self) -> list[Question]:
        """The same question of each body alone."""
        return [replace(self, body=body) for body in self.bodies]

    @property
    def pair(self) -> MaterialPair | None:
        """Both materials, with the hardness that is given; None without materials."""
        if self.materials is None:
            return None
        pair = MaterialPair(*self.materials)
        if self.hardness is None or self.hardness == math.inf:
            return pair
        assert not isinstance(self.hardness, str)
        return pair.with_hardness(self.hardness)

    @property
    def modulus(self) -> float:
        """Contact modulus, given or of the materials. [Pa]"""
        pair = self.pair
        if pair is not None:
            return pair.E_star
        assert isinstance(self.E_star, float)
        return self.E_star

    @property
    def frequency_in_hertz(self) -> float | None:
        """The frequency as a number. [Hz]"""
        assert not isinstance(self.frequency, str)
        return self.frequency

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
    def headings(self) -> list[str]:
        """What each load or depth is called, in its order: as it was typed, or with its unit."""
        named = [(each, "N") for each in several(self.loads)]
        named += [(each, "m") for each in several(self.depths)]
        headings = [
            each if isinstance(each, str) else engineering(each, unit) for each, unit in named
        ]
        return headings + [
            f"unloaded to {share:.0%}" if share else "unloaded" for share in self._unloading
        ]

    @property
    def _unloading(self) -> tuple[float, ...]:
        """Loads that follow the largest one, over it."""
        return UNLOADING if self.unload else ()

    @property
    def joint(self) -> float | None:
        """Nominal area of the joint as a number; None if loads act on the body. [m²]"""
        assert not isinstance(self.joint_area, str)
        return self.joint_area

    @property
    def is_repeated(self) -> bool:
        """Whether what is pressed is repeated: as asked, and because a joint goes on beyond it."""
        return self.periodic or self.joint_area is not None

    def scale(self, area: float) -> float:
        """How many times larger the joint is than a body of a nominal area [m²]; 1 without one."""
        return 1.0 if self.joint is None else self.joint / area

    def forces(self, area: float) -> list[float]:
        """Total forces on a body of a nominal area, in the order of the loads. [N]

        Of a joint the body carries as much as its share of the area.
        """
        scale = self.scale(area)
        forces = [
            load_in_newtons(load, area * scale)
            if isinstance(load, str)
            else number("loads", load, 'a force in N, or a text such as "2 MPa", is needed')
            for load in several(self.loads)
        ]
        for i, (load, force) in enumerate(zip(several(self.loads), forces, strict=True)):
            if not (0 < force < math.inf or (force == 0 and self.history and i)):
                to_unload = ", and zero only to unload after others" if self.history else ""
                refuse("loads", load, f"give positive ones{to_unload}")
        forces += [share * max(forces) for share in self._unloading]
        return [force / scale for force in forces]

    def heights(self) -> list[float]:
        """Depths, in their order. [m]"""
        return [as_si(depth, "m", "depths") for depth in several(self.depths)]

    def _check_materials(self) -> None:
        if self.materials is not None:
            object.__setattr__(self, "materials", pair_of(self.materials))
            contact_modulus(*self.materials)  # refuses two rigid bodies
        elif self.frequency is not None or self.friction is not None:
            raise InputError(
                f"reflection and partial slip need two materials ({called('materials')})"
            )
        if (self.E_star is None) == (self.materials is None):
            raise InputError(
                f"give either a contact modulus ({called('E_star')}) or two materials "
                f"({called('materials')})"
            )
        if self.E_star is not None:
            modulus = as_si(self.E_star, "Pa", "E_star")
            if not 0 < modulus < math.inf:
                refuse("E_star", self.E_star, "a positive, finite contact modulus is needed")
            object.__setattr__(self, "E_star", modulus)
        if self.frequency is not None:
            hertz = as_si(self.frequency, "Hz", "frequency")
            if not 0 < hertz < math.inf:
                refuse("frequency", self.frequency, "a positive, finite one is needed")
            object.__setattr__(self, "frequency", hertz)
        if self.friction is not None:
            object.__setattr__(self, "friction", checked_friction(self.friction))
