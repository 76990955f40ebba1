"""The state of the view "Explore": what is generated, and how it is pressed, read and checked."""

from __future__ import annotations

import math
from collections.abc import Iterable, Mapping
from dataclasses import dataclass, field, replace
from functools import lru_cache
from typing import Any, ClassVar, Literal, Self

import numpy as np
from numpy.typing import NDArray

import roughline as rl
from roughline.errors.checks import shown
from roughline.halfspace.laws.bounds import Bounds
from roughline.lab.controls import (
    VERSION,
    ControlError,
    Number,
    Texts,
    as_code,
    has_unit,
    is_number,
)
from roughline.lab.declared import section
from roughline.lab.explore.controls import CONTROLS, DECLARED
from roughline.lab.maps import Map
from roughline.lab.panels import Panel, PanelContent, Series
from roughline.lab.server.tasks import Progress
from roughline.units import in_si

SURFACE_KEYS = ("D_f", "roll_off", "cutoff", "rms", "h", "slope", "seed", "n")
"""Keys of the controls that make the surface."""

CURVE_POINTS = 256
"""Points along a side of the surface whose whole curve is computed."""
_COARSE_POINTS = 128  # of what is first followed on fewer
_LARGEST_FORCE_SHARE = 0.9  # of the force that all of the area bears, where curves end

FilledPanels = dict[str, PanelContent]
"""What panels show, by their keys."""
StripWords = Iterable[dict[str, str]]
"""Numbers of the answer strip in words."""
PageAnswer = tuple[dict[str, Any], Mapping[str, Map]]
"""What a task tells the page, and maps."""


@dataclass(frozen=True)
class StripFigure:
    """A number of the answer strip, as it is declared."""

    key: str
    symbol: str
    meaning: str
    after: str = ""  # key of that which it follows

    def in_words(self, value: str, below: str = "", more: str = "") -> dict[str, str]:
        """It in words, what stands below, and what more it means."""
        words = {"key": self.key, "symbol": self.symbol, "value": value}
        return words | {"below": below, "meaning": self.meaning + more}


FIGURES = {
    key: StripFigure(key, symbol, each.meaning, *after)
    for key, each in section(__package__, "strip").items()
    for symbol, *after in [each.parts]
}
"""All numbers of the strip, by their keys."""


def figures(*keys: str) -> tuple[StripFigure, ...]:
    """Some numbers of the strip."""
    return tuple(FIGURES[key] for key in keys)


@dataclass(frozen=True)
class AddedCode:
    """What a physics adds to the code of a state."""

    half_space: str = ""  # lines of Python that make it, in the place of the usual one
    before: str = ""  # lines before the press
    arguments: str = ""  # of the press, in the place of its force
    after: str = ""  # lines after it
    materials: str = ""  # both bodies as the command calls them, in the place of the modulus
    command: tuple[str, ...] = ()  # more arguments of `roughline press`
    left_out: str = ""  # what the command leaves out


class Physics:
    """What may be added to the contact of bodies that are elastic, dry and of one material.

    A kind derives from this class as a frozen dataclass, whose fields are the numbers of its
    controls by their keys, and is known to the lab by its place in `physics.PHYSICS`. What it does
    not say stays as it is.
    """

    key: ClassVar[str]  # that is set in the address where it is added
    tick: ClassVar[str]  # what stands beside its tick
    meaning: ClassVar[str]
    word: ClassVar[str] = ""  # that the key is set to, if no number is
    controls: ClassVar[tuple[Number, ...]] = ()
    unlike: ClassVar[str] = ""  # what the reduced model is without it
    excludes: ClassVar[Mapping[str, str]] = {}  # why it does not go with others, by their keys
    maps: ClassVar[Mapping[str, str]] = {}  # those it adds, with the words that choose them
    opens: ClassVar[str] = ""  # the map that is shown when it is added
    strip: ClassVar[tuple[StripFigure, ...]] = ()  # its numbers
    panels: ClassVar[tuple[Panel, ...]] = ()
    series: ClassVar[Mapping[str, tuple[Series, ...]]] = {}  # that it adds to other panels
    follows: ClassVar[Literal["", "surface", "load"]] = ""  # with which its task is asked anew

    @classmethod
    def read(cls, texts: Texts, state: ExploreState) -> Self | None:
        """Return what texts say of it, over the scales of a state; None if it is not added."""
        set_to = texts.get(cls.key, "").strip()
        if not set_to:
            return None
        if cls.word and set_to != cls.word:
            sentence = f"{cls.tick} is {shown(set_to)}; allowed is {cls.word}, or nothing"
            raise ControlError(sentence, cls.key)
        return cls(**{each.key: each.read_in(texts, state) for each in cls.controls})

    def in_si(self, key: str, state: ExploreState) -> float:
        """A number of its own, times what it is over. [SI]"""
        return float(getattr(self, key) * DECLARED[key].state_scale(state))

    @property
    def numbers(self) -> dict[str, float]:
        """Its numbers by the keys of their controls."""
        return {control.key: getattr(self, control.key) for control in self.controls}

    def check(self, state: ExploreState) -> None:
        """Refuse what the state that it is added to cannot have, at a control."""

    def law(self, state: ExploreState) -> rl.ContactLaw | None:
        """What pressures and gaps obey, if it is another than that of bodies that only push."""

    def half_space(self, state: ExploreState) -> rl.HalfSpace | None:
        """What the surface is pressed into, if it is of more than one material."""

    def is_resolved(self, state: ExploreState, n: int) -> bool:
        """Whether so many points along a side resolve it."""
        return True

    def measures(self) -> tuple[rl.Measure, ...]:
        """What is measured of every load."""
        return ()

    def over_force(self, pressed: rl.SurfaceCurve) -> dict[str, NDArray[Any]]:
        """What its panels show of loads, by their keys."""
        return {}

    def beside_curve(self, pressed: rl.SurfaceCurve, state: ExploreState) -> FilledPanels:
        """What it adds to panels of the curve, by their keys."""
        return {}

    def words(self, pressed: rl.SurfaceCurve, fields: rl.Fields, state: ExploreState) -> StripWords:
        """Its numbers of the answer strip at the load."""
        return ()

    def added_maps(self, fields: rl.Fields, state: ExploreState) -> dict[str, Map]:
        """Its maps, also those in the place of others."""
        return {}

    def saved_fields(self, fields: rl.Fields) -> dict[str, tuple[NDArray[Any], str, str]]:
        """Fields of its own that are saved: values, unit and meaning, by their names."""
        return {}

    def further(self, state: ExploreState, refines: bool, progress: Progress) -> PageAnswer:
        """Answer its task: what comes later than the contact."""
        return {}, {}

    def code(self, state: ExploreState) -> AddedCode:
        """What it adds to the code of a state."""
        return AddedCode()


@dataclass(frozen=True)
class ExploreState:
    """What is generated and pressed, by the keys of the controls, which say what each means.

    Lengths are in sides of the surface.
    """

    D_f: float = CONTROLS["D_f"].usual
    roll_off: float = CONTROLS["roll_off"].usual
    cutoff: float = CONTROLS["cutoff"].usual
    rms: str = CONTROLS["rms"].usual
    h: float = CONTROLS["h"].usual
    slope: float = CONTROLS["slope"].usual
    seed: int = CONTROLS["seed"].usual
    n: int = CONTROLS["n"].usual
    boundary: str = CONTROLS["boundary"].usual
    F: float = CONTROLS["F"].usual
    shown: str = CONTROLS["shown"].usual
    L: str = CONTROLS["L"].usual  # side of the surface
    E: str = CONTROLS["E"].usual  # contact modulus
    theories: tuple[str, ...] = CONTROLS["theories"].usual  # drawn beside the curve
    added: tuple[Physics, ...] = ()
    typed_texts: Mapping[str, str] = field(default_factory=dict, compare=False)  # texts of controls

    @property
    def length(self) -> float:
        """Side of the surface. [m]"""
        return in_si(self.L, "m", "side of the surface")

    @property
    def E_star(self) -> float:
        """Contact modulus. [Pa]"""
        return in_si(self.E, "Pa", "contact modulus")

    @property
    def periodic(self) -> bool:
        """Whether the surface is repeated."""
        return self.boundary == "periodic"

    @property
    def shortest(self) -> float:
        """Shortest wave that the grid carries, two spacings, in sides of the surface. [1]"""
        return 2 / self.n

    @property
    def cutoff_used(self) -> float:
        """Shortest wave of the surface, in its sides: the cutoff, or what the grid carries. [1]"""
        return max(self.cutoff, self.shortest)

    def spectrum(self, n: int) -> rl.SelfAffine:
        """The spectrum, with the waves that n points carry. [m]"""
        return self._spectrum(n, self.rms_height)

    def surface(self, n: int) -> rl.Surface:
        """The surface on n points along a side. [m]"""
        return _surface(self.spectrum(n), n, self.seed)

    @property
    def surface_of_curves(self) -> rl.Surface:
        """The surface whose whole curve is computed. [m]"""
        return self.surface(self.points(CURVE_POINTS))

    @property
    def rms_height(self) -> float:
        """Rms height, given or from the rms slope on the grid. [m]"""
        if self.rms == "height":
            return self.h * self.length
        return self.slope / _surface(self._spectrum(self.n, 1.0), self.n, self.seed).rms_slope

    @property
    def rms_slope(self) -> float:
        """Rms slope on the grid. [1]"""
        return self.slope if self.rms == "slope" else self.surface(self.n).rms_slope

    @property
    def law(self) -> rl.ContactLaw | None:
        """What pressures and gaps obey; None if the bodies only push."""
        return next(filter(None, (each.law(self) for each in self.added)), None)

    @property
    def yields(self) -> bool:
        """Whether loads leave dents."""
        return self.law is not None and self.law.memory == "dents"

    @property
    def half_space(self) -> rl.HalfSpace:
        """What the surface is pressed into."""
        layered = next(filter(None, (each.half_space(self) for each in self.added)), None)
        return layered or rl.Homogeneous(self.E_star, periodic=self.periodic)

    def press(
        self, surface: rl.Surface, progress: Progress, force_bar: Any = None, **others: Any
    ) -> rl.SurfaceCurve:
        """Press a surface of the state under dimensionless forces, or under what others say."""
        if force_bar is not None:
            others["forces"] = self.force(np.asarray(force_bar))
        pressed = {"half_space": self.half_space, "law": self.law, **others}
        return rl.press(surface, **pressed, throw=False, progress=progress)

    def typed(self, key: str) -> str:
        """A text with a unit as it was typed, if it counts; else none."""
        text = self.typed_texts.get(key, "").strip()
        counts = {"h": self.rms == "height", "cutoff": self.cutoff == self.cutoff_used}
        return text if has_unit(text) and counts.get(key, True) else ""

    def in_python(self, key: str, unit: str, otherwise: str) -> str:
        """A quantity in Python, as it was typed if it had a unit."""
        text = self.typed(key)
        return f"in_si({text!r}, {unit!r}, {key!r})" if text else otherwise

    def in_words(self, key: str, unit: str, value: float) -> str:
        """A quantity with its unit, as it was typed if it had one."""
        return self.typed(key) or f"{as_code(value)} {unit}"

    @property
    def measures(self) -> tuple[rl.Measure, ...]:
        """What is measured of every load."""
        return tuple(measure for each in self.added for measure in each.measures())

    def staged(self, refines: bool) -> tuple[int, bool]:
        """Points along a side of what is followed twice, and whether finer ones come later."""
        coarse, finer = self.points(_COARSE_POINTS), self.points(CURVE_POINTS)
        return (finer, False) if refines else (coarse, coarse < finer)

    def points(self, fewest: int) -> int:
        """The fewest points along a side, from so many on, that resolve all, if any do."""
        n = min(self.n, fewest)
        while n < self.n and not all(each.is_resolved(self, n) for each in self.added):
            n *= 2
        return n

    def force(self, force_bar: Any) -> Any:
        """Forces F = F̄ E* h L. [N]"""
        return force_bar * (self.E_star * self.rms_height * self.length)

    def force_bars(self, pressed: rl.SurfaceCurve) -> NDArray[np.float64]:
        """Dimensionless forces of a curve, over the E* of the state. [1]"""
        return pressed.force / self.force(1.0)

    def stiffness_bars(self, stiffness: Any) -> Any:
        """Stiffnesses k / (E* L), of both models alike, over the E* of the state. [1]"""
        return stiffness / (self.E_star * self.length)

    def over_force(self, pressed: rl.SurfaceCurve) -> dict[str, NDArray[np.float64]]:
        """What panels over force show of loads, by their keys."""
        found = {
            "stiffness": self.stiffness_bars(pressed.stiffness),
            "area": pressed.area_fraction_corrected,
        }
        for each in self.added:
            found |= each.over_force(pressed)
        return found

    @property
    def most_force_bar(self) -> float:
        """Dimensionless force that all of the area bears. [1]"""
        if (law := self.law) is None:
            return math.inf
        return Bounds.of(law).largest_force(self.length**2) / float(self.force(1.0))

    def bearable(self, force_bars: NDArray[np.float64]) -> NDArray[np.float64]:
        """Those of dimensionless forces that curves of the surface go to. [1]"""
        return force_bars[force_bars < _LARGEST_FORCE_SHARE * self.most_force_bar]

    def texts(self) -> dict[str, str]:
        """All that is set, as texts by the keys of the controls."""
        texts = {key: each.text(getattr(self, key)) for key, each in CONTROLS.items()}
        for kind in self.added:
            texts |= {kind.key: kind.word}
            texts |= {each.key: each.text(getattr(kind, each.key)) for each in kind.controls}
        return texts

    def address(self) -> dict[str, str]:
        """What the address says of this state: the version, and what is not the default.

        What is more than a number stands there as it was typed: under another height a pressure is
        another F̄, and stays the pressure.
        """
        added = [each for kind in self.added for each in kind.controls if each.key != kind.key]
        default = {each.key: each.text(each.usual) for each in (*CONTROLS.values(), *added)}
        texts = {
            key: text
            for key, text in self.texts().items()
            if text != default.get(key) or key in ("D_f", "F", "n", "seed")
        }
        typed = {key: text.strip() for key, text in self.typed_texts.items() if key in texts}
        return {"v": VERSION, **texts, **{k: x for k, x in typed.items() if not is_number(x)}}

    def _spectrum(self, n: int, height: float) -> rl.SelfAffine:
        q_low = 2 * math.pi / self.length
        return rl.SelfAffine(
            fractal_dimension=self.D_f,
            length=self.length,
            rms_height=height,
            q_roll=q_low / self.roll_off,
            q_high=q_low * min(1 / self.cutoff, n / 2),
        )


@lru_cache(maxsize=4)
def _surface(spectrum: rl.SelfAffine, n: int, seed: int) -> rl.Surface:
    return replace(spectrum.surface(n, seed), unit="m")
