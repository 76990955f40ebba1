"""A joint as a table for finite elements: pressure over overclosure, stiffness and conductances."""

from __future__ import annotations

import difflib
import textwrap
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from itertools import compress
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np

from roughline._version import __version__
from roughline.contact.curve import SurfaceCurve
from roughline.errors import InputError, StoreError
from roughline.errors.checks import refuse
from roughline.errors.public import public
from roughline.errors.words import called
from roughline.plot.curves import rising
from roughline.report.contact_report import settings_in_words
from roughline.report.contact_tables import solid_in_words
from roughline.topography.body import Line, Surface

if TYPE_CHECKING:
    from roughline.assessment.assessment import Assessment
    from roughline.computing.arrays import Real
    from roughline.question.question import Question

_COMMENT_WIDTH = 96  # letters of a line of comments
_LEAST_OVERCLOSURE_STEP = 1e-10  # that CalculiX tells apart, in the unit of its model
_LEAST_RELATIVE_STEP = 1e-8  # of the largest overclosure: nearer ones may be written alike
_EXPONENTIAL_WITHIN = 0.05  # of the pressure, within which an exponential law stands for the table
_FEWEST_LOADS = 3  # loads that an exponential law has to meet, as any two are met
_PROGRAM_BY_ENDING = {".csv": "csv", ".i": "moose"}  # by the file's ending; .inp is that of two
_STIFFNESS, _UNLOADING = "stiffness [Pa/m]", "unloading_stiffness [Pa/m]"
_HEAT = "thermal_conductance [W/(m^2 K)]"
_CURRENT = "electrical_conductance [S/m^2]"
_MEAN_GAP = "mean_gap [m]"


@dataclass(frozen=True, eq=False)
class _JointTable:
    """What a joint does under rising pressures, the first of them zero."""

    pressure: Real  # mean over the nominal area [Pa]
    overclosure: Real  # approach since first touch [m]
    columns: Mapping[str, Real]  # other quantities by their headings, in rows: (1 or 3, pressures)

    def over_pressure(self, heading: str) -> tuple[Real, Real] | None:
        """Pressures and values of a quantity as far as they are finite; None where it is not."""
        if heading not in self.columns:
            return None
        values = self.columns[heading][0]
        known = np.isfinite(values)  # full contact has no end
        return (self.pressure[known], values[known]) if known.sum() > 1 else None

    def pressure_over_overclosure(self, least: float = 0.0) -> tuple[Real, Real]:
        """Overclosures that are further than this from the one before, and their pressures."""
        least = max(least, _LEAST_RELATIVE_STEP * float(self.overclosure[-1]))
        rising = [0]
        for i in range(1, self.overclosure.size):
            if self.overclosure[i] - self.overclosure[rising[-1]] > least:
                rising.append(i)
        return self.overclosure[rising], self.pressure[rising]


@dataclass(frozen=True)
class _ExponentialLaw:
    """A pressure p = p_0 exp(d / length) over the overclosure d, as CalculiX knows it."""

    p_0: float  # at overclosure zero [Pa]
    length: float  # [m]
    error: float  # largest one of the pressure at the loads that it is of, relative
    lightest: float  # of these loads; they end with the largest of the table [Pa]
    excess: float  # its pressure over that of the table at the lightest load of all

    @classmethod
    def of(cls, table: _JointTable) -> _ExponentialLaw | None:
        """The law by least squares for as many of the largest loads as it is near to.

        It is that of the three largest where it is near to none of these; None for fewer loads.
        """
        overclosure, pressure = (
            each[1:] for each in table.pressure_over_overclosure(_LEAST_OVERCLOSURE_STEP)
        )
        found = None
        for first in range(pressure.size - _FEWEST_LOADS + 1):
            slope, start = np.polyfit(overclosure[first:], np.log(pressure[first:]), 1)
            ratio = np.exp(start + slope * overclosure) / pressure
            error = float(np.abs(ratio[first:] - 1).max())
            lightest, excess = float(pressure[first]), float(ratio[0])
            found = cls(float(np.exp(start)), float(1 / slope), error, lightest, excess)
            if found.is_near:
                break
        return found

    @property
    def is_near(self) -> bool:
        """Whether its pressures are those of the table."""
        return self.error <= _EXPONENTIAL_WITHIN

    @property
    def clearance(self) -> float:
        """Clearance at which the pressure is a hundredth of that at overclosure zero. [m]"""
        return self.length * float(np.log(100))


@public
def export_table(assessment: Assessment, table: str | Path) -> Path:
    """Write a joint as a table for a program of finite elements.

    It has, over the mean pressure, the overclosure, the stiffness per area and, where materials are
    known, the thermal and electrical conductances per area; all of them of the interface alone, so
    the body has to be pressed periodically or for a joint.

    Parameters
    ----------
    assessment : Assessment
        Of one map, under two loads or more, as :func:`roughline.assess` returns it.
    table : str or Path
        A file, after the name of the program that reads it: "calculix:joint.inp",
        "abaqus:joint.inp", "moose:joint.i" or "csv:joint.csv". The name may be left out before
        ".csv" and ".i". An existing file is replaced.

    Returns
    -------
    Path
        The file.

    Raises
    ------
    InputError
        For an unknown program, a folder that does not exist, a body that is a line or was pressed
        on a free half-space, or fewer than two loads on the loading branch.
    StoreError
        If the file cannot be written.

    Examples
    --------
    >>> import tempfile
    >>> import roughline as rl
    >>> surface = rl.SelfAffine(hurst=0.8, length=1e-3, rms_height=1e-6).surface(64, rng=7)
    >>> loads = ["1 MPa", "3 MPa", "10 MPa"]
    >>> question = rl.Question(surface, materials="steel,copper", loads=loads, periodic=True)
    >>> folder = tempfile.mkdtemp()
    >>> file = rl.export_table(rl.assess(question), f"abaqus:{folder}/joint.inp")
    >>> print([line for line in file.read_text().splitlines() if line[1] != "*"][0])
    *Surface Interaction, name=ROUGH_JOINT
    """
    program, file = checked_table(table, assessment.question)
    joint = _joint_table(assessment)
    lines = _PROGRAMS[program](joint, _remarks(assessment, joint))
    text = "\n".join([*lines, ""]).replace("²", "^2").replace("µ", "u")
    try:
        file.write_text(text, encoding="ascii", errors="replace")
    except OSError as error:
        raise StoreError(f"cannot write {file} ({error}): choose another place") from error
    return file


def checked_table(table: str | Path, question: Question) -> tuple[str, Path]:
    """Return the program and the file of a table, as far as they and a question allow it.

    Raises
    ------
    InputError
        If the program is not known, the folder does not exist, or answers to the question are not
        of an interface alone, or of one load.
    """
    text = str(table)
    program, colon, name = text.partition(":")
    if not colon or len(program) < 2 or "/" in program:  # a letter is that of a disk
        program, name = _PROGRAM_BY_ENDING.get(Path(text).suffix.lower(), ""), text
    if not program:
        refuse(
            "table",
            text,
            "which program is to read it? Give calculix:FILE, abaqus:FILE or moose:FILE; a name "
            "that ends in .csv is a plain table",
        )
    if program.lower() not in _PROGRAMS:
        near = difflib.get_close_matches(program.lower(), _PROGRAMS, 1)
        meant = f": did you mean {near[0]}:{name}?" if near else ""
        refuse("table", text, f"known programs are {', '.join(_PROGRAMS)}{meant}")
    file = Path(name)
    if not file.name or file.is_dir() or not file.parent.is_dir():
        refuse("table", text, "a file in a folder that exists is needed")
    _refuse_without_interface(question)
    return program.lower(), file


def _refuse_without_interface(question: Question) -> None:
    if question.is_of_several:
        raise InputError(f"{called('table')} is of one map; give one")
    if any(isinstance(body, Line) for body in question.bodies):
        raise InputError(
            f"{called('table')} needs a map: of a line scan the interface is not known apart from "
            "the bodies"
        )
    if not question.is_repeated:
        raise InputError(
            f"{called('table')} is of the interface alone, as the bodies themselves are in the "
            f"mesh: press the map periodically ({called('periodic', True)}), or for a joint "
            f"({called('rl.Joint')})"
        )
    if len({*question.loads, *question.depths}) == 1:
        raise InputError(f"{called('table')} needs two loads or more; give {called('loads')} again")


def _joint_table(assessment: Assessment) -> _JointTable:
    """The loads on the loading branch of an assessment, as they rise, after that of no load."""
    curve, body, known = assessment.curve_as_asked, assessment.body, assessment.intervals_as_asked
    if not isinstance(body, Surface):
        raise InputError("is of a line scan; a map is needed", "table")
    loading = rising(assessment.curve)[assessment.asked] & curve.converged & (curve.force > 0)
    pressure, first = np.unique(curve.force[loading] / assessment.area, return_index=True)
    chosen = np.flatnonzero(loading)[first]
    if chosen.size < 2:
        raise InputError(
            f"needs two loads or more that were solved on the loading branch; {chosen.size} of "
            f"{curve.status.size} is one: give more {called('loads')}",
            "table",
        )
    loading_ends, unloading_ends = (known.stiffness, known.unloading) if known else ((), ())
    columns = {_STIFFNESS: np.stack([curve.stiffness, *loading_ends]) / assessment.area}
    if isinstance(curve, SurfaceCurve) and curve.hardness is not None:
        unloading = np.stack([curve.unloading_stiffness, *unloading_ends])
        columns[_UNLOADING] = unloading / assessment.area
    columns |= _answer_columns(assessment)
    at_touch = {_MEAN_GAP: body.heights.max() - body.heights.mean()}
    return _JointTable(
        np.insert(pressure, 0, 0.0),
        np.insert(curve.depth[chosen], 0, 0.0),
        {
            heading: np.insert(each[:, chosen], 0, at_touch.get(heading, 0.0), axis=1)
            for heading, each in columns.items()
        },
    )


def _answer_columns(assessment: Assessment) -> dict[str, Real]:
    """Conductances per area and the mean gap over the loads that were asked for, in rows."""
    keys = {
        _HEAT: "thermal_conductance_per_area",
        _CURRENT: "constriction_resistance",
        _MEAN_GAP: "mean_gap",
    }
    answers = assessment.answers
    found = {heading: answers[key].rows for heading, key in keys.items() if key in answers}
    if _CURRENT in found:  # the reciprocal of its resistance, whose ends change places
        resistance = found[_CURRENT] * assessment.area * assessment.scale
        with np.errstate(divide="ignore"):
            found[_CURRENT] = 1 / np.concatenate([resistance[:1], resistance[:0:-1]])
    return found


def _remarks(assessment: Assessment, table: _JointTable) -> list[str]:
    """What a user of the table must know."""
    question, curve, heights = (
        assessment.question,
        assessment.curve_as_asked,
        assessment.body.heights,
    )
    remarks = [
        f"Contact of {question.name}, by roughline {__version__}.",
        "SI units: pressures in Pa, overclosures in m, stiffnesses in Pa/m, thermal conductances "
        "in W/(m^2 K), electrical ones in S/m^2. In mm, N and MPa: m times 1e3, Pa times 1e-6, "
        "Pa/m times 1e-9.",
        "Pressure is the mean over the nominal area, compression positive. Overclosure is the "
        "approach of the bodies, positive, from 0 where the highest points of the map touch; the "
        f"mean planes are {heights.max() - heights.mean():.4e} m apart there.",
        "All is of the interface alone, of the map in a periodic half-space: the give of the "
        "bodies themselves is that of the mesh.",
        "Elastic bodies: unloading goes back the same way."
        if curve.hardness is None
        else "The loading branch: points at the hardness yield and stay indented. On unloading the "
        "interface is stiffer, and conducts more at the same pressure.",
    ]
    pair = question.pair
    if pair is None:
        remarks.append(
            f"No materials are given, so conductances are not known; E* = {curve.E_star:.6g} Pa."
        )
    else:
        remarks.append(f"{solid_in_words(pair.first)}; {solid_in_words(pair.second)}.")
        if _HEAT in table.columns:
            remarks.append("Conductances are those of the solid spots alone, as in vacuum.")
        kinds = {_HEAT: "thermal", _CURRENT: "electrical"}
        if missing := [kind for heading, kind in kinds.items() if heading not in table.columns]:
            remarks.append(f"Not known of these materials: {' and '.join(missing)} conductance.")
    if unsolved := list(compress(assessment.headings, ~curve.converged)):
        remarks.append(f"Left out, as they were not solved: {', '.join(unsolved)}.")
    if others := int(curve.converged.sum()) - (table.pressure.size - 1):
        remarks.append(
            f"Left out, as they come after larger loads, or again: {others} of the loads."
        )
    remarks.append(f"Settings: {settings_in_words(assessment)}.")
    if (closed := np.isinf(table.columns[_STIFFNESS][0])).any():
        remarks.append(
            f"In full contact from {table.pressure[closed][0]:.4e} Pa on: the overclosure stays, "
            "and stiffness and conductances are infinite and left out."
        )
    return remarks


def _csv(table: _JointTable, remarks: Sequence[str]) -> list[str]:
    """A plain table; lines of comments begin with #."""
    headings, columns = ["pressure [Pa]", "overclosure [m]"], [table.pressure, table.overclosure]
    for heading, rows in table.columns.items():
        name, bracket, unit = heading.partition(" ")
        for end, values in zip(("", "_low", "_high"), rows, strict=False):
            headings.append(f"{name}{end}{bracket}{unit}")
            columns.append(values)
    lines = [",".join(map(_number, row)) for row in zip(*columns, strict=True)]
    return [*_comments("# ", remarks), ",".join(headings), *lines]


def _calculix(table: _JointTable, remarks: Sequence[str]) -> list[str]:
    """Surface interactions for CalculiX, as none of its types of contact reads all of a table."""
    overclosure, pressure = table.pressure_over_overclosure(_LEAST_OVERCLOSURE_STEP)
    conductance, law = table.over_pressure(_HEAT), _ExponentialLaw.of(table)
    heat = [] if conductance is None else ["*GAP CONDUCTANCE", *_pairs(conductance)]
    own = [
        "For CalculiX 2.20. Which interaction it reads as it is meant depends on the TYPE of the "
        "contact pair. Press the map further than the model will be: no type knows what comes "
        "beyond the last line, and all keep the last conductance there.",
        "ROUGH_JOINT is for NODE TO SURFACE, which keeps the last pressure beyond the last line, "
        "and for MORTAR and LINMORTAR, which go on with its last slope. SURFACE TO SURFACE takes "
        "the pressure of a table as zero. Under a table CalculiX lets no heat through.",
    ]
    if (near := table.overclosure.size - overclosure.size) > 0:
        own.append(
            f"{near} of the overclosures are left out, which are within "
            f"{_LEAST_OVERCLOSURE_STEP:g} of the one before: CalculiX does not tell such apart."
        )
    if _CURRENT in table.columns:
        own.append("It has no electrical contact, so that conductance is left out.")
    lines = [
        "*SURFACE INTERACTION,NAME=ROUGH_JOINT",
        "*SURFACE BEHAVIOR,PRESSURE-OVERCLOSURE=TABULAR",
        *_pairs((overclosure, pressure)),
    ]
    if heat:
        own.append(
            "ROUGH_JOINT_WITH_HEAT is for SURFACE TO SURFACE alone: in contact from NODE TO "
            "SURFACE CalculiX takes its last conductance at every pressure, without a word. Its "
            "pressure is in proportion to the overclosure, up to the last load. Where forces are "
            "given, pressure and conductance are right all the same, and the overclosure is not."
        )
        lines += [
            "*SURFACE INTERACTION,NAME=ROUGH_JOINT_WITH_HEAT",
            "*SURFACE BEHAVIOR,PRESSURE-OVERCLOSURE=LINEAR",
            _number(table.pressure[-1] / table.overclosure[-1]),
            *heat,
        ]
    own.append(_exponential_in_words(law, table))
    if law is not None and law.is_near:
        lines += [
            "*SURFACE INTERACTION,NAME=ROUGH_JOINT_EXPONENTIAL",
            "*SURFACE BEHAVIOR,PRESSURE-OVERCLOSURE=EXPONENTIAL",
            f"{_number(law.clearance)}, {_number(law.p_0)}",
            *heat,
        ]
    return [*_comments("** ", [*remarks, *own]), *lines]


def _exponential_in_words(law: _ExponentialLaw | None, table: _JointTable) -> str:
    """Say how near an exponential law is to a table, and from which load on; or why it is none."""
    none = "There is no ROUGH_JOINT_EXPONENTIAL, with heat in either type of penalty contact: "
    if law is None:
        return f"{none}it takes {_FEWEST_LOADS} loads."
    error = f"{100 * law.error:.2g} %"
    if not law.is_near:
        return (
            f"{none}at the {_FEWEST_LOADS} largest loads its pressure would be off by up to "
            f"{error}, and {100 * _EXPONENTIAL_WITHIN:g} % are allowed. Press loads that lie "
            "closer together."
        )
    text = (
        "ROUGH_JOINT_EXPONENTIAL is for NODE TO SURFACE and for SURFACE TO SURFACE, with heat in "
        "both; MORTAR and LINMORTAR take other pressures from it. Its conductance over the "
        "pressure is that of the table, and its pressure over the overclosure, at the loads from "
        f"{law.lightest:.4e} to {table.pressure[-1]:.4e} Pa, to {error}. Beyond, it goes on "
        f"exponentially. It presses by {law.p_0:.2e} Pa where the highest points touch. From NODE "
        f"TO SURFACE it begins {law.clearance:.2e} m before; from SURFACE TO SURFACE it is zero "
        "until there, and jumps to that."
    )
    if law.lightest > table.pressure[1]:
        text += f" At the lightest load its pressure is {law.excess:.2g} times that of the table."
    return text


def _abaqus(table: _JointTable, remarks: Sequence[str]) -> list[str]:
    """A surface interaction for Abaqus."""
    own = "For Abaqus. Beyond the last line it goes on with the last slope of the pressure."
    conductances = {
        _HEAT: "*Gap Conductance, pressure",
        _CURRENT: "*Gap Electrical Conductance, pressure",
    }
    lines = [
        *_comments("** ", [*remarks, own]),
        "*Surface Interaction, name=ROUGH_JOINT",
        "*Surface Behavior, pressure-overclosure=TABULAR",
        *_pairs(table.pressure_over_overclosure()),
    ]
    for heading, keyword in conductances.items():
        if (found := table.over_pressure(heading)) is not None:
            lines += [keyword, *_pairs(found)]
    return lines


def _moose(table: _JointTable, remarks: Sequence[str]) -> list[str]:
    """Functions for MOOSE; what they are over stands in the place of x."""
    own = (
        "For MOOSE, to be included in an input file. Beyond the ends a function keeps its last "
        "value. A material takes one over the contact pressure: type = "
        "CoupledValueFunctionMaterial, function = thermal_contact_conductance, v = "
        "contact_pressure, prop_name = gap_conductance. Another gives the derivative over the "
        "temperature, gap_conductance_dT, which is 0."
    )
    lines = [*_comments("# ", [*remarks, own]), "[Functions]"]
    named = {
        "contact_pressure_over_overclosure": table.pressure_over_overclosure(),
        "contact_stiffness": table.over_pressure(_STIFFNESS),
        "thermal_contact_conductance": table.over_pressure(_HEAT),
        "electrical_contact_conductance": table.over_pressure(_CURRENT),
    }
    for name, pair in named.items():
        if pair is not None:
            x, y = (" ".join(map(_number, each)) for each in pair)
            own_lines = [f"[{name}]", "  type = PiecewiseLinear", "  axis = x"]
            lines += [f"  {each}" for each in (*own_lines, f"  x = '{x}'", f"  y = '{y}'", "[]")]
    return [*lines, "[]"]


_PROGRAMS: dict[str, Callable[[_JointTable, Sequence[str]], list[str]]] = {
    "csv": _csv,
    "calculix": _calculix,
    "abaqus": _abaqus,
    "moose": _moose,
}


def _pairs(over: tuple[Real, Real]) -> list[str]:
    """Values, each before what it is over."""
    return [f"{_number(value)}, {_number(at)}" for at, value in zip(*over, strict=True)]


def _number(value: float) -> str:
    """A number in at most 20 letters, of which CalculiX reads no more."""
    return f"{value:.9e}"


def _comments(mark: str, remarks: Sequence[str]) -> list[str]:
    return [
        mark + line
        for remark in remarks
        for line in textwrap.wrap(remark, _COMMENT_WIDTH - len(mark))
    ]
