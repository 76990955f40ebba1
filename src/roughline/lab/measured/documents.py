"""What a page takes away: the report, the curve, its file, and code that does the same again."""

from __future__ import annotations

import re
import shlex
import shutil
from collections.abc import Mapping, Sequence
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import Any

from roughline.assessment.part import PartAssessment
from roughline.errors.words import speaking
from roughline.lab.controls import is_number
from roughline.lab.frames import digest, frame
from roughline.lab.measured.answers import assessed
from roughline.lab.measured.state import (
    PAGE_WORDS,
    ControlTexts,
    control_texts,
    field_values,
    first_source,
    page_question,
    page_sources,
    typed_loads,
)
from roughline.lab.server.tasks import Arguments, Progress
from roughline.question.fields import FIELDS, asked_in
from roughline.question.from_fields import arguments_for
from roughline.question.reading import Reading
from roughline.report.contact_figures import write_contact
from roughline.report.contact_report import write_contact_report
from roughline.report.part_report import write_part_report
from roughline.topography.missing import Missing
from roughline.topography.preparation import Preparation

_WRITTEN = (
    *("report.html", "report.pdf", "curve.nc", "curve.pdf", "contact.pdf"),
    *("answers.pdf", "maps.pdf", "all-maps.zip"),
)


@speaking(PAGE_WORDS)
def report(arguments: Arguments, progress: Progress) -> bytes:
    """Write the report and the curve, or the curve alone without answers, for the session."""
    texts = control_texts(arguments)
    result = assessed(arguments, progress)
    folder = Path(arguments["session"]["folder"]) / "results"
    folder.mkdir(parents=True, exist_ok=True)
    name = "part" if isinstance(result, PartAssessment) else result.question.name
    stem = re.sub(r"[^\w.-]+", "_", Path(name).stem, flags=re.ASCII)[:40]
    files = {}
    with TemporaryDirectory(dir=folder) as made:
        begun = Path(made) / "all"
        command = as_command(texts, _names(texts, arguments))
        if isinstance(result, PartAssessment):
            write_part_report(result, begun, command)
            shutil.move(shutil.make_archive(f"{made}/all-maps", "zip", begun), begun)
        elif result.answers and result.question.loads:
            write_contact_report(result, begun, command)
        else:
            write_contact(result, begun)
        for name in _WRITTEN:
            if (begun / name).exists():
                place = f"{stem}-{digest(sorted(texts.items()))[:6]}-{name}"
                shutil.move(begun / name, folder / place)
                files[name] = place
    return frame({"files": files})


def _names(texts: ControlTexts, arguments: Arguments) -> list[str]:
    """What the files are called by who brought them."""
    return [each.name for each in page_sources(texts, arguments["session"])]


@speaking(PAGE_WORDS)
def code(arguments: Arguments, progress: Progress) -> bytes:
    """Lines of Python, or commands, that answer the same question for the file."""
    texts, is_python = control_texts(arguments), arguments.get("which") == "python"
    page_question(texts, first_source(texts, arguments["session"]))  # refuses what cannot be asked
    text = (as_python if is_python else as_command)(texts, _names(texts, arguments))
    if key := texts.get("example"):
        text = (_EXAMPLE_IN_PYTHON if is_python else _EXAMPLE_IN_COMMAND).format(key) + text
    return frame({"text": text})


_EXAMPLE_IN_PYTHON = """from pathlib import Path

from roughline.lab.measured.examples import write_example

write_example("{}", Path())  # writes the file of the example

"""
_EXAMPLE_IN_COMMAND = "python -m roughline.lab.measured.examples {}\n"


def _typed_values(texts: ControlTexts) -> dict[str, Any]:
    """All that is set, by the names of fields, as it was typed."""
    by_modulus, pair = texts.get("bodies") == "modulus", (texts.get("first"), texts.get("second"))
    return ({"E_star": texts["E"]} if by_modulus else {"materials": pair}) | field_values(texts)


def as_command(texts: ControlTexts, names: Sequence[str]) -> str:
    """The command that writes the same report on one file, or on several maps of a part."""
    words = ["roughline", "press", *(f"./{name}" if name[0] == "-" else name for name in names)]
    values = _typed_values(texts)
    bodies = {"E_star": texts.get("E", ""), "materials": ", ".join(values.get("materials", ()))}
    for field in FIELDS:
        text = bodies.get(field.name) or texts.get(field.control, "")
        if (value := values.get(field.name)) is not None and text:
            is_read = field.kind is float and not is_number(text)  # such as 20 %
            words += field.in_command(value, str(value) if is_read else text)
    if "materials" in values and values.get("loads"):
        words += ["--report", "report"]
    else:
        words += ["--out", "curve"]
    return shlex.join(words)


def _in_python(of: str, by_place: Sequence[Any], by_name: Mapping[str, Any]) -> str:
    """What is asked, as Python: rl.Friction(0.3)."""
    named = (f"{name}={'rl.' * (type(x) is Missing)}{x!r}" for name, x in by_name.items())
    return f"rl.{of}({', '.join([*map(repr, by_place), *named])})"


def as_python(texts: ControlTexts, names: Sequence[str]) -> str:
    """Lines that answer the same question."""
    is_part = len(names) > 1
    typed = _typed_values(texts) | {"whole_curve": bool(typed_loads(texts))}
    written = {each.name: typed[each.name] for each in FIELDS if each.is_set(typed.get(each.name))}
    question = [f"[{', '.join(map(repr, names))}]" if is_part else repr(names[0])]
    question += [f"{name}={value!r}" for name, value in arguments_for("Question", written).items()]
    if asked := [_in_python(*each) for each in asked_in(written)]:
        question.append(f"ask=[{', '.join(asked)}]")
    for kind in (Reading, Preparation):
        name, usual = kind.__name__, vars(kind())
        changed = {k: x for k, x in arguments_for(name, written).items() if x != usual[k]}
        question += [f"{name.lower()}={_in_python(name, (), changed)}"] * bool(changed)
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
