"""What is asked of one rough body, or of two: checked before any file is read."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any

import numpy as np

from roughline.engineering.materials import Material, material
from roughline.engineering.pair import MaterialPair
from roughline.errors import InputError
from roughline.files.scale import Sizes
from roughline.topography.body import Body, Line, Surface
from roughline.topography.missing import Filling, Missing
from roughline.topography.preparation import Preparation
from roughline.units import engineering, in_si, load_in_newtons, refuse_decimal_comma

DEFAULT_LOADS = 20


@dataclass(frozen=True)
class Reading:
    """How a file is read.

    Parameters
    ----------
    unit, channel, sizes, missing, most_missing
        As for :func:`roughline.read`.
    name : str, optional
        What the first file is called in messages and results; default: its own name.
    """

    unit: str | None = None
    channel: int | str | None = None
    sizes: Sizes | None = None
    missing: Filling = "harmonic"
    most_missing: float = 0.1
    name: str | None = None

    def __post_init__(self) -> None:
        Missing(self.missing, self.most_missing)  # refuses what cannot be


@dataclass(frozen=True)
class Question:
    """What is asked of one rough body against a smooth or a rough one.

    Everything is in SI units; a quantity is a number, or a text with its unit.

    Parameters
    ----------
    body : Surface, Line, str or Path
        What is pressed: a body in metres, or a file with a topography. A line scan (a Line of kind
        "profile") goes through its spectrum to the reduced model.
    materials : pair of Material or str, or str, optional
        Of both bodies: materials or their descriptions, ("steel", "copper"), or one text with a
        comma between, "steel,copper".
    E_star : float or str, optional
        Contact modulus instead of materials; then no answers follow from the curve. [Pa]
    loads : float or str, or sequence of them, optional
        Total forces [N], or texts: forces, "10 N", or mean pressures over the nominal area,
        "2 MPa".
    depths : float or str, or sequence of them, optional
        Depths since first touch instead of loads. [m]
    n_loads : int, optional
        Or so many forces from first touch to saturation; 20 if there is neither of the three.
    against : Surface, Line, str or Path, optional
        Topography of the second body, read and prepared like the first; without it, it is smooth.
    periodic : bool, optional
        As for :func:`roughline.press`.
    friction : float, optional
        Coefficient of friction; adds partial slip at the largest load. [1]
    frequency : float or str, optional
        Of an ultrasonic wave; adds its reflection. [Hz]
    theories : str or sequence of str, optional
        As for :func:`roughline.theory`.
    grid_error : bool, optional
        Whether the grid's error is estimated; default: where that is cheap, and with a whole curve.
        Without it no interval is given.
    reading : Reading, optional
        How files are read.
    preparation : Preparation, optional
        Of each topography; default: the tilt of measured ones is removed.
    whole_curve : bool, optional
        Whether loads from a thousandth of the largest one on are solved too, for figures.
    fields : bool, optional
        Whether the fields of one load are kept: of the largest, or, where loads are spaced, of one
        at three quarters of them.

    Raises
    ------
    InputError
        If the question does not fit together.
    UnitError
        If a text has no unit, or a wrong one.
    """

    body: Body | str | Path
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
    reading: Reading = Reading()
    preparation: Preparation | None = None
    whole_curve: bool = False
    fields: bool = True

    def __post_init__(self) -> None:
        checked = {
            "body": _body_or_path(self.body, "body"),
            "against": None if self.against is None else _body_or_path(self.against, "against"),
            "loads": _several(self.loads),
            "depths": _several(self.depths),
            "theories": _several(self.theories),
        }
        for name, value in checked.items():
            object.__setattr__(self, name, value)
        if self.reading != Reading() and not any(
            isinstance(each, Path) for each in (self.body, self.against)
        ):
            raise InputError("reading= says how files are read, and none is given: leave it out")
        self._check_loads()
        self._check_materials()
        if self.theories:
            from roughline.theories.theory import refuse_unknown  # here because it loads slowly

            for theory in self.theories:
                refuse_unknown(theory)
        for body in (self.body, self.against):
            if isinstance(body, Surface | Line):
                self.refuse_misfit(body)

    @property
    def pair(self) -> MaterialPair | None:
        """Both materials; None if a contact modulus is given instead."""
        return None if self.materials is None else MaterialPair(*self.materials)

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
        if isinstance(self.body, Path):
            return self.reading.name or self.body.name
        return "a surface" if isinstance(self.body, Surface) else "a line"

    @property
    def headings(self) -> list[str]:
        """What each load or depth is called, in its order: as it was typed, or with its unit."""
        named = [(each, "N") for each in _several(self.loads)]
        named += [(each, "m") for each in _several(self.depths)]
        return [each if isinstance(each, str) else engineering(each, unit) for each, unit in named]

    def forces(self, area: float) -> list[float]:
        """Total forces on a nominal area, in the order of the loads. [N]"""
        forces = [
            load_in_newtons(load, area) if isinstance(load, str) else float(load)
            for load in _several(self.loads)
        ]
        for load, force in zip(_several(self.loads), forces, strict=True):
            if not 0 < force < math.inf:
                raise InputError(f'load is "{load}"; give positive ones')
        return forces

    def heights(self) -> list[float]:
        """Depths, in their order. [m]"""
        return [_in_si(depth, "m", "depth") for depth in _several(self.depths)]

    def refuse_misfit(self, body: Body) -> None:
        """Refuse what does not suit the kind of a body.

        Raises
        ------
        InputError
            If something that belongs to a surface is asked of a line scan, or theories of a body
            that has no spectrum.
        """
        is_scan = isinstance(body, Line) and body.kind == "profile"
        if is_scan and (self.periodic or self.grid_error or self.depths):
            raise InputError(
                "periodic, grid_error and depths belong to a surface; a line scan is pressed by "
                "loads, through its spectrum"
            )
        if self.theories and not has_spectrum(body):
            raise InputError("theories are evaluated for a rough surface of 8 x 8 points or more")

    def _check_loads(self) -> None:
        given = (self.n_loads, self.loads or None, self.depths or None)
        if all(each is None for each in given):
            object.__setattr__(self, "n_loads", DEFAULT_LOADS)
        if sum(each is not None for each in given) > 1:
            raise InputError("give one of loads=, depths= and n_loads=")
        if self.n_loads is not None and (
            not isinstance(self.n_loads, int | np.integer)
            or isinstance(self.n_loads, bool)
            or self.n_loads < 2
        ):
            raise InputError(f"n_loads is {self.n_loads!r}; a whole number of at least 2 is needed")
        self.forces(1.0)  # reads and checks them; a pressure waits for its area
        self.heights()

    def _check_materials(self) -> None:
        if self.materials is not None:
            object.__setattr__(self, "materials", _pair(self.materials))
        elif self.frequency is not None or self.friction is not None:
            raise InputError("reflection and partial slip need two materials (materials=)")
        if (self.E_star is None) == (self.materials is None):
            raise InputError(
                "give either a contact modulus (E_star=) or two materials (materials=)"
            )
        if self.E_star is not None:
            object.__setattr__(self, "E_star", _in_si(self.E_star, "Pa", "modulus"))
        if not 0 < self.modulus < math.inf:  # two rigid bodies are refused by the modulus itself
            raise InputError(
                f"E_star is {self.modulus!r}; a positive, finite contact modulus is needed"
            )
        if self.frequency is not None:
            hertz = _in_si(self.frequency, "Hz", "frequency")
            if not 0 < hertz < math.inf:
                raise InputError(f'frequency is "{self.frequency}"; a positive one is needed')
            object.__setattr__(self, "frequency", hertz)
        if self.friction is not None and not 0 < self.friction < math.inf:
            raise InputError(
                f"the coefficient of friction is {self.friction}; a positive one is needed"
            )


def nominal_area(body: Body) -> float:
    """Nominal area of a body; of a line, the square of its length. [m²]"""
    return body.area if isinstance(body, Surface) else body.length**2


def has_spectrum(body: Body) -> bool:
    """Whether it is a surface with enough points and some roughness."""
    return isinstance(body, Surface) and min(body.shape) >= 8 and body.rms_height > 0


def _several(given: Any) -> tuple[Any, ...]:
    """One value or several as a tuple."""
    return (given,) if np.ndim(given) == 0 else tuple(given)


def _in_si(given: float | str, unit: str, name: str) -> float:
    """A number in an SI unit, or a text with a unit of its own, as a number in the SI unit."""
    return in_si(given, unit, name) if isinstance(given, str) else float(given)


def _body_or_path(given: Any, name: str) -> Body | Path:
    """A body in metres, or the path of a file."""
    if isinstance(given, str | Path):
        return Path(given)
    if not isinstance(given, Surface | Line):
        raise InputError(
            f"{name} is a {type(given).__name__}; give a Surface or a Line in metres, or a file"
        )
    if given.unit not in (None, "m"):
        raise InputError(f'{name} is in "{given.unit}"; give it in metres, as rl.read does')
    return replace(given, unit="m")


def _pair(given: Any) -> tuple[Material, Material]:
    """Two materials, from themselves, their descriptions, or one text with a comma between."""
    parts = given
    if isinstance(given, str):
        refuse_decimal_comma(given, "materials")
        parts = [part.strip() for part in given.split(",")]
    if len(parts) != 2:
        raise InputError(
            f'materials is "{given}"; give two with a comma between, such as "steel,copper", or '
            '"steel,rigid"'
        )
    first, second = (each if isinstance(each, Material) else material(each) for each in parts)
    return first, second
