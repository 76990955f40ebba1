"""Mistakes in a command itself, each said in one line: what came, what is allowed, what to do."""

from __future__ import annotations

import difflib
import re
from typing import Any

from roughline.errors import InputError
from roughline.errors.checks import shown

NOT_OFFERED = "https://github.com/roughline/roughline/tree/main/docs/not_offered.md"
"""The page on what the program does not do."""

_NOT_DONE = {
    "viscoelasticity of contacts that recede": "loss-modulus",
    "steady sliding": "sliding",
    "lubrication": "lubrication lubricant oil ehl viscosity film-thickness",
    "wear": "wear abrasion archard running-in",
    "heat": "temperature heat heating thermal-expansion flash-temperature",
    "time and dynamics": "impact damping velocity speed time vibration",
    "finite deformation": "finite-deformation large-strain finite-strain large-deformation",
    "plastic flow inside the body": "hardening pile-up residual-stress plasticity",
    "an anisotropic body": "anisotropic anisotropy orthotropic single-crystal",
}
"""What is not done, and words that options would be named by."""

_CALLED = {
    "--shear": "slip micro-slip stick-slip fretting coupled-friction friction-coupled tangential "
    "tangential-load tangential-force traction hysteresis loss-factor",
    "--materials": "coating coatings coat layer layers layered film thickness substrate rubber",
    "--fluid": "leak leaks leakage leak-rate gasket flow permeance gas air gap-conductance",
    "--adhesion": "adhesive adhesion-energy work-of-adhesion surface-energy jkr dmt pull-off "
    "pull-range attraction sticking",
}
"""Options, and other words for what they ask."""

_COMMANDS = {
    "ball": "ball sphere radius tip hertz",
    "creep": "viscoelastic viscoelasticity viscous creep relaxation prony",
}
"""Commands, and words that options would be named by which ask for what they do."""

_KINDS = {"int": "a whole number is needed", "float": "a number is needed"}
"""What is needed where the parser's name of a mistake begins so."""


def refuse_empty(arguments: list[str]) -> None:
    """Refuse values that are empty, as those of variables of a shell that are not set.

    Raises
    ------
    InputError
        With the option that the empty value belongs to.
    """
    for i, argument in enumerate(arguments):
        option, sign, value = argument.partition("=")
        if not option.startswith("--") or not sign:
            option, value = (arguments[i - 1] if i else ""), argument
        if not value.strip():
            named = option if option.startswith("-") else "an argument"
            raise InputError(f'{named} is ""; give a value, or leave {named} out')


def refuse_repeated(command: Any, arguments: list[str]) -> None:
    """Refuse an option that is given twice and takes one value, of which the parser keeps the last.

    Raises
    ------
    InputError
        With both values.
    """
    values: dict[str, str] = {}
    words = iter(arguments)
    for word in words:
        if word == "--":
            return
        if word in getattr(command, "commands", {}):
            command = command.commands[word]
            continue
        option, sign, value = word.partition("=")
        parameter = next((each for each in command.params if option in _spellings(each)), None)
        if not option.startswith("-") or parameter is None:
            continue
        takes_none = getattr(parameter, "is_flag", False)
        value = value if sign else option if takes_none else next(words, "")
        if parameter.multiple:
            continue
        if parameter.name in values:
            first = values[parameter.name]
            if takes_none and first != value:
                raise InputError(f"{first} and {value} are both given: give one of them")
            both = "" if takes_none else f", as {shown(first)} and {shown(value)}"
            raise InputError(f"{option} is given twice{both}; give it once")
        values[parameter.name] = value


def _spellings(parameter: Any) -> list[str]:
    """The names of an option, and those of its opposite."""
    return [*parameter.opts, *parameter.secondary_opts]


def in_one_line(mistake: Any) -> str:
    """Say what is wrong with a command; the parser's mistakes are known by what they carry."""
    context = getattr(mistake, "ctx", None)
    command = getattr(context, "command", None)
    parameter, option = getattr(mistake, "param", None), getattr(mistake, "option_name", None)
    if option is not None and hasattr(mistake, "possibilities"):
        return _unknown(option, command)
    if option is not None:
        takes_none = "not take" in mistake.message
        return f"{option} {'takes no value: leave it out' if takes_none else 'needs a value'}"
    if parameter is not None:
        return _parameter_sentence(parameter, mistake, _options(command))
    path = getattr(context, "command_path", "").rpartition("roughline")[2]
    see = f"see roughline{path} --help"
    if extra := re.search(r"unexpected extra argument[()s]* \((.*)\)", mistake.message, re.DOTALL):
        return f"{shown(extra[1])} is not expected there; {see}"
    if unknown := re.match(r"No such command '(.*?)'\.?", mistake.message, re.DOTALL):
        names = list(getattr(command, "commands", ()))
        return f"there is no command {shown(unknown[1])}; {_meant(unknown[1], names, 'commands')}"
    return mistake.format_message()


def _unknown(option: str, command: Any) -> str:
    """Say of an unknown option what is near it, or that what it asks for is not offered."""
    word = option.lstrip("-").lower().replace("_", "-")
    options = _options(command)
    for topic, words in _NOT_DONE.items():
        if word in words.split():
            return (
                f"there is no option {option}: {topic} is not offered; what to use: {NOT_OFFERED}"
            )
    for name, words in _CALLED.items():
        if name in options and word in words.split():
            return f"there is no option {option}; did you mean {name}?"
    for name, words in _COMMANDS.items():
        if word in words.split():
            return f"there is no option {option}; see roughline {name} --help"
    return f"there is no option {shown(option)[1:-1]}; {_meant(option, options, 'options')}"


def _options(command: Any) -> list[str]:
    """The names of all options of a command."""
    return [name for each in getattr(command, "params", ()) for name in each.opts]


def _meant(typed: str, names: list[str], called: str) -> str:
    """Name what is near, or where the list is."""
    near = difflib.get_close_matches(typed, names, 2, cutoff=0.75)
    if near:
        return f"did you mean {' or '.join(near)}?"
    return f"--help lists the {called}"


def _parameter_sentence(parameter: Any, mistake: Any, options: list[str]) -> str:
    """Say what an option or an argument needs, and which option of the command may be meant."""
    name = max(parameter.opts, key=len)
    name = name if name.startswith("-") else name.upper()
    if not mistake.message:
        wanted = (getattr(parameter, "help", None) or "").rstrip(".")
        return f"{name} is needed" + (f", {wanted[0].lower()}{wanted[1:]}" if wanted else "")
    found: list[Any] = getattr(mistake.__cause__, "errors", list)()
    if not found:
        return f"{name}: {mistake.message}"
    kind, bounds = found[0]["type"], found[0].get("ctx", {})
    needed = _KINDS.get(kind.partition("_")[0], mistake.message)
    if "ge" in bounds:
        needed = f"at least {bounds['ge']} is needed"
    elif choices := re.search(r"is not one of (.*?)\.?$", mistake.message):
        needed = f"allowed are {choices[1]}".replace("'", '"')
    one = name.removesuffix("s")  # --load "10 N" beside --loads 20
    meant = f"; did you mean {one}?" if one != name and one in options else ""
    return f"{name} is {shown(found[0]['input'])}; {needed}{meant}"
