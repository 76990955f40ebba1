"""Names of substances as people write them: in words, or as a chemical formula."""

from __future__ import annotations

import difflib
import re
import unicodedata
from collections.abc import Mapping

from roughline.errors import InputError
from roughline.errors.checks import shown

_ELEMENTS = (
    "H He Li Be B C N O F Ne Na Mg Al Si P S Cl Ar K Ca Sc Ti V Cr Mn Fe Co Ni Cu Zn Ga Ge As Se "
    "Br Kr Rb Sr Y Zr Nb Mo Tc Ru Rh Pd Ag Cd In Sn Sb Te I Xe Cs Ba La Ce Pr Nd Pm Sm Eu Gd Tb Dy "
    "Ho Er Tm Yb Lu Hf Ta W Re Os Ir Pt Au Hg Tl Pb Bi Po At Rn Fr Ra Ac Th Pa U Np Pu Am Cm Bk Cf "
    "Es Fm Md No Lr Rf Db Sg Bh Hs Mt Ds Rg Cn Nh Fl Mc Lv Ts Og"
)
_SYMBOL = re.compile("[A-Z][a-z]?")
_COUNTED = re.compile(r"\(?(?:[A-Z][a-z]?[\d.()]*)+")
_HINT_SIMILARITY = 0.8  # share of letters in common with what was typed: tialn is not tin
_LISTED_NAMES = 24  # names in a message
_SHORTEST_HINTED = 3  # letters of a text that gets a hint: "in" is indium, and not tin


def find_name(typed: str, what: str, formulas: Mapping[str, str], example: str) -> str:
    """Return the name in a table of a substance that is given by its name or chemical formula.

    `formulas` are those of each name, with spaces between. Names are read in any case. Capitals
    decide what a formula is of: "Tin" is the metal, "TiN" its namesake of titanium and nitrogen,
    and "TIN" is refused as it may be both. Other formulas are read in any case where that leaves
    one meaning, so that "co2" is carbon dioxide.

    Raises
    ------
    InputError
        If the name is unknown, or may be that of two substances.
    """
    name = re.sub(r"[\s_]+", "-", typed.lower())
    joined = re.sub(r"[\s_-]+", "", unicodedata.normalize("NFKC", typed))  # CO₂ is CO2
    by_formula = {each: of for of, several in formulas.items() for each in several.split()}
    if joined in by_formula:
        return by_formula[joined]
    is_formula = _is_formula(joined)
    in_any_case = {each.lower(): each for each in by_formula}
    formula = None if is_formula else in_any_case.get(joined.lower())
    word = next((each for each in (name, joined.lower()) if each in formulas), None)
    if formula and word not in (None, by_formula[formula]) and not _is_word(typed):
        raise InputError(
            f"the {what} {shown(typed)} may be {word} or {formula}, which is "
            f'{by_formula[formula]}: write "{word}" or "{by_formula[formula]}"'
        )
    if name in formulas:
        return name
    if formula:
        return by_formula[formula]
    is_short = len(joined) < _SHORTEST_HINTED
    near = (
        []
        if is_formula or is_short
        else difflib.get_close_matches(name, formulas, 1, _HINT_SIMILARITY)
    )
    known, more = ", ".join([*formulas][:_LISTED_NAMES]), len(formulas) - _LISTED_NAMES
    known += f" and {more} more" if more > 0 else ""
    hint = f'; did you mean "{near[0]}"?' if near else f". Known are {known}."
    raise InputError(f'no {what} is called {shown(typed)}{hint} Others are given as "{example}"')


def _is_formula(text: str) -> bool:
    """Whether a text is made of symbols of elements, by its capitals, and of counts."""
    counted = _COUNTED.fullmatch(text) is not None
    return counted and set(_SYMBOL.findall(text)) <= set(_ELEMENTS.split())


def _is_word(text: str) -> bool:
    """Whether a text is written as words are: small, or with one capital."""
    return text in (text.lower(), text.capitalize()) and " " not in text
