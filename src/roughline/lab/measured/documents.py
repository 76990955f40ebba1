"""What a page takes away: the report, the curve, its file, and code that does the same again."""

from __future__ import annotations

import re
import shlex
import shutil
from collections.abc import Mapping, Sequence
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import Any

from roughline.assessment.assessment import Assessment
from roughline.assessment.fields import FIELDS, asked_in
from roughline.assessment.from_fields import arguments_for
from roughline.assessment.part import PartAssessment
from roughline.assessment.reading import Reading
from roughline.errors.words import speaking
from roughline.lab.controls import is_number
from roughline.lab.frames import frame
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
    """Lines of Python, or commands, that answer the same question for the file."""
    said, is_python = said_of(arguments), arguments.get("which") == "python"
    question_of(said, source_of(said, arguments["session"]))  # refuses what cannot be asked
    text = (as_python if is_python else as_command)(said, _names(said, arguments))
    if key := said.get("example"):
        text = (_EXAMPLE_IN_PYTHON if is_python else _EXAMPLE_IN_COMMAND).format(key) + text
    return frame({"text": text})


_EXAMPLE_IN_PYTHON = """from pathlib import Path

from roughline.lab.measured.examples import path_of

path_of("{}", Path())  # writes the file of the example

"""
_EXAMPLE_IN_COMMAND = "python -m roughline.lab.measured.examples {}\n"


def _told(said: Said) -> dict[str, Any]:
    """All that is told, by the names of fields, as it was typed."""
    materials = said.get("first"), said.get("second")
    by_modulus = said.get("bodies") == "modulus"
    return ({"E_star": said["E"]} if by_modulus else {"materials": materials}) | told_in(said)


def as_command(said: Said, names: Sequence[str]) -> str:
    """The command that writes the same report on one file, or on several maps of a part."""
    words = ["roughline", "press", *(f"./{name}" if name[0] == "-" else name for name in names)]
    told = _told(said)
    for field in FIELDS:
        value, text = told.get(field.name), said.get(field.control, "")
        if field.name == "materials" and value:
            text = ", ".join(value)
        elif field.name == "E_star":
            text = said.get("E", "")
        elif field.kind is float and not is_number(text):
            text = str(value)
        if value is not None and text:
            words += field.in_command(value, text)
    if "materials" in told and told.get("loads"):
        words += ["--report", "report"]
    else:
        words += ["--out", "curve"]
    return shlex.join(words)


def _in_python(of: str, by_place: Sequence[Any], by_name: Mapping[str, Any]) -> str:
    """What is asked, as Python: rl.Friction(0.3)."""
    given = [*map(repr, by_place), *(f"{name}={value!r}" for name, value in by_name.items())]
    return f"rl.{of}({', '.join(given)})"


def as_python(said: Said, names: Sequence[str]) -> str:
    """Lines that answer the same question."""
    is_part = len(names) > 1
    told = _told(said) | {"whole_curve": bool(loads_of(said))}
    written = {each.name: told[each.name] for each in FIELDS if each.is_set(told.get(each.name))}
    question = [f"[{', '.join(map(repr, names))}]" if is_part else repr(names[0])]
    question += [f"{name}={value!r}" for name, value in arguments_for("Question", written).items()]
    if asked := [_in_python(*each) for each in asked_in(written)]:
        question.append(f"ask=[{', '.join(asked)}]")
    for kind in (Reading, Preparation):
        usual = vars(kind())
        of_kind = arguments_for(kind.__name__, written).items()
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
