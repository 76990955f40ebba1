"""Pages of the handbook that are made of the code and of its tests, not written."""

from __future__ import annotations

import inspect
import json
import posixpath
import re
import shutil
from collections.abc import Iterable, Sequence
from pathlib import Path
from typing import Any

import numpy as np
import typer

import roughline as rl
from roughline import campaign, plot
from roughline.cli import app
from roughline.cli.help import PanelsFirst
from roughline.contact.quantities import QUANTITIES, SLIDING_QUANTITIES
from roughline.engineering import formulas, leak
from roughline.engineering.described import chemical_formulas
from roughline.engineering.fluids import fluids
from roughline.engineering.materials import materials
from roughline.engineering.rules import rules
from roughline.errors.earlier import EARLIER
from roughline.exact import adhesion, flow, indenters, lines, mdr, punch, westergaard
from roughline.texture.parameters import PROFILE_PARAMETERS, SURFACE_PARAMETERS
from roughline.topography.files.formats import FORMATS
from roughline.units import decimal

SECTIONS = {
    "Bodies": (
        *("Surface", "Line", "Profile", "read", "Missing", "write"),
        *("Preparation", "prepared", "facing"),
    ),
    "Spectra and roughness": (
        *("SelfAffine", "isotropic_spectrum", "profile_spectrum", "fit_self_affine", "roughness"),
        *("iso", "IsoParameters"),
    ),
    "Contact": (
        *(
            "press",
            "Solver",
            "press_scan",
            "press_creep",
            "Creep",
            "CreepCurve",
            "Curve",
            "SurfaceCurve",
            "LineCurve",
            "Fields",
            "Distribution",
            "Patches",
            "Measure",
        ),
        *("MEAN_GAP", "Status", "estimate", "Estimate", "set_threads", "theory"),
        *("effective_medium", "stickiness", "compare", "Comparison", "trust_map"),
    ),
    "The fluid in the gap": (
        *(
            "flow",
            "Flow",
            "Liquid",
            "Gas",
            "fluid_of",
            "hydraulic_aperture",
            "sealing_pressure",
            "SealingPressure",
        ),
        *("reopening", "Reopening"),
    ),
    "Half-spaces and contact laws": (
        *("HalfSpace", "Homogeneous", "Layered", "TwoBodies", "ContactLaw", "Unilateral"),
        *("Yielding", "Dugdale", "Exponential", "JKR"),
    ),
    "Friction": (*("Friction", "SlidingCurve", "SlidingFields", "SlidingLineCurve", "cycle"),),
    "Questions and answers": (
        *("Question", "Reading", "assess", "assess_body", "assess_part", "Assessment"),
        *("Joint", "Ultrasound", "Theories", "Adhesion", "Fluid", "Shear"),
        *("export_table", "PartAssessment", "material", "Material", "Coated", "contact_modulus"),
        *("Rule", "Symbol", "rules", "own_words"),
        *("Cause", "OtherBodies", "Spread", "causes"),
    ),
    "Statistics": ("average", "relative_difference", "fit_power_law", "PowerLaw", "find_window"),
    "Errors": (
        *("RoughlineError", "InputError", "UnitError", "ConvergenceError", "StoreError"),
        *("ClusterError", "Interrupted", "ContinuumWarning", "PreparationWarning", "UnitWarning"),
        "LostCasesWarning",
    ),
}
"""Public names in the order in which people meet them."""

SOURCES = {
    "made/materials.md": "../src/roughline/engineering/materials.csv",
    "made/fluids.md": "../src/roughline/engineering/fluids.csv",
    "made/formats.md": "../src/roughline/topography/files/formats.py",
    "made/quantities.md": "../src/roughline/contact/quantities.py",
    "made/answers.md": "../src/roughline/engineering/rules",
    "made/texture.md": "../src/roughline/texture/parameters.py",
    "made/commands.md": "../src/roughline/cli",
    "made/names.rst": "../src/roughline/__init__.pyi",
    "made/validation.md": "validation.json",
    "made/findings.md": "../findings/README.md",
    "made/earlier.md": "../src/roughline/errors/earlier.py",
    "made/gallery/index.rst": "gallery",
}
"""Pages that are made, and what they are made of, from this folder; examples have their files.

Links lead to what is in the repository, where pages are read as they are; in the handbook, they
lead to the pages that are made.
"""

FINDINGS = "https://github.com/roughline/roughline/blob/main/findings"

_LINK = re.compile(r"(?<=\]\()[^)\s:#]+(?=\))")

GALLERY = (
    "first_contact",
    "both_models",
    "power_law",
    "square_punch",
    "hertz",
    "two_resolutions",
    "area_and_grid",
    "periodic_and_free",
    "roll_off",
    "measured_map",
    "line_scan",
    "two_rough_bodies",
    "conductance",
    "loading_and_unloading",
    "branches_of_adhesion",
    "when_roughness_kills_adhesion",
    "rubber_over_time",
    "where_the_fluid_goes",
    "leak_over_load",
    "which_way_it_leaks",
    "thin_gasket",
    "how_thick_is_thick",
    "line_seal",
    "ultrasound",
    "partial_slip",
    "loop_of_a_ball",
    "where_it_slips",
    "two_materials",
    "theories",
    "why_not_better",
    "campaign_on_a_cluster",
    "trust",
)
"""Examples in the order in which people meet them."""

CONSTANTS = {"PAPER_PUNCH", "EXACT_PUNCH"}

FILES_OF_NAMES = {
    f"roughline.{name}": f"roughline.{name}-function"
    for name in rl.__all__
    if name != name.capitalize() and name.capitalize() in rl.__all__
}
"""Pages whose names would differ in capitals alone, which some systems take for the same file."""


def write_pages(source: str | Path) -> None:
    """Write all made pages into the folder ``made`` of the handbook's source."""
    folder = Path(source) / "made"
    folder.mkdir(exist_ok=True)
    shutil.rmtree(folder / "names", ignore_errors=True)  # pages of names that are no more
    pages = {
        "names.rst": page_of_names(),
        "commands.md": page_of_commands(),
        "materials.md": page_of_materials(),
        "fluids.md": page_of_fluids(),
        "formats.md": page_of_formats(),
        "quantities.md": page_of_quantities(),
        "answers.md": page_of_answers(),
        "texture.md": page_of_texture(),
        "validation.md": page_of_validation(Path(source) / "validation.json"),
        "earlier.md": page_of_earlier(),
        "findings.md": page_of_findings(Path(source).parent / "findings"),
    }
    for name, text in pages.items():
        path = folder / name
        if not path.exists() or path.read_text("utf-8") != text:
            path.write_text(text, "utf-8")


def place_in_gallery(file: str) -> int:
    """Return the place of an example among the others."""
    return GALLERY.index(file.removesuffix(".py"))


def page_of_names() -> str:
    """The public names of Python, one page each."""
    left_out = set(rl.__all__) - {"__version__"} - CONSTANTS
    left_out -= {name for names in SECTIONS.values() for name in names}
    if left_out:
        raise ValueError(f"SECTIONS in {Path(__file__).name} lacks {', '.join(sorted(left_out))}")
    parts = ["Names in Python\n===============\n"]
    parts += [_summary(heading, "roughline", names) for heading, names in SECTIONS.items()]
    parts += [
        _summary("Pictures", "roughline.plot", plot.__all__),
        _summary("Campaigns", "roughline.campaign", campaign.__all__),
        _summary("Formulas", "roughline.engineering.formulas", _functions(formulas)),
        _summary("Formulas of a leak", "roughline.engineering.leak", _functions(leak)),
        *(
            _summary(f"Exact solutions: {_title(module)}", module.__name__, _public(module))
            for module in (punch, indenters, lines, mdr, westergaard, adhesion, flow)
        ),
    ]
    return "\n".join(parts)


def page_of_commands() -> str:
    """The commands with their options, as the program has them."""
    parts = ["# Commands\n"]
    for name, command in _commands(typer.main.get_command(app)):
        if isinstance(command, PanelsFirst):
            command.fill_lists()
        context = command.make_context(name, [], resilient_parsing=True)
        parts += [f"## {name}\n", f"{(command.help or '').strip()}\n"]
        rows = [_option(param) for param in command.get_params(context)]
        parts.append(table(("option", "meaning"), rows))
    parts.append(
        "Exit codes: 0 done; 1 a load did not converge, a case failed, or one of several maps was "
        "refused; 2 the input cannot be used, and one line says why; 130 interrupted, with "
        "everything finished kept.\n"
    )
    return "\n".join(parts)


def page_of_materials() -> str:
    """The table of materials with its sources."""
    chemical = chemical_formulas("materials.csv")
    rows = [
        (
            each.name,
            chemical[each.name],
            *(_value(value) for value in (each.E / 1e9, each.nu)),
            _value(None if each.hardness is None else each.hardness / 1e9),
            *(_value(value) for value in (each.resistivity, each.conductivity, each.density)),
            each.source,
        )
        for each in sorted(materials().values(), key=lambda each: each.name)
    ]
    header = (
        *("name", "formula", "E [GPa]", "ν", "hardness [GPa]", "resistivity [Ω m]"),
        *("conductivity [W/(m K)]", "density [kg/m³]", "source"),
    )
    own = (
        'Names are read in any case; of formulas the capitals count: `"TiN"` is titanium nitride, '
        '`"tin"` the metal, and `"TIN"` is refused, as it may be both.\n\n'
        'Other values are given as `--materials "E=210 GPa nu=0.31 hardness=12 GPa, steel"`, or as '
        "`rl.Material(...)`. [A new line of this table](../tutorials/extend.md#add-a-material) "
        "changes the package.\n"
    )
    return f"# Materials\n\n{_comments('materials')}\n\n{own}\n{table(header, rows)}"


def page_of_fluids() -> str:
    """The table of fluids with its sources."""
    chemical = chemical_formulas("fluids.csv")
    rows = [
        (
            each.name,
            chemical[each.name],
            _value(each.viscosity * 1e3),
            *(_value(value) for value in _of_gas(each)),
            each.source,
        )
        for each in sorted(fluids().values(), key=lambda each: each.name)
    ]
    header = (
        *("name", "formula", "viscosity [mPa s]", "molar mass [g/mol]", "conductivity [W/(m K)]"),
        *("mean free path at 1 bar [nm]", "source"),
    )
    own = (
        '`rl.fluid_of` reads a name, such as `"water at 60 °C"`, or one with other values, such as '
        '`"air viscosity=23 uPa s temperature=400 K"`; `rl.Liquid(...)` and `rl.Gas(...)` are '
        "fluids of one's own.\n"
    )
    return f"# Fluids\n\n{_comments('fluids')}\n\n{own}\n{table(header, rows)}"


def page_of_formats() -> str:
    """The formats that are read, by whom, and what of each."""
    rows = [
        (
            each.name,
            " ".join(f"`{suffix}`" for suffix in each.suffixes),
            each.written_by,
            each.is_read,
            each.is_not_read,
            "SurfaceTopography" if each.reader else "roughline",
            each.compared,
        )
        for each in sorted(FORMATS, key=lambda each: each.name.lower())
    ]
    header = ("format", "files", "written by", "read", "not read", "reader", "compared with")
    own = (
        "A file is known by what is in it; its name counts where a format has no mark. `roughline "
        "info` says who read a file, as which format, and what was corrected. Other formats of "
        "SurfaceTopography are read as it reads them.\n"
    )
    return f"# Formats of files\n\n{own}\n{table(header, rows)}"


def page_of_quantities() -> str:
    """The output quantities of a curve."""
    rows = [
        (
            f"`{each.name}`",
            f"${each.symbol}$" if each.symbol else "",
            each.meaning,
            each.dimension or "",
            ", ".join(each.dims),
        )
        for each in (*QUANTITIES.values(), *SLIDING_QUANTITIES)
    ]
    header = ("name", "symbol", "meaning", "unit", "over")
    return f"# Output quantities of a curve\n\n{table(header, rows)}"


def page_of_texture() -> str:
    """The parameters of surface texture, of surfaces and of profiles."""
    parts = [
        "# Parameters of surface texture\n",
        "What `rl.iso` returns; [how they are defined](../how-to/iso.md) where programs differ.\n",
    ]
    header = ("name", "meaning", "unit", "clause", "tells of")
    for heading, declared in (("Surfaces", SURFACE_PARAMETERS), ("Profiles", PROFILE_PARAMETERS)):
        standard = next(iter(declared.values())).standard
        rows = [
            (
                f"`{each.name}`",
                each.meaning + (f" (before: `{each.formerly}`)" if each.formerly else ""),
                each.dimension,
                each.clause,
                each.group,
            )
            for each in declared.values()
        ]
        parts += [f"## {heading}: {standard}\n", table(header, rows)]
    return "\n".join(parts)


def page_of_answers() -> str:
    """The answers for two materials, by their rules."""
    rows = [
        (
            f"`{each.key}`",
            each.name,
            f"`{each.symbol}`",
            each.unit,
            f"`{each.formula}`",
            each.validity,
            each.source,
        )
        for each in rules
    ]
    header = ("key", "name", "symbol", "unit", "formula", "holds", "source")
    own = "[A rule of one's own](../tutorials/extend.md#add-an-answer) adds an answer to these.\n"
    return f"# Answers for two materials\n\n{own}\n{table(header, rows)}"


def page_of_validation(path: Path) -> str:
    """Errors against exact solutions, as the tests found them."""
    parts = [
        "# Beside exact solutions\n",
        "Relative errors that the tests find, by the points along a side. The rate is the power of "
        "1/n with which they fall, by least squares over three grids or more. None is told where "
        "an error does not fall from grid to grid: it changes its sign there, or hangs on a few "
        "cells at the outline. `make validation` writes the errors, and each test holds its own "
        "to them.\n",
    ]
    rows = json.loads(path.read_text("utf-8"))
    for heading, folder in (("Full model", "halfspace"), ("Reduced model", "reduction")):
        of_model = [each for each in rows if each["test"].startswith(f"tests/{folder}/")]
        files = sorted({each["test"].partition("::")[0] for each in of_model})
        parts += [f"## {heading}\n", f"Tests in {', '.join(f'`{file}`' for file in files)}.\n"]
        header = ("solution", "quantity", "points: error", "rate", "test")
        parts.append(table(header, map(_validated, of_model)))
    return "\n".join(parts)


def page_of_earlier() -> str:
    """Spellings of version 0.3 that are gone, each with the one that says the same now."""
    rows = [(f"`{old}`", f"`{new}`") for old, new in sorted(EARLIER.items())]
    own = "Each is refused in one line that tells the new one.\n"
    return f"# Spellings of 0.3 that are gone\n\n{own}\n{table(('before', 'now'), rows)}"


FINDING = re.compile(
    r"#!/usr/bin/env bash\n"
    r"# (?P<title>[^\n]+)\n#\n"
    r"# One would guess (?P<guess>.+?)\n"
    r"# What happens(?:, (?P<where>[^\n]+(?:\n# [^ ][^\n]+)*))?:\n"
    r"(?P<happens>(?:#   [^\n]+\n)+)"
    r"# Output seen(?: \([^)]+\))?:\n(?P<output>(?:#   [^\n]+\n)+)"
    r"# Why it matters: (?P<why>.+?)\n"
    r"# In roughline: (?P<ours>.+?)\n"
    r"set -euo pipefail\n",
    re.DOTALL,
)
"""The head of a script in ``findings/``."""


def page_of_findings(folder: Path) -> str:
    """What programs of the field do where a good guess goes wrong, from the heads of scripts."""
    scripts = sorted(folder.glob("*.sh"))
    parts = [
        "# What other programs do otherwise than one would guess\n",
        f"{len(scripts)} of them, each run on valid input in the versions that are named, and no "
        "others. Many are as the programs' own pages say. The scripts print what they saw, and "
        "fail if it has changed: `bash findings/NAME.sh`.\n",
    ]
    for script in scripts:
        head = FINDING.match(script.read_text("utf-8"))
        if head is None:
            raise ValueError(f"{script.name}: its head is not of the form in CONTRIBUTING.md")
        said = {
            name: re.sub(r"\s*\n#\s*|\s+", " ", text or "")
            for name, text in head.groupdict().items()
        }
        happens = said["happens"].strip("# ")
        parts += [
            f"## {said['title'].removesuffix('.')}\n",
            f"**One would guess** {said['guess']}\n",
            f"**What happens**{', ' * bool(said['where'])}{said['where']}: {happens}\n",
            f"**Why it matters**: {said['why']}\n",
            f"**In roughline**: {said['ours']} ([`{script.name}`]({FINDINGS}/{script.name}))\n",
        ]
    return "\n".join(parts).replace("<", "\\<")


def table(header: Sequence[str], rows: Iterable[Sequence[str]]) -> str:
    """Return a table in Markdown."""
    first, *others = (
        f"| {' | '.join(cell.replace('|', chr(92) + '|') for cell in line)} |\n"
        for line in (header, *rows)
    )
    return "".join([first, f"|{'---|' * len(header)}\n", *others])


def _validated(row: Any) -> tuple[str, ...]:
    test = row["test"].partition("::")[2].removeprefix("test_")
    errors = row["errors"]
    listed = "; ".join(_unbroken(f"{grid}: {error:.1e}") for grid, error in errors.items())
    sizes = [int(grid) for grid in errors if grid.isdecimal()]
    values = list(errors.values())
    rate = ""
    if len(sizes) >= 3 and (np.diff(values) < 0).all():
        rate = f"{-np.polyfit(np.log(sizes), np.log(values), 1)[0]:.1f}"
    return row["solution"], row["quantity"], listed, rate, test.replace("_", " ")


def _unbroken(text: str) -> str:
    return text.replace(" ", "\N{NO-BREAK SPACE}").replace("-", "\N{NON-BREAKING HYPHEN}")


def _summary(heading: str, module: str, names: Iterable[str]) -> str:
    listed = "\n".join(f"   {name}" for name in names)
    return (
        f"{heading}\n{'-' * len(heading)}\n\n.. currentmodule:: {module}\n\n"
        f".. autosummary::\n   :toctree: names\n   :nosignatures:\n\n{listed}\n"
    )


def _public(module: Any) -> list[str]:
    return [
        name
        for name, value in vars(module).items()
        if not name.startswith("_") and getattr(value, "__module__", None) == module.__name__
    ]


def _functions(module: Any) -> list[str]:
    return [name for name in _public(module) if inspect.isfunction(getattr(module, name))]


def _title(module: Any) -> str:
    return module.__name__.rpartition(".")[2]


def _commands(command: Any, name: str = "roughline") -> Iterable[tuple[str, Any]]:
    inner = getattr(command, "commands", None)
    if inner is None:
        yield name, command
        return
    for key, each in inner.items():
        yield from _commands(each, f"{name} {key}")


def _option(param: Any) -> tuple[str, str]:
    names = ", ".join(f"`{name}`" for name in (*param.opts, *param.secondary_opts))
    text = re.sub(r"(--[a-z-]+)", r"`\1`", re.sub(r"\s+", " ", param.help or ""))
    shown = param.default not in (None, False, (), []) and "default" not in text
    return names, f"{text} [default: {param.default}]" if shown else text


def _comments(table_of: str) -> str:
    """What stands above a table of the package."""
    path = Path(rl.__file__).parent / "engineering" / f"{table_of}.csv"
    lines = path.read_text("utf-8").splitlines()
    return " ".join(line.lstrip("# ").strip() for line in lines if line.startswith("#"))


def _of_gas(fluid: rl.Liquid | rl.Gas) -> tuple[float | None, ...]:
    """Molar mass [g/mol], conductivity [W/(m K)] and mean free path at 1 bar [nm] of a gas."""
    if isinstance(fluid, rl.Liquid):
        return None, None, None
    return 1e3 * fluid.molar_mass, fluid.conductivity, 1e9 * fluid.mean_free_path(1e5)


def _value(value: float | None) -> str:
    return "" if value is None else decimal(value, 4)


def with_made_pages(page: str, text: str) -> str:
    """Return the text of a page, named from this folder, with links to pages that are made."""
    made = {source: name for name, source in SOURCES.items()}
    made |= {f"gallery/{name}.py": f"made/gallery/{name}.rst" for name in GALLERY}
    folder = posixpath.dirname(page)

    def link(found: re.Match[str]) -> str:
        source = posixpath.normpath(posixpath.join(folder, found[0]))
        return posixpath.relpath(made[source], folder or ".") if source in made else found[0]

    return _LINK.sub(link, text)
