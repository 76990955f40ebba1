"""Symbols in a text of a page: what follows an underscore is set low, and powers high."""

from __future__ import annotations

import re

from markupsafe import Markup, escape

_LETTER = r"[^\W\d_]"
_SYMBOL = re.compile(  # k_i and E*_l, but no names; powers; numbers such as 1e-05
    rf"(?<![\w.])({_LETTER}\u0304?\*?)_((?!star)[^\W_]{{1,4}})(?!\w|\.{_LETTER})"
    r"|(?:\^|(?<![\w.-])(\d+(?:\.\d+)?)e(?=[+-]?\d+(?!\w)))\+?(-?)0*([\wα-ω]+(?:\.\d+)?)"
)


def typeset(text: str) -> Markup:
    """A text as HTML, with its symbols as they are printed."""

    def mark(found: re.Match[str]) -> str:
        base, low, number, sign, high = found.groups()
        if low:
            return f"{base}<sub>{low}</sub>"
        times = f"{number}·10" if number else ""
        return f"{times}<sup>{sign and '−'}{high}</sup>"

    return Markup(_SYMBOL.sub(mark, str(escape(text))))
