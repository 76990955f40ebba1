"""What a page takes away: the report, the curve, its file, and code that does the same again."""

from __future__ import annotations

import re
import shlex
import shutil
from collections.abc import Sequence
from dataclasses import fields
from pathlib import Path
from tempfile import TemporaryDirectory

from roughline.assessment.assessment import Assessment
from roughline.assessment.part import PartAssessment
from roughline.assessment.reading import Reading
from roughline.errors.words import speaking
from roughline.lab.frames import frame
from roughline.lab.measured.answers import assessed
from roughline.lab.measured.kept import digest
from roughline.lab.measured.state import (
    Arguments,
    Said,
    loads_of,
    preparation_of,
    question_of,
    reading_of,
    said_of,
    source_of,
    sources_of,
    theories_of,
)
from roughline.lab.measured.words import CONTROLS
from roughline.lab.server.tasks import Progress
from roughline.report.contact_figures import write_contact
from roughline.report.contact_report import write_contact_report
from roughline.report.part_report import write_part_report
from roughline.topography.preparation import Preparation

_FLAGS = {
    "unit": "--unit",
    "channel": "--channel",
    "size": "--size",
    "fill": "--fill",
    "tilt": "--tilt",
    "blur": "--blur",
    "tip_radius": "--tip-radius",
    "crop": "--crop",
    "low_pass": "--low-pass",
    "resample": "--resample",
    "friction": "--friction",
    "frequency": "--frequency",
    "hardness": "--hardness",
    "joint_area": "--joint-area",
}
_WRITTEN = (
    *("report.html", "report.pdf", "curve.nc", "curve.pdf", "contact.pdf"),
    *("answers.pdf", "maps.pdf", "all-maps.zip"),
)


@speaking(CONTROLS)
def report(arguments: Arguments, progress: Progress) -> bytes:
    """Write the report and the curve to the folder of the session."""
    said = said_of(arguments)
    result = assessed(arguments, progress)
    folder = Path(arguments["session"]["folder"]) / "results"
    folder.mkdir(parents=True, exist_ok=True)
    name = "part" if isinstance(result, PartAssessment) else result.question.name
    stem = re.sub(r"[^\w.-]+", "_", Path(name).stem, flags=re.ASCII)[:40]
    files = {}
    with TemporaryDirectory(dir=folder) as made:
        begun = Path(made) / "all"
        _write(result, begun, as_command(said, _names(said, arguments)))
        if isinstance(result, PartAssessment):
            shutil.move(shutil.make_archive(f"{made}/all-maps", "zip", begun), begun)
        for name in _WRITTEN:
            if (begun / name).exists():
                place = f"{stem}-{digest(sorted(said.items()))[:6]}-{name}"
                shutil.move(begun / name, folder / place)
                files[name] = place
    return frame({"files": files})


def _write(result: Assessment | PartAssessment, folder: Path, command: str) -> None:
    """Write the report, or the curve alone where there are no answers."""
    if isinstance(result, PartAssessment):
        write_part_report(result, folder, command)
    elif result.answers and result.question.loads:
        write_contact_report(result, folder, command)
    else:
        write_contact(result, folder)


def _names(said: Said, arguments: Arguments) -> list[str]:
    """What the files are called by who brought them."""
    return [each.name for each in sources_of(said, arguments["session"])]


@speaking(CONTROLS)
def code(arguments: Arguments, progress: Progress) -> bytes:
    """Lines of Python, or a command, that answer the same question for the file."""
    said = said_of(arguments)
    question_of(said, source_of(said, arguments["session"]))  # refuses what cannot be asked
    write = as_python if arguments.get("which") == "python" else as_command
    return frame({"text": write(said, _names(said, arguments))})


def as_command(said: Said, names: Sequence[str]) -> str:
    """The command that writes the same report on one file, or on several maps of a part."""
    words = ["roughline", "press", *names]
    if said.get("bodies") == "modulus":
        words += ["--modulus", said["E"]]
    else:
        words += ["--materials", f"{said['first']}, {said['second']}"]
    for load in loads_of(said):
        words += ["--load", load]
    if said.get("boundary") == "periodic":
        words.append("--periodic")
    for key, flag in _FLAGS.items():
        if key in said:
            words += [flag, said[key]]
    for theory in theories_of(said):
        words += ["--theory", theory]
    if (wanted := said.get("grid_error")) in ("yes", "no"):
        words.append("--grid-error" if wanted == "yes" else "--no-grid-error")
    for key in ("pixels", "trend"):
        if said.get(key, "default") != "default":
            words += [f"--{key}", said[key]]
    if said.get("outliers") == "remove":
        words.append("--remove-outliers")
    if said.get("elastic") == "yes":
        words.append("--elastic")
    if "most_missing" in said:
        words += ["--max-missing", f"{reading_of(said, None).most_missing:g}"]
    has_report = said.get("bodies") != "modulus" and loads_of(said)
    words += ["--report", "report"] if has_report else ["--out", "curve"]
    return shlex.join(words)


def as_python(said: Said, names: Sequence[str]) -> str:
    """Lines that answer the same question."""
    is_part = len(names) > 1
    question = [f"[{', '.join(map(repr, names))}]" if is_part else repr(names[0])]
    if said.get("bodies") == "modulus":
        question.append(f"E_star={said['E']!r}")
    else:
        question.append(f"materials=({said['first']!r}, {said['second']!r})")
    if loads := loads_of(said):
        question += [f"loads=[{', '.join(map(repr, loads))}]", "whole_curve=True"]
    question += ["periodic=True"] if said.get("boundary") == "periodic" else []
    question += [f"friction={float(said['friction'])!r}"] if "friction" in said else []
    question += ["elastic=True"] if said.get("elastic") == "yes" else []
    for key in ("hardness", "joint_area"):
        question += [f"{key}={said[key]!r}"] if key in said else []
    question += [f"frequency={said['frequency']!r}"] if "frequency" in said else []
    if theories := theories_of(said):
        question.append(f"theories=[{', '.join(map(repr, theories))}]")
    if (wanted := said.get("grid_error")) in ("yes", "no"):
        question.append(f"grid_error={wanted == 'yes'}")
    reading, preparation = reading_of(said, None), preparation_of(said)
    if reading != Reading():
        question.append(f"reading=rl.Reading({_fields(reading)})")
    if preparation is not None:
        question.append(f"preparation=rl.Preparation({_fields(preparation)})")
    values = "answer.mean, answer.scatter" if is_part else "answer.values"
    end = "" if is_part else 'result.curve.write("curve.nc")\n'
    arguments = "".join(f"        {each},\n" for each in question)
    return f"""import roughline as rl

result = rl.assess(
    rl.Question(
{arguments}    )
)
for note in result.remarks:
    print("note:", note)
for answer in result.answers.values():
    print(answer.name, answer.symbol, {values}, answer.unit, answer.low, answer.high)
{end}"""


def _fields(value: Reading | Preparation) -> str:
    """What differs from the default, as arguments."""
    default = type(value)()
    return ", ".join(
        f"{each.name}={getattr(value, each.name)!r}"
        for each in fields(value)
        if getattr(value, each.name) != getattr(default, each.name)
    )
