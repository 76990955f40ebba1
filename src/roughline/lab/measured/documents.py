"""What a page takes away: the report, the curve, its file, and code that does the same again."""

from __future__ import annotations

import re
import shlex
import shutil
from collections.abc import Sequence
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import Any

from roughline.assessment.assessment import Assessment
from roughline.assessment.fields import Field, asked_fields
from roughline.assessment.part import PartAssessment
from roughline.assessment.reading import Reading
from roughline.assessment.told import told_of
from roughline.errors.words import speaking
from roughline.lab.frames import frame
from roughline.lab.measured import controls as c
from roughline.lab.measured.answers import assessed
from roughline.lab.measured.kept import digest
from roughline.lab.measured.state import (
    CONTROLS,
    Said,
    loads_of,
    question_of,
    said_of,
    source_of,
    sources_of,
    told_in,
)
from roughline.lab.server.tasks import Arguments, Progress
from roughline.report.contact_figures import write_contact
from roughline.report.contact_report import write_contact_report
from roughline.report.part_report import write_part_report
from roughline.topography.preparation import Preparation

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
    told = told_in(said)
    for key, field in c.BY_CONTROL.items():
        value, flag = told.get(field.name), field.flag.partition(",")[0]
        if key not in said or value is None:
            continue
        if field.is_switch:
            words += [flag] if value else [flag.replace("--", "--no-")] * (None in _values(field))
        elif field.separator:
            words += [word for each in value for word in (flag, each)]
        else:
            words += [flag, f"{value:g}" if field.kind is float else said[key]]
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
    told = told_in(said) | {"whole_curve": bool(loads_of(said))}
    written = {
        name: value
        for name, value in told.items()
        if value is not None and value != [] and (value is not False or name == "grid_error")
    }
    question += [f"{name}={value!r}" for name, value in told_of("Question", written).items()]
    if asked := [each.in_python(written[each.name]) for each in asked_fields(written)]:
        question.append(f"ask=[{', '.join(asked)}]")
    for kind in (Reading, Preparation):
        usual = vars(kind())
        of_kind = told_of(kind.__name__, written).items()
        if given := [f"{name}={value!r}" for name, value in of_kind if value != usual[name]]:
            question.append(f"{kind.__name__.lower()}=rl.{kind.__name__}({', '.join(given)})")
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


def _values(field: Field) -> list[Any]:
    """Values that may be chosen."""
    return [value for value, _ in field.choices.values()]
