"""Facts that come in words, and what is said of one of several bodies or maps."""

from __future__ import annotations

from roughline.facts.fact import LIMITS, Fact, Wording, kind


@kind(LIMITS)
def in_own_words(text: str) -> Wording:
    """What a rule of one's own says, or a reader of files."""
    return text


@kind(LIMITS)
def on_body(fact: Fact, which: str) -> Wording:
    """A fact of the first or of the second body."""
    return f"{which} body: {fact.in_short}", f"{which} body: {fact}"


@kind(LIMITS)
def on_maps(fact: Fact, maps: tuple[str, ...] = (), first: str = "") -> Wording:
    """A fact of some of the maps of a part, with the numbers of the first where they differ."""
    of = f"of {', '.join(maps)}: " if maps else ""
    whose = f" (so for {first}; the numbers of the other maps differ)" if first else ""
    of_few = of if len(maps) < 2 else f"of {len(maps)} maps: "
    return f"{of_few}{fact.in_short}", f"{of}{fact}{whose}"
