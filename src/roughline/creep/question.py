"""A rough body pressed into one that creeps, over times and loads with units."""

from __future__ import annotations

import math
import re
from collections.abc import Iterable
from dataclasses import dataclass
from pathlib import Path

import numpy as np
from attrs import field, frozen

from roughline.contact.arguments import LARGEST_NUMBER, given_half_space
from roughline.contact.strain import LARGE_STRAIN, LARGEST_STRAIN, LINEARITY
from roughline.creep.creep import Creep
from roughline.creep.press_creep import CreepCurve, press_creep
from roughline.engineering.coated import Solid
from roughline.engineering.pair import MaterialPair
from roughline.errors import InputError
from roughline.errors.checks import refuse, shown
from roughline.errors.words import called, speaking
from roughline.facts.fact import Fact, WithFacts
from roughline.halfspace.elasticity.half_space import HalfSpace
from roughline.question.arguments import (
    called_by,
    given_pair,
    modulus,
    one_body,
    quantities,
    read_pair,
    refuse_unless_one_load,
    refuse_unless_one_modulus,
    several,
)
from roughline.question.kinds import nominal_area
from roughline.question.reading import Reading
from roughline.question.source import Topography
from roughline.topography.body import Body, Line, side_lengths
from roughline.topography.effects import what_was_prepared
from roughline.topography.files.read import suspicions
from roughline.topography.preparation import Preparation
from roughline.units import (
    as_si,
    decimal,
    in_si,
    load_in_newtons,
    refuse_decimal_comma,
)

_TERM = re.compile(
    r"\s*(?P<share>[\d.]+(e[-+]?\d+)?)\s*(?P<percent>%?)\s+(?P<time>[-+.\d].*)", re.IGNORECASE
)
_EXAMPLE = (
    "give shares of the modulus at once that relax, each with its time, such as "
    '"0.3 10 ms, 0.4 1 s"'
)
_ELASTIC_SHARE = 0.01  # of the compliance, up to which what does not creep is as good as rigid
_DEFAULT_TIMES = 12  # beside zero
_MARGIN_OF_TIMES = 10.0  # before the first relaxation time, and after the last one


def _prony(given: str | Creep) -> Creep:
    """Read "0.3 10 ms, 0.4 1 s"; a relaxation function is itself."""
    if isinstance(given, Creep):
        return given
    if not isinstance(given, str):
        refuse("prony", given, _EXAMPLE)
    refuse_decimal_comma(given, "prony")
    terms = [_TERM.fullmatch(part) for part in given.split(",")]
    shares, times = [], []
    for term in terms:
        if term is None:
            refuse("prony", given, _EXAMPLE)
        try:
            shares.append(float(term["share"]) / (100 if term["percent"] else 1))
        except ValueError:
            refuse("prony", given, _EXAMPLE)
        times.append(in_si(term["time"].strip(), "s", "prony"))
    try:
        with speaking(None):  # a description calls its values the same for everyone
            return Creep(shares, times)
    except InputError as error:
        raise InputError(f"is {shown(given)}: {error}", "prony") from error


def _times(given: float | str | Iterable[float | str] | None) -> tuple[float | str, ...]:
    """Read "1 s, 1 min, 1 h", or times one by one; they stay as they were typed."""
    if not isinstance(given, str):
        return several(given)
    refuse_decimal_comma(given, "times")
    return tuple(each.strip() for each in given.split(","))


@frozen
class CreepQuestion:
    """What is asked of a rough body that is pressed into one that creeps.

    Everything is in SI units; a quantity is a number, or a text with its unit.

    Parameters
    ----------
    body : Surface, Line, str or Path
        A body in metres, or a file with a topography.
    prony : Creep or str
        How the modulus relaxes: shares of the modulus at once, each with its time, as
        "0.3 10 ms, 0.4 1 s".
    materials : pair of Material, Coated or str, or str, optional
        Of both bodies, with moduli at once. One is rigid, or far stiffer than the other, or both
        are of one material; of a coated one the base is rigid.
    E_star : float or str, optional
        Contact modulus at once instead of materials. [Pa]
    times : str, or sequence of float or str, optional
        When the contact is wanted, rising, as "1 s, 1 min, 1 h"; default: from zero to long after
        the last relaxation time. [s]
    loads, depths : float or str, or sequence of them, optional
        One of the two: a force [N], a mean pressure as text, or a depth since first touch [m]. One
        is held from time zero on; several are those at the times, straight between them.
    periodic : bool, optional
        As for :func:`roughline.press_creep`.
    reading : Reading, optional
        How the file is read.
    preparation : Preparation, optional
        Of the topography.

    Raises
    ------
    InputError
        If the question does not fit together.
    UnitError
        If a text has no unit, or a wrong one.
    """

    body: Body | Path = field(converter=one_body)
    prony: Creep = field(converter=_prony)
    materials: tuple[Solid, Solid] | None = field(default=None, converter=read_pair)
    E_star: float | None = field(default=None, converter=modulus)
    times: tuple[float | str, ...] = field(default=(), converter=_times)
    loads: tuple[float | str, ...] = field(default=(), converter=quantities)
    depths: tuple[float | str, ...] = field(default=(), converter=quantities)
    periodic: bool = False
    reading: Reading = field(factory=Reading)
    preparation: Preparation | None = None

    def __attrs_post_init__(self) -> None:
        refuse_unless_one_modulus(self.E_star, self.materials)
        refuse_unless_one_load(self.loads, self.depths)
        if len(self.loads or self.depths) > 1 and not self.times:
            raise InputError(
                f"{called('times')} are needed with several loads, one for each: give them, or one "
                "load that is held"
            )
        self.values(1.0)  # refuses what cannot be
        self.seconds  # noqa: B018 - likewise
        self._check_materials()

    def _check_materials(self) -> None:
        """Refuse bodies of which a part gives way and does not creep as the others do."""
        pair = self.pair
        if pair is None:
            return
        for coated in pair.coated:
            if math.inf > coated.base.E or self.both_give_way:
                refuse(
                    "materials",
                    coated.name,
                    "all that gives way has to creep alike: the base of its layers and the other "
                    'body have to be rigid, such as "E=9 MPa nu=0.49 2 mm on rigid, rigid"',
                )
        if self.elastic_share > _ELASTIC_SHARE:
            raise InputError(
                f"give {self.stiffer} a share of {self.elastic_share:.2g} in the compliance, and "
                "all that gives way has to creep alike: give the body that does not creep as rigid",
                "materials",
            )

    @property
    def pair(self) -> MaterialPair | None:
        """Both materials; None without them."""
        return given_pair(self.materials, None)

    @property
    def half_space(self) -> HalfSpace:
        """What both bodies are pressed as at once."""
        if self.pair is None:
            return given_half_space(None, self.E_star, self.periodic)
        return self.pair.half_space(periodic=self.periodic)

    @property
    def both_give_way(self) -> bool:
        """Whether neither of both materials is rigid."""
        return self.materials is not None and all(
            math.inf > each.surface.E for each in self.materials
        )

    @property
    def stiffer(self) -> str:
        """Name of the stiffer material."""
        return max(self.materials or (), key=lambda each: each.surface.E).name

    @property
    def elastic_share(self) -> float:
        """Share of the stiffer body in the compliance; zero if it is rigid, or as the other. [1]"""
        if not self.both_give_way:
            return 0.0
        first, second = ((1 - each.surface.nu**2) / each.surface.E for each in self.materials or ())
        return 0.0 if first == second else min(first, second) / (first + second)

    @property
    def headings(self) -> list[str]:
        """What each time is called: as it was typed, or with its unit."""
        return called_by(self.times or self.seconds, "s", 3)

    @property
    def seconds(self) -> list[float]:
        """Times at which the contact is wanted. [s]"""
        if self.times:
            return [as_si(each, "s", "times") for each in self.times]
        relaxation = several(self.prony.times)
        last = _MARGIN_OF_TIMES * max(relaxation) / self.prony.relaxed_share
        spaced = np.geomspace(min(relaxation) / _MARGIN_OF_TIMES, last, _DEFAULT_TIMES)
        return [0.0, *spaced.tolist()]

    def strain(self, body: Body) -> float:
        """About how far the largest load strains bodies that have relaxed. [1]

        That is what the mean pressure does to the modulus that remains, or the depth over the
        shorter side, which is none of repeated bodies.
        """
        area, side = nominal_area(body), min(side_lengths(body))
        largest = max(self.values(area))
        if self.depths:
            return 0.0 if self.periodic else largest / side
        return self.half_space.strain(largest / area, side) / self.prony.relaxed_share

    def values(self, area: float) -> list[float]:
        """Forces on a body of a nominal area [N], or depths [m], in their order."""
        if self.depths:
            name, given = "depths", self.depths
            values = [as_si(each, "m", name) for each in given]
        else:
            name, given = "loads", self.loads
            values = [
                load_in_newtons(each, area) if isinstance(each, str) else as_si(each, "N", name)
                for each in given
            ]
        for i, (each, value) in enumerate(zip(given, values, strict=True)):
            if not (0 < value <= LARGEST_NUMBER or (value == 0 and len(values) > 1 and i == 0)):
                refuse(name, each, "a positive, finite one is needed, and zero only before touch")
        return values


@dataclass(frozen=True, eq=False)
class PressedCreep(WithFacts):
    """A body that was pressed into one that creeps."""

    question: CreepQuestion
    body: Body
    curve: CreepCurve

    @property
    def facts(self) -> list[Fact]:
        """What is suspicious, which bodies are taken to creep, and how they were prepared."""
        question, body = self.question, self.body
        found = [*suspicions(body), *what_was_prepared(body), *self.curve.elastic.facts]
        if (strain := question.strain(body)) > LARGE_STRAIN:
            found.append(Fact("creep_strains", strain=strain))
        if share := question.elastic_share:
            found.append(Fact("stiffer_creeps", body=question.stiffer, share=share))
        elif question.both_give_way:
            found.append(Fact("both_creep"))
        return list(dict.fromkeys(found))


def press_with_creep(question: CreepQuestion) -> PressedCreep:
    """Read and prepare the body of a question, and press it over its times.

    Raises
    ------
    InputError
        If the body, or the history of its loads, cannot be used.
    ConvergenceError
        If a contact was not solved.
    """
    body = Topography.of(question.body, question.reading, question.preparation).body
    if isinstance(body, Line) and body.kind == "profile":
        raise InputError(
            "this is a line scan across a surface, whose contact over time is not that of one "
            "line: press a map, or a reduced line"
        )
    values = question.values(nominal_area(body))
    if (strain := question.strain(body)) > LARGEST_STRAIN:
        largest = int(np.argmax(values))
        name, given = ("depths", question.depths) if question.depths else ("loads", question.loads)
        refuse(
            name,
            given[largest],
            f"the bodies are strained by about {decimal(strain, 2)} in the end, and {LINEARITY}: "
            "give less, or check the units",
        )
    held = values if len(values) > 1 else values[0]
    curve = press_creep(
        body,
        question.prony,
        times=question.seconds,
        force=held if question.loads else None,
        depth=held if question.depths else None,
        half_space=question.half_space,
    )
    return PressedCreep(question, body, curve)
