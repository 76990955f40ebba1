"""Symbols in a text of a page: what follows an underscore is set low, and powers high."""

from __future__ import annotations

import re

from markupsafe import Markup, escape

_LETTER, _LOW_LETTER = r"[^\W\d_]", r"[^\W_²³]"  # of a word, and of what may be set low
_SYMBOL = re.compile(  # k_i and E*_l, but no names; powers; numbers such as 1e-05
    rf"(?<![\w.])({_LETTER}\u0304?\*?)_((?!star){_LOW_LETTER}{{1,5}})(?!{_LOW_LETTER}|_|\.{_LETTER})"
    r"|\^\(([^()]*)\)"
    r"|(?:\^|(?<![\w.-])(\d+(?:\.\d+)?)e(?=[+-]?\d+(?!\w)))\+?(-?)0*([\wα-ω]+(?:\.\d+)?)"
)
_GREEK = {
    **{"eta": "η", "kappa": "κ", "mu": "μ", "nu": "ν", "omega": "ω", "phi": "φ"},
    **{"pi": "π", "rho": "ρ", "sigma": "σ"},
}
_NAMED = re.compile(rf"(?<!\w)(?:(m_dot)|({'|'.join(_GREEK)})(?=_))(?![^\W_])")
_SPELLED = re.compile(rf"(?<!\w)({'|'.join(_GREEK)})(?=_|\d?\*?(?!\w))")
_NUMBERED = re.compile(rf"(?<!\w)({_LETTER})(\d)(?!{_LOW_LETTER}|_)")


def typeset(text: str) -> Markup:
    """A text as HTML, with its symbols as they are printed."""

    def mark(found: re.Match[str]) -> str:
        base, low, power, number, sign, high = found.groups()
        if low:
            return f"{base}<sub>{low}</sub>"
        if power:
            return f"<sup>{power}</sup>"
        times = f"{number}·10" if number else ""
        return f"{times}<sup>{sign and '−'}{high}</sup>"

    named = _NAMED.sub(lambda found: "ṁ" if found[1] else _GREEK[found[2]], text)
    return Markup(_SYMBOL.sub(mark, str(escape(named))))


def formula_in_symbols(formula: str) -> str:
    """A formula with Greek letters, roots, sums and minus signs in the place of their names.

    Letters with a number, such as P1 or nu1, have that below.
    """
    spelled = _SPELLED.sub(lambda found: _GREEK[found[1]], formula)
    numbered = _NUMBERED.sub(r"\1_\2", spelled)
    for name, sign in (("sqrt(", "√("), ("sum(", "Σ("), (" - ", " − "), ("<", "⟨"), (">", "⟩")):
        numbered = numbered.replace(name, sign)
    return numbered
