"""Functions and classes that users call: what they are given is held to their signatures."""

from __future__ import annotations

import difflib
import functools
import inspect
from collections.abc import Callable, Collection, Mapping
from typing import Any, TypeVar

from roughline.errors import InputError
from roughline.errors.checks import as_number, is_whole, refuse
from roughline.errors.earlier import EARLIER

_Public = TypeVar("_Public", bound=Callable[..., Any])

_KINDS: dict[str, tuple[Callable[[Any], bool], str]] = {
    "float": (lambda given: as_number(given) is not None, "a number"),
    "int": (is_whole, "a whole number"),
    "bool": (lambda given: type(given).__name__ in ("bool", "bool_"), "True or False"),
    "str": (lambda given: isinstance(given, str), "a text"),
    "Path": (lambda given: hasattr(given, "__fspath__"), "a path"),
    "ArrayLike": (lambda given: are_numbers(given), "an array of numbers"),
    "None": (lambda given: given is None, "None"),
}
"""What an annotation allows, and what it is called."""

_CLASSES = {
    "Surface": "a Surface",
    "Line": "a Line",
    "Body": "a Surface or a Line",
    "BodyType": "a Surface or a Line",
    "SelfAffine": "a SelfAffine spectrum",
    "IsotropicSpectrum": "what rl.isotropic_spectrum(surface) returns",
    "ProfileSpectrum": "what rl.profile_spectrum(lines) returns",
    "LatticeSpectrum": "what spectrum.lattice(n) returns",
    "Roughness": "what rl.roughness(body) returns",
    "Material": 'a Material, such as rl.material("steel"),',
    "Liquid": 'a Liquid, such as rl.fluid_of("water"),',
    "Gas": 'a Gas, such as rl.fluid_of("helium"),',
    "Curve": "a Curve, as rl.press returns it,",
    "SurfaceCurve": "a SurfaceCurve, as rl.press returns it of a Surface,",
    "Flow": "a Flow, as rl.flow returns it,",
    "Comparison": "a Comparison, as rl.compare returns it,",
    "PowerLaw": "a PowerLaw, as rl.fit_power_law returns it,",
    "TrustMap": "what rl.trust_map() returns",
    "Axes": "Axes of matplotlib",
    "Question": "a Question",
    "Assessment": "an Assessment, as rl.assess returns it of one body,",
    "Reading": "a Reading, as rl.Reading(...),",
    "Preparation": "a Preparation, as rl.Preparation(...),",
    "Missing": 'a Missing, as rl.Missing("nearest", most=0.3),',
    "Plan": "a Plan, as campaign.read_plan returns it,",
}
"""Classes that annotations name, and what they are called."""

_MAKING = {
    "Surface": "rl.Surface(heights, sizes=(Lx, Ly))",
    "Line": "rl.Line(heights, length=L)",
}
"""How bodies are made of arrays."""

_MEMBERS = {"Body": ("Surface", "Line"), "BodyType": ("Surface", "Line")}

_MEANT = {
    "rng": "seed random_state random_seed",
    "E_star": "E E_modulus modulus young youngs_modulus young_modulus Estar E_eff nu poisson",
    "E": "young youngs_modulus young_modulus modulus E_modulus",
    "nu": "poisson poisson_ratio poissons_ratio",
    "hurst": "H hurst_exponent hurst_parameter",
    "fractal_dimension": "D D_f Df fractal_dim dimension",
    "rms_height": "rms h h_rms hrms sigma Sq Rq rms_heights roughness",
    "length": "L size sizes side",
    "sizes": "size L length lengths side sides extent",
    "q_roll": "roll_off rolloff q_r qr",
    "q_high": "cutoff cut_off q_s qs q_max",
    "n": "points N n_points shape size",
    "forces": "force F load loads pressure pressures",
    "loads": "load force forces F pressure pressures",
    "depths": "depth d indentation",
    "n_loads": "steps n_steps num n_forces points",
    "axes": "ax axis",
    "window": "range limits",
    "averaging": "method average mean",
    "points": "n resample",
    "trend": "detrend f_operation F",
    "s_filter": "lambda_s low_pass S",
    "l_filter": "lambda_c high_pass L cutoff",
    "is_cut_out": "periodic",
}
"""Arguments, and other names that they are called by."""

_EXPLAINED = {
    "E_star": "the contact modulus, which rl.contact_modulus(first, second) gives of two materials",
    "molar_mass": "in kg/mol, on which the leak of a gas depends",
    "forces": "total forces: a mean pressure times the nominal area",
    "is_cut_out": "False for a surface that is repeated periodically",
    "half_space": "such as rl.Homogeneous(E_star=1.0, periodic=True)",
}
"""Arguments that differ from what they are mistaken for."""


def public(door: _Public) -> _Public:
    """Return a function or class of which a call that does not fit is refused in one line.

    Names of arguments are held to the signature, and values to those of its annotations that are
    in the tables above; ranges are the function's own matter. Of a class, this holds for its making
    and for its public methods.

    Annotations are texts, as ``from __future__ import annotations`` leaves them. What a converter
    of attrs reads, it looks at itself.
    """
    if not inspect.isclass(door):
        return _held(door, door.__name__)  # type: ignore[return-value]
    read = {each.name for each in getattr(door, "__attrs_attrs__", ()) if each.converter}
    for name, method in list(vars(door).items()):
        if name == "__init__":
            setattr(door, name, _held(method, door.__name__, read=read))
        elif inspect.isfunction(method) and not name.startswith("_"):
            setattr(door, name, _held(method, name))
    return door


def public_making(door: _Public) -> _Public:
    """Return a class as :func:`public` does, of which the making alone is held.

    Its methods are called within loops.
    """
    setattr(door, "__init__", _held(door.__init__, door.__name__))  # noqa: B010 as types have one
    return door


def public_names(door: _Public) -> _Public:
    """Return a function as :func:`public` does, of which the names of arguments alone are held.

    It looks at all values itself.
    """
    return _held(door, door.__name__, by_names=True)  # type: ignore[return-value]


def _held(
    function: Callable[..., Any],
    called: str,
    *,
    by_names: bool = False,
    read: Collection[str] = (),
) -> Callable[..., Any]:
    """Return a function that looks at its arguments first, or at their names alone.

    Of arguments that are `read` by others, it looks at the names alone.
    """

    @functools.wraps(function)
    def held(*positional: Any, **named: Any) -> Any:
        if not _fits(function, len(positional), *named):
            raise _misfit(called, _signature(function), positional, named)
        if not by_names:
            names, kinds = _kinds(function)
            for name, value in (*zip(names, positional, strict=False), *named.items()):
                if name in kinds and name not in read:
                    _refuse_other_kinds(name, value, *kinds[name])
        return function(*positional, **named)

    return held


@functools.lru_cache(maxsize=1024)
def _fits(function: Callable[..., Any], positional: int, *named: str) -> bool:
    """Whether a call with so many arguments by position, and these by name, fits a signature."""
    try:
        _signature(function).bind(*(None,) * positional, **dict.fromkeys(named))
    except TypeError:
        return False
    return True


@functools.cache
def _signature(function: Callable[..., Any]) -> inspect.Signature:
    return inspect.signature(function)


@functools.cache
def _kinds(function: Callable[..., Any]) -> tuple[list[str], dict[str, tuple[list[str], Any]]]:
    """Names of the arguments by position, and the kinds and default of those that are looked at.

    These are the ones of which the tables above have all kinds that the annotation names.
    """
    names, kinds = [], {}
    for name, parameter in _signature(function).parameters.items():
        if parameter.kind in (parameter.POSITIONAL_ONLY, parameter.POSITIONAL_OR_KEYWORD):
            names.append(name)
        if parameter.kind in (parameter.VAR_POSITIONAL, parameter.VAR_KEYWORD):
            continue
        annotation = parameter.annotation
        allowed = annotation.split(" | ") if isinstance(annotation, str) else [""]
        if all(kind in _KINDS or kind in _CLASSES for kind in allowed):
            kinds[name] = allowed, parameter.default
    return names, kinds


def _refuse_other_kinds(name: str, value: Any, kinds: list[str], default: Any) -> None:
    """Refuse a value of none of the kinds that an annotation names."""
    if value is default or any(_is_kind(value, kind) for kind in kinds):
        return
    words = [
        _KINDS[kind][1] if kind in _KINDS else _CLASSES[kind] for kind in kinds if kind != "None"
    ]
    without_unit = " without a unit" if "float" in kinds and isinstance(value, str) else ""
    refuse(name, value, f"{' or '.join(words)}{without_unit} is needed{_how_to_make(value, kinds)}")


def _how_to_make(value: Any, kinds: list[str]) -> str:
    """How a body is made of what came instead."""
    if type(value).__name__ == "LineCurve":
        return ": the reduced model of a line gives no fields; press a Surface"
    if {"Curve", "SurfaceCurve"} & {*kinds} and type(value).__name__ == "CreepCurve":
        return (
            ": draw one that creeps over the time, as creep.to_dataset().area_fraction.plot(xscale="
            '"log")'
        )
    wanted = {member for kind in kinds for member in _MEMBERS.get(kind, (kind,))} & {*_MAKING}
    if not wanted:
        return ""
    if isinstance(value, str) or hasattr(value, "__fspath__"):
        return ": rl.read(file) makes one of a file"
    if hasattr(value, "shape") or isinstance(value, list):
        return f": make one, {' or '.join(_MAKING[each] for each in sorted(wanted, reverse=True))}"
    return ""


def _is_kind(value: Any, kind: str) -> bool:
    """Whether a value is of a kind; classes are known by their names, so that none is imported."""
    if kind in _KINDS:
        return _KINDS[kind][0](value)
    names = {each.__name__ for each in type(value).__mro__}
    return not names.isdisjoint(_MEMBERS.get(kind, (kind,)))


def are_numbers(given: Any) -> bool:
    """Whether NumPy makes an array of real numbers of it."""
    import numpy as np  # here because it loads slowly

    try:
        return np.asarray(given).dtype.kind in "iuf"
    except (TypeError, ValueError):
        return False


def _misfit(
    called: str,
    signature: inspect.Signature,
    positional: tuple[Any, ...],
    named: Mapping[str, Any],
) -> InputError:
    """Say which argument of a call does not fit, and which one may be meant."""
    parameters = [each for each in signature.parameters.values() if each.name != "self"]
    names = [each.name for each in parameters]
    takes = f"it takes {', '.join(f'{name}=' for name in names) or 'no arguments'}"
    for name in named:
        if name not in names:
            if new := EARLIER.get(f"{called}({name}=)"):
                return InputError(f"{called} has no argument {name}= any more; write {new}")
            return InputError(f"{called} has no argument {name}=; {_meant(name, names) or takes}")
    first = len(signature.parameters) - len(names)  # "self"
    places = [each.name for each in parameters if each.kind != each.KEYWORD_ONLY]
    if len(positional) - first > len(places):
        by_name = ", ".join(f"{name}=" for name in names if name not in places)
        if not places:
            return InputError(f"{called} takes its arguments by name: {by_name or 'it has none'}")
        return InputError(
            f"{called} is given {len(positional) - first} arguments by place; it takes "
            f"{', '.join(places)} so" + (f", and {by_name} by name" if by_name else "")
        )
    given = {*named, *places[: len(positional) - first]}
    missing = [
        each.name for each in parameters if each.default is each.empty and each.name not in given
    ]
    if missing:
        explained = f", {_EXPLAINED[missing[0]]}" if missing[0] in _EXPLAINED else ""
        them = "them" if len(missing) > 1 else "it"
        listed = " and ".join(f"{name}=" for name in missing)
        return InputError(f"{called} needs {listed}{explained}; give {them}")
    twice = next((name for name in places[: len(positional) - first] if name in named), "")
    return InputError(f"{called} is given {twice}= twice, by place and by name; give it once")


def _meant(name: str, names: list[str]) -> str:
    """Say which of the names is meant by another one; empty where none is near."""
    called = {each: _MEANT.get(each, "").split() for each in names}
    likely = [each for each in names if name in called[each]]
    if len(name) > 1:  # H and h are two quantities
        likely += [each for each in names if _plain(name) in map(_plain, called[each])]
    likely += difflib.get_close_matches(name, names, 1)
    if not likely:
        return ""
    explained = f", {_EXPLAINED[likely[0]]}" if likely[0] in _EXPLAINED else ""
    return f"give {likely[0]}={explained}"


def _plain(name: str) -> str:
    return name.replace("_", "").lower()
