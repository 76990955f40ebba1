"""The fields of a question: each stands here once, for Python, the command line and the lab.

Options, controls, keys of addresses, generated code and the names of arguments in messages are read
from this table. A new field is an entry here, an attribute, and the physics that reads it.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator, Mapping
from contextlib import suppress
from dataclasses import dataclass, field
from functools import partial
from typing import Any

from roughline.errors.checks import refuse

BODIES = "Bodies"
LOADS = "Loads"
ANSWERS = "Answers"
FILE = "A file"
PREPARATION = "Preparation"

_MOST_DIGITS = 20  # of a whole number

FieldValues = Mapping[str, Any]
"""Values by the names of fields; None where nothing is told."""

_FLUID = "a fluid in the gap: what leaks"
_FOLDED_AWAY = "more"


@dataclass(frozen=True)
class Text:
    """One of several texts that the lab's form has for a field."""

    label: str
    begins: str  # what stands in it at first, and is used where nothing else can be
    help: str


@dataclass(frozen=True, kw_only=True, eq=False)
class Field:
    """One thing that a question is told."""

    name: str  # in messages, and as the argument of what it is of
    # or "Reading", "Missing" of a reading, "Preparation", or the class of what is asked
    of: str = "Question"
    group: str
    flag: str = "--{}"
    """On the command line: its name with dashes, or others with commas between; empty for none."""

    control: str = "{}"  # key in the lab's form and addresses: its name, or another; empty for none
    label: str = ""  # what the form calls it
    word: str = ""  # what the lab's messages call it if that differs
    argument: str = "{}"  # of what it is of, in Python: its name, or another
    help: str = ""  # one sentence with an example
    otherwise: str = ""  # what holds if it is not given, in words
    kind: type = str  # of one value on the command line
    separator: str = ""  # between several values in the lab; empty if there is only one
    choices: Mapping[str, tuple[Any, str]] = field(default_factory=dict)
    """Values that may be chosen and what the form calls them, by the words of addresses, the
    default first."""

    begins: str = ""  # what stands in the lab's form at first
    fold: str = ""  # of the lab's form, in which it stands
    is_of_file: bool = False  # whether the lab asks it anew with each file
    texts: Mapping[str, Text] = field(default_factory=dict)  # of the lab's form, by their keys
    read: Callable[[str], Any] = str  # reads one text; the value is what Python is given

    def __post_init__(self) -> None:
        object.__setattr__(self, "flag", self.flag.format(self.name.replace("_", "-")))
        object.__setattr__(self, "control", self.control.format(self.name))
        object.__setattr__(self, "argument", self.argument.format(self.name))

    @property
    def is_asked(self) -> bool:
        """Whether a value of its own is asked for it."""
        return self.of not in ("Question", "Reading", "Missing", "Preparation")

    @property
    def first_flag(self) -> str:
        """The flag by which the command line calls it first."""
        return self.flag.partition(",")[0]

    @property
    def is_switch(self) -> bool:
        """Whether the command line has it as a flag without a value."""
        return any(value is True for value, _ in self.choices.values())

    @property
    def can_be_left(self) -> bool:
        """Whether nothing, which is neither yes nor no, may be chosen."""
        return any(value is None for value, _ in self.choices.values())

    def is_set(self, value: Any) -> bool:
        """Whether a value says something: None does not, nor does a switch that is off."""
        return value is not None and value != [] and (value is not False or self.can_be_left)

    def in_command(self, value: Any, text: str) -> list[str]:
        """Write a value, which was read from a text, as words of the command line."""
        flag = self.first_flag
        if not self.is_switch:
            texts = value if self.separator else [text]
            return [word for each in texts for word in (flag, each)]
        return [flag] if value else [flag.replace("--", "--no-")] * self.can_be_left

    def value(self, given: Any) -> Any:
        """Read what was given: texts are read, and all else is the value itself."""
        if isinstance(given, list):
            return [self.value(each) for each in given]
        return self.read(given) if isinstance(given, str) else given


def _length(name: str) -> Callable[[str], float]:
    """Read a positive length. [m]"""

    def read(text: str) -> float:
        from roughline.units import in_si  # here because it loads slowly

        length = in_si(text, "m", name)
        if not 0 < length < math.inf:
            refuse(name, text, "a positive, finite length is needed")
        return length

    return read


def _number(name: str) -> Callable[[str], float | str]:
    """Read a number, or a share in per cent; what is none is left to who refuses it."""

    def read(text: str) -> float | str:
        from roughline.units import refuse_decimal_comma

        refuse_decimal_comma(text, name)
        with suppress(ValueError):
            if text.isascii() and "_" not in text:
                return float(text.removesuffix("%")) / (100 if text.endswith("%") else 1)
        return text

    return read


def _whole_number(text: str) -> int | str:
    """Read a whole number; what is none is left to who refuses it."""
    return int(text) if text.isascii() and text.isdecimal() and len(text) < _MOST_DIGITS else text


def _sizes(text: str) -> str:
    """Read one or two positive lengths; they stay a text, as they may be typed."""
    from roughline.units import lengths

    sides = lengths(text, "sizes")
    if len(sides) > 2 or not all(0 < side < math.inf for side in sides):
        refuse("sizes", text, "give one or two positive lengths, such as 1 mm, 0.5 mm")
    return text


def _blur(text: str) -> float:
    """Read a standard deviation; none has no unit. [m]"""
    from roughline.units import in_si

    blur = in_si("0 m" if text == "0" else text, "m", "blur")
    if not 0 <= blur < math.inf:
        refuse("blur", text, "a length from 0 on is needed")
    return blur


def _crop(text: str) -> tuple[float, ...]:
    """Read from and to along each side. [m]"""
    from roughline.units import lengths

    ends = tuple(lengths(text, "crop"))
    if len(ends) not in (2, 4) or not all(map(math.isfinite, ends)):
        needed = 'give from and to along each side, such as "0 um, 50 um, 0 um, 40 um"'
        refuse("crop", text, f"{needed}, or of a line scan two")
    return ends


_of_bodies = partial(Field, group=BODIES)
_of_loads = partial(Field, group=LOADS)
_of_answers = partial(Field, group=ANSWERS)
_of_fluid = partial(_of_answers, of="Fluid", fold=_FLUID)
_of_file = partial(Field, of="Reading", group=FILE)
_of_missing = partial(Field, of="Missing", group=FILE)
_of_preparation = partial(Field, of="Preparation", group=PREPARATION)

FIELDS: tuple[Field, ...] = (
    _of_bodies(
        name="materials",
        control="",
        word="two materials",
        help='Both materials, such as "steel,copper", "E=70 GPa nu=0.33, rigid", or with layers '
        '"rubber 2 mm on steel, rigid".',
        texts={
            "first": Text(
                "rough body",
                "steel",
                'A name, "steel"; with values, "steel hardness=6 GPa" or "E=70 GPa nu=0.33"; '
                'coated, "gold 2 um on steel" or "gold 0.5 um on nickel 2 um on copper".',
            ),
            "second": Text(
                "smooth body",
                "copper",
                'Like the rough body, or "rigid": "rubber 2 mm on steel", "rigid".',
            ),
        },
    ),
    _of_bodies(
        name="E_star",
        flag="--modulus",
        control="",
        word="the contact modulus",
        help='Contact modulus E* instead of the materials, such as "110 GPa".',
        texts={
            "E": Text(
                "modulus E*",
                "110 GPa",
                'Of both bodies, 1/E* = (1 - nu1²)/E1 + (1 - nu2²)/E2, such as "110 GPa".',
            )
        },
    ),
    _of_bodies(
        name="against",
        control="",
        help="Topography of the second body, read and prepared like the first.",
        otherwise="a smooth body",
    ),
    _of_bodies(
        name="hardness",
        help='Hardness of the softer body, such as "2 GPa", taken as exact.',
        otherwise="of the materials, with its scatter",
    ),
    _of_bodies(
        name="elastic",
        label="yield",
        word='"elastic"',
        help="Take both bodies as elastic, however high the pressures. Otherwise points bear at "
        "most the hardness of the softer body; where it is reached, the surface is permanently "
        "indented.",
        choices={"no": (False, "where a hardness is known"), "yes": (True, "elastic")},
    ),
    _of_bodies(
        name="adhesion",
        of="Adhesion",
        argument="attraction",
        help="How the bodies attract each other: work of adhesion, range and law, such as "
        '"50 mJ/m^2", "50 mJ/m^2 over 2 nm, exponential" or "pdms"; adds what it takes to draw '
        "them apart after the largest load.",
        otherwise="they only push",
    ),
    _of_loads(
        name="loads",
        flag="--load,--force",
        help='A total force, such as "10 N", or a mean pressure, such as "2 MPa".',
        otherwise="20 loads up to saturation",
        separator=";",
        begins="2 MPa",
    ),
    _of_loads(
        name="depths",
        flag="--depth",
        control="",
        help='A depth, such as "200 nm".',
        separator=";",
    ),
    _of_loads(
        name="joint_area",
        of="Joint",
        argument="area",
        help='Area of the joint that the map is a part of, such as "2 cm^2": forces then act on '
        "the joint, and the answers are those of the joint.",
        otherwise="the map alone",
    ),
    _of_loads(
        name="n_loads",
        flag="--loads",
        control="",
        help="Number of loads from first touch to saturation.",
        otherwise="20",
        kind=int,
    ),
    _of_loads(
        name="history",
        control="",
        help="Apply several --load in the order given, rising and falling, each to the surface as "
        "the load before it left it.",
        choices={"no": (False, "rising"), "yes": (True, "in the order given")},
    ),
    _of_loads(
        name="unload",
        control="",
        help="Remove the largest --load again, in steps down to zero.",
        choices={"no": (False, "no"), "yes": (True, "down to zero")},
    ),
    _of_bodies(
        name="periodic",
        control="boundary",
        label="half-space",
        help="Repeat the surface periodically: it has no borders, and the stiffness is that of "
        "the interface. Otherwise the half-space continues, unloaded, around the surface.",
        choices={"free": (False, "free"), "periodic": (True, "periodic")},
        fold=_FOLDED_AWAY,
    ),
    _of_bodies(
        name="periodic_along",
        argument="periodic",
        control="",
        help="Repeat the surface along one direction and leave it free across, as a roller or a "
        "line seal, with --modulus; depth counts from a place as far away across as it is wide.",
        choices={"none": (None, "none"), "x": ("x", "x"), "y": ("y", "y")},
    ),
    _of_answers(
        name="friction",
        of="Friction",
        argument="coefficient",
        fold=_FOLDED_AWAY,
        help="Coefficient of friction, above 0 and up to 5, such as 0.3: adds partial slip at the "
        "largest load, its curve in the report and in JSON.",
        otherwise="none",
        kind=float,
        read=_number("friction"),
    ),
    _of_answers(
        name="shear",
        of="Shear",
        argument="force",
        control="",
        help='Shear force to and fro under the load, such as "20 N", or over the area "2 MPa": '
        "adds stick and slip, tangential stiffness, and what a cycle dissipates.",
        otherwise="none",
    ),
    _of_answers(
        name="cycles",
        of="Shear",
        control="",
        help="How often the shear force goes to and fro.",
        otherwise="once, and three times where materials differ",
        kind=int,
        read=_whole_number,
    ),
    _of_answers(
        name="frequency",
        of="Ultrasound",
        fold=_FOLDED_AWAY,
        label="ultrasound",
        word="frequency",
        help='Frequency of ultrasound, such as "5 MHz": adds its reflection by the interface.',
        otherwise="none",
    ),
    _of_fluid(
        name="fluid",
        help='Fluid in the gap, such as "water", "oil VG 46", "air" or "helium": adds what flows '
        "through, and of a gas what it conducts.",
        otherwise="none",
    ),
    _of_fluid(
        name="inlet",
        label="inlet pressure",
        help='Absolute pressure of the fluid where it enters, such as "6 bar".',
    ),
    _of_fluid(
        name="carries",
        flag="--fluid-carries",
        control="fluid_carries",
        label="fluid carries load",
        help="Whether the fluid carries its part of the load, so that the bodies press with the "
        "rest.",
        otherwise="from a twentieth of the load on",
        choices={
            "default": (None, "from a twentieth on"),
            "yes": (True, "always"),
            "no": (False, "never"),
        },
    ),
    _of_fluid(
        name="outlet",
        label="outlet pressure",
        help='Absolute pressure of the fluid where it leaves, such as "1 bar"; "0 bar" is vacuum.',
        otherwise="1 atm",
    ),
    _of_fluid(
        name="seal",
        help="The face that the fluid crosses: length across the flow and width along it, such as "
        '"100 mm x 2 mm", or both radii of a ring, such as "20 mm .. 24 mm".',
    ),
    _of_fluid(
        name="along",
        flag="--flow-along",
        control="flow_along",
        label="flow along",
        help="Direction over the map in which the fluid flows.",
        choices={
            "both": (None, "the leakier of both"),
            "x": ("x", "x"),
            "y": ("y", "y"),
        },
    ),
    _of_fluid(
        name="closure",
        flag="--sealing-pressure",
        control="sealing_pressure",
        label="sealing",
        word='sealing "where it seals"',
        help="Find the mean pressure at which the last channel closes, and down to which load the "
        "leak stays below ten times that under the largest; it takes as long as some 45 loads.",
        choices={"no": (False, "as loaded"), "yes": (True, "where it seals")},
    ),
    _of_answers(
        name="theories",
        of="Theories",
        fold=_FOLDED_AWAY,
        flag="--theory",
        help="Theory to compare with, of the same waves and of periodic surfaces: {theories}.",
        separator=",",
    ),
    _of_answers(
        name="grid_error",
        fold=_FOLDED_AWAY,
        label="grid error",
        word='grid error "estimate"',
        help="Estimate discretisation errors from coarser grids, without which there are no "
        "intervals; it takes about twice as long.",
        otherwise="where that takes only a few seconds, and for a report",
        choices={
            "default": (None, "where it is quick"),
            "yes": (True, "estimate"),
            "no": (False, "leave out"),
        },
    ),
    _of_answers(
        name="whole_curve",
        flag="",
        control="",
        choices={"no": (False, "no"), "yes": (True, "yes")},
    ),
    _of_file(
        name="unit",
        label="unit of lengths",
        word="unit",
        help="Unit of the lengths and heights in a file that states none, such as um.",
        is_of_file=True,
    ),
    _of_file(
        name="channel",
        help="Channel of the file: its name, or its number from 0; only heights can be pressed.",
        is_of_file=True,
    ),
    _of_file(
        name="sizes",
        flag="--size",
        control="size",
        label="size",
        help='Sides of a file that states none, such as "1 mm, 0.5 mm"; one for a square.',
        is_of_file=True,
        read=_sizes,
    ),
    _of_missing(
        name="missing",
        argument="method",
        flag="--fill",
        control="fill",
        label="filling",
        help="How missing points are filled: by the smoothest surface through their neighbours, or "
        "by the nearest known height. The answers try both.",
        choices={
            "harmonic": ("harmonic", "smoothest surface"),
            "nearest": ("nearest", "nearest height"),
        },
    ),
    _of_missing(
        name="most_missing",
        argument="most",
        flag="--max-missing",
        label="most missing",
        help="Largest share of missing points, 0 to below 1, that is filled; a file with more is "
        "refused.",
        otherwise="10 %",
        kind=float,
        read=_number("most_missing"),
    ),
    _of_missing(
        name="mask",
        label="masked points",
        help="What becomes of points that a mask in the file selects, such as grains marked in "
        "Gwyddion: their heights are used, or they are left out and filled like missing points.",
        choices={"use": ("use", "used"), "leave-out": ("leave-out", "left out")},
    ),
    _of_file(
        name="tilt",
        label="tilt is of",
        help="Whose the tilt of measured heights is: the mounting's alone, such as the stage's, or "
        "also that of waves longer than the topography, which change the answers for a larger "
        "surface.",
        choices={"unknown": ("unknown", "not known"), "mounting": ("mounting", "the mounting")},
    ),
    _of_file(
        name="pixels",
        label="heights are",
        help="Whether heights are means over pixels or those of points, which tells the instrument "
        "from the surface in the spectrum's tail.",
        otherwise="means for files of optical instruments, else not known",
        choices={
            "default": (None, "as the file says"),
            "means": ("means", "means over pixels"),
            "points": ("points", "of points"),
        },
    ),
    _of_file(
        name="blur",
        help="Standard deviation of the instrument's Gaussian blur beside the pixels', such as "
        '"0.3 um"; 0 for none.',
        otherwise="not known",
        read=_blur,
    ),
    _of_file(
        name="tip_radius",
        label="tip radius",
        help='Radius of the tip that traced the surface, such as "2 um": shorter waves than it '
        "follows are left out of the self-affine law.",
        otherwise="none",
        read=_length("tip_radius"),
    ),
    _of_preparation(
        name="trend",
        help="Trend that is removed from the heights by least squares.",
        otherwise="the tilt of measured ones; our own files stay as they are",
        choices={
            "default": (None, "tilt, as measured"),
            "none": ("none", "none"),
            "mean": ("mean", "mean"),
            "tilt": ("tilt", "tilt"),
            "curvature": ("curvature", "curvature"),
        },
    ),
    _of_preparation(
        name="crop",
        help='Piece to keep, from and to along x and y, such as "0 um, 50 um, 0 um, 40 um"; y '
        "counts from the top of the picture.",
        otherwise="all",
        is_of_file=True,
        read=_crop,
    ),
    _of_preparation(
        name="low_pass",
        label="low pass",
        help='Cutoff wavelength of a Gaussian filter after ISO 16610-61, such as "2 um": shorter '
        "waves are removed.",
        otherwise="none",
        read=_length("low_pass"),
    ),
    _of_preparation(
        name="points",
        flag="--resample",
        control="resample",
        label="resample to",
        word="points",
        help="Points along the longer side to resample to; fewer are quicker to press, and lose "
        "the finest waves.",
        otherwise="as it is",
        kind=int,
        read=_whole_number,
    ),
    _of_preparation(
        name="lines",
        flag="--level-lines",
        label="level lines",
        help="What is taken from each line of a map along x where the instrument jumped from one "
        "to the next: its median, a straight line, or the median of differences from the line "
        "before. Steps between lines, and tilt and waves across them, go as well.",
        otherwise="nothing; rows that jump are told of",
        choices={
            "keep": (None, "keep"),
            "median": ("median", "median"),
            "tilt": ("tilt", "tilt"),
            "differences": ("differences", "differences"),
        },
    ),
    _of_preparation(
        name="remove_scars",
        control="scars",
        help="Remove scars and fill their points: short pieces of a line along x that stand off "
        "both lines beside it by more than five times the scatter.",
        otherwise="they stay",
        choices={"keep": (False, "keep"), "remove": (True, "remove and fill")},
    ),
    _of_preparation(
        name="remove_outliers",
        control="outliers",
        label="spikes",
        help="Remove spikes and fill their points: dust, or errors of the instrument, that differ "
        "from their neighbours by more than five times the scatter.",
        otherwise="they are only counted",
        choices={"keep": (False, "keep"), "remove": (True, "remove and fill")},
    ),
)
"""All fields, in the order of their groups' panels and of the form."""


def asked_in(values: Mapping[str, Any]) -> Iterator[tuple[str, tuple[Any, ...], dict[str, Any]]]:
    """Give the classes of what is asked, each with its arguments by place and by name."""
    for of in dict.fromkeys(each.of for each in FIELDS if each.is_asked):
        first, *others = (each for each in FIELDS if each.of == of)
        value = values.get(first.name)
        by_place = () if value is None else (value,)
        if first.separator and isinstance(value, list | tuple):
            by_place = tuple(value)
        other_values = {each: values.get(each.name) for each in others}
        by_name = {
            each.argument: value for each, value in other_values.items() if each.is_set(value)
        }
        if by_place or by_name:
            yield of, by_place, by_name


def names_by(word_of: Callable[[Field], str]) -> dict[str, str]:
    """Return what a caller calls the arguments, and the classes of what is asked."""
    names: dict[str, str] = {}
    for each in FIELDS:
        names[each.name] = word_of(each)
        if each.is_asked:
            names.setdefault(f"rl.{each.of}", names[each.name])  # of several, the first
    return {name: word for name, word in names.items() if word}
