"""What is set in the view "My surface": texts read and checked, control by control."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator, Mapping
from contextlib import contextmanager
from dataclasses import dataclass
from pathlib import Path
from typing import Any, TypeVar

import roughline as rl
from roughline.assessment.given import checked_friction
from roughline.assessment.hardness import checked_hardness
from roughline.assessment.nominal import area_of_joint
from roughline.assessment.question import Question
from roughline.assessment.reading import Reading
from roughline.engineering.materials import Material, material
from roughline.errors.checks import shown
from roughline.lab.controls import (
    ControlError,
    is_number,
    refuse_strange,
    texts_of,
    usable,
)
from roughline.lab.measured import controls as c
from roughline.lab.measured.examples import path_of
from roughline.theories.theory import THEORIES
from roughline.topography.preparation import Preparation
from roughline.units import in_si, lengths, load_in_newtons, refuse_decimal_comma

_FILES = ("file", "example")
_KNOWN = (*_FILES, *c.KEYS)
_NEEDING = ("joint_area", "friction", "frequency")  # controls that need two materials
_OF_ARGUMENTS = {"E_star": "E", "missing": "fill", "points": "resample", "sizes": "size"}
"""Controls of arguments that have other names; most have the same."""

_Read = TypeVar("_Read")
Arguments = Mapping[str, Any]
Said = Mapping[str, str]


@dataclass(frozen=True)
class Source:
    """The file of a page.

    Attributes
    ----------
    path : Path
        Where it lies.
    name : str
        What its owner calls it.
    key : str
        By which the page knows it.
    """

    path: Path
    name: str
    key: str


def said_of(arguments: Arguments) -> Said:
    """The texts of the controls by their keys; empty ones are as if they were not there.

    Raises
    ------
    ControlError
        If one has no place here, or the link that they are from is of another version.
    """
    said = texts_of(arguments)
    refuse_strange(said, _KNOWN)
    return {key: text.strip() for key, text in said.items() if text.strip()}


def used_in(arguments: Arguments, read: Callable[[Said], _Read]) -> tuple[_Read, dict[str, str]]:
    """What is read of the texts that can be used, and why others are not, by control.

    Raises
    ------
    ControlError
        If what is wrong is the whole link, or not the text of a control.
    """
    settings = {key: text for key, text in texts_of(arguments).items() if key not in _FILES}
    return usable(
        {**arguments, "state": settings},
        lambda texts: read(said_of({"state": texts})),
        lambda found: c.DEFAULTS,
        c.NEEDED,
    )


def source_of(said: Said, session: Mapping[str, Any]) -> Source:
    """The file that a page means, or the first of them.

    Raises
    ------
    ControlError
        If there is none, or it is gone.
    """
    return sources_of(said, session)[0]


def sources_of(said: Said, session: Mapping[str, Any]) -> list[Source]:
    """The files that a page means: several are maps of one part.

    Raises
    ------
    ControlError
        If there is none, or one is gone.
    """
    if key := said.get("example"):
        if key not in c.EXAMPLES:
            raise ControlError(
                f'there is no example "{key[:40]}"; there are {", ".join(c.EXAMPLES)}', "file"
            )
        path = path_of(key, Path(session["folder"]) / "results")
        return [Source(path, c.EXAMPLES[key].file, key)]
    keys = said.get("file", "").split(",")
    paths = [session["files"].get(key) for key in keys]
    if None in paths:
        which = "the file is" if len(paths) == 1 else "one of the files is"
        raise ControlError(f"{which} no longer here: choose it again", "file")
    names = [session["names"][path] for path in paths]
    return [
        Source(Path(path), f"{name} ({i})" if names.count(name) > 1 else name, key)
        for i, (key, path, name) in enumerate(zip(keys, paths, names, strict=True), 1)
    ]


def reading_of(said: Said, name: str | None) -> Reading:
    """How the file is read."""
    with at("unit"):
        unit = said.get("unit")
        Reading(unit=unit)
    with at("blur"):
        blur = (
            in_si("0 m" if said["blur"] == "0" else said["blur"], "m", "blur")
            if "blur" in said
            else None
        )
        Reading(blur=blur)
    with at("tip_radius"):
        radius = in_si(said["tip_radius"], "m", "tip radius") if "tip_radius" in said else None
        Reading(tip_radius=radius)
    pixels = c.PIXELS.read(said.get("pixels", c.PIXELS.default))
    return Reading(
        unit=unit,
        channel=said.get("channel"),
        sizes=_sizes(said.get("size")),
        missing=c.FILLING.read(said.get("fill", c.FILLING.default)),  # type: ignore[arg-type]
        most_missing=_share(said.get("most_missing")),
        name=name,
        tilt=c.TILT.read(said.get("tilt", c.TILT.default)),  # type: ignore[arg-type]
        pixels=None if pixels == c.PIXELS.default else pixels,  # type: ignore[arg-type]
        blur=blur,
        tip_radius=radius,
    )


def preparation_of(said: Said) -> Preparation | None:
    """What is done to the topography; None where nothing is set, as on the command line."""
    trend = c.TREND.read(said.get("trend", c.TREND.default))
    with at("crop"):
        crop = _crop(said["crop"]) if "crop" in said else None
    with at("low_pass"):
        low_pass = in_si(said["low_pass"], "m", "low pass") if "low_pass" in said else None
        Preparation(low_pass=low_pass)
    points = _whole(said.get("resample"), "resample", "points to resample to", 2, c.MOST_POINTS)
    spikes = c.OUTLIERS.read(said.get("outliers", c.OUTLIERS.default)) == "remove"
    found = Preparation(
        crop=crop,
        remove_outliers=spikes,
        trend=None if trend == c.TREND.default else trend,  # type: ignore[arg-type]
        low_pass=low_pass,
        points=points,
    )
    return None if found == Preparation() else found


def question_of(said: Said, source: Source) -> Question:
    """The question that the page asks of one of its files.

    Raises
    ------
    ControlError
        If a text cannot be used; it says at which control.
    """
    given = bodies_of(said) | yield_and_joint_of(said)
    loads = loads_of(said)
    friction = friction_of(said)
    with at("frequency"):
        frequency = in_si(said["frequency"], "Hz", "frequency") if "frequency" in said else None
    reading, preparation = reading_of(said, source.name), preparation_of(said)
    with at(next((key for key in _NEEDING if key in said), "")):
        return Question(
            source.path,
            **given,
            loads=loads,
            periodic=c.BOUNDARY.read(said.get("boundary", c.BOUNDARY.default)) == "periodic",
            friction=friction,
            frequency=frequency,
            theories=theories_of(said),
            grid_error=c.GRID_ERRORS[c.GRID.read(said.get("grid_error", c.GRID.default))],
            reading=reading,
            preparation=preparation,
            whole_curve=bool(loads),
        )


def bodies_of(said: Said) -> dict[str, Any]:
    """Two materials, or a contact modulus, as a question takes them."""
    if c.BODIES.read(said.get("bodies", c.BODIES.default)) == "modulus":
        with at("E"):
            if "E" not in said:
                raise ControlError('give the contact modulus, such as "110 GPa"', "E")
            modulus = in_si(said["E"], "Pa", "contact modulus")
            if not 0 < modulus < math.inf:
                raise ControlError(
                    f'contact modulus is "{said["E"][:40]}"; give a positive one', "E"
                )
        return {"E_star": modulus}
    pair: list[Material] = []
    for key in ("first", "second"):
        with at(key):
            if key not in said:
                raise ControlError(
                    f'give the {key} material: a name, or values such as "E=70 GPa nu=0.33"', key
                )
            pair.append(material(said[key]))
    if all(math.isinf(each.E) for each in pair):
        raise ControlError("both materials are rigid: one of them must give way", "second")
    return {"materials": tuple(pair)}


def yield_and_joint_of(said: Said) -> dict[str, Any]:
    """Hardness and area of the joint, as a question takes them."""
    elastic = c.ELASTIC.read(said.get("elastic", c.ELASTIC.default)) == "yes"
    with at("hardness"):
        hardness = checked_hardness(said.get("hardness"), elastic=elastic)
    with at("joint_area"):
        joint_area = area_of_joint(said["joint_area"]) if "joint_area" in said else None
    return {"elastic": elastic, "hardness": hardness, "joint_area": joint_area}


def loads_of(said: Said) -> tuple[str, ...]:
    """The loads, as they were typed."""
    loads = tuple(part.strip() for part in said.get("loads", "").split(";") if part.strip())
    with at("loads"):
        for load in loads:
            if not 0 < load_in_newtons(load, 1.0) < math.inf:
                raise ControlError(f'load is "{load[:40]}"; give positive ones', "loads")
        if len(loads) > c.MOST_LOADS:
            raise ControlError(f"{len(loads)} loads; give up to {c.MOST_LOADS}", "loads")
    return loads


def friction_of(said: Said) -> float | None:
    """The coefficient of friction; None if none is given."""
    text = said.get("friction")
    if text is None:
        return None
    with at("friction"):
        refuse_decimal_comma(text, "the coefficient of friction")
        return checked_friction(float(text) if is_number(text) else text)


def theories_of(said: Said) -> tuple[str, ...]:
    """Theories that are drawn beside the curve."""
    names = tuple(name for name in said.get("theories", "").split(",") if name)
    for name in names:
        if name not in THEORIES:
            allowed = ", ".join(THEORIES)
            raise ControlError(f'there is no theory "{name[:40]}"; there are {allowed}', "theories")
    return names


@contextmanager
def at(key: str) -> Iterator[None]:
    """Say of a refusal at which control it arose, in the words of the page."""
    try:
        yield
    except rl.RoughlineError as error:
        argument = getattr(error, "argument", None) or ""
        named = _OF_ARGUMENTS.get(argument, argument)
        among = getattr(error, "among", (named if named in c.KEYS else key,))
        raise ControlError(str(error), *among) from None


def _share(text: str | None) -> float:
    """A share, in per cent or as a number."""
    with at("most_missing"):
        if text is None:
            return Reading().most_missing
        number = text.removesuffix("%")
        refuse_decimal_comma(number, "most missing")
        share = float(number) if is_number(number) else math.nan
        share = share / 100 if text.endswith("%") else share
        if not 0 <= share < 1:
            raise ControlError(
                f'most missing is "{text[:40]}"; give a share such as 20 %, below 100 %',
                "most_missing",
            )
        return share


def _sizes(text: str | None) -> str | None:
    """Sides of a file that states none, as they were typed."""
    with at("size"):
        sides = lengths(text, "size") if text is not None else []
        if len(sides) > 2 or not all(0 < side < math.inf for side in sides):
            raise ControlError(
                f"size is {shown(text)}; give one or two positive lengths, such as 1 mm, 0.5 mm",
                "size",
            )
    return text


def _crop(text: str) -> tuple[float, ...]:
    """From and to along each side. [m]"""
    ends = tuple(lengths(text, "crop"))
    if len(ends) not in (2, 4) or not all(map(math.isfinite, ends)):
        raise ControlError(
            f"crop is {shown(text)}; give from and to along each side, such as 0 um, 50 um, 0 um, "
            "40 um, or 0 um, 50 um of a line",
            "crop",
        )
    return ends


def _whole(text: str | None, key: str, name: str, least: int, most: int) -> int | None:
    if text is None:
        return None
    if not (text.isascii() and text.isdecimal()) or not least <= int(text[:20]) <= most:
        raise ControlError(
            f'{name} is "{text[:40]}"; give a whole number from {least} to {most}', key
        )
    return int(text)
