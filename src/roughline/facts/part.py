"""What several maps of a part say together, and whether they are of one kind."""

from __future__ import annotations

from roughline.errors.words import called
from roughline.facts.fact import INTERVALS, LIMITS, Wording, kind
from roughline.facts.listed import listed, listed_in_short
from roughline.units import engineering


@kind(LIMITS)
def refused(name: str, why: str) -> Wording:
    """A map that could not be pressed, and why."""
    return f"refused: {name}: {why}"


@kind(LIMITS)
def not_pressed(names: tuple[str, ...]) -> Wording:
    """Ctrl-C came before."""
    return (
        f"not pressed, because of Ctrl-C: {listed_in_short(names)}",
        f"not pressed, because of Ctrl-C: {', '.join(names)}",
    )


@kind(LIMITS, "grave")
def some_are_scans(names: tuple[str, ...]) -> Wording:
    """Line scans among maps."""
    return (
        f"not of one kind: {listed_in_short(names)} is a line scan, others are maps",
        f"not of one kind: {', '.join(names)} is a line scan, and others are maps",
    )


@kind(LIMITS, "grave")
def not_of_one_kind(
    what: str, least: float, largest: float, most: float, names: tuple[str, str]
) -> Wording:
    """Maps whose rms heights, pixels or sides [m] are too different."""
    ends = [engineering(least, "m", 3), engineering(largest, "m", 3)]
    return (
        f"not of one kind: {what} go from {ends[0]} to {ends[1]}: are these maps of one part?",
        f"not of one kind: {what} go from {ends[0]} ({names[0]}) to {ends[1]} ({names[1]}), more "
        f"than a factor of {most:g}; check whether these are maps of one part, measured in the "
        "same way",
    )


@kind(LIMITS, "grave")
def sizes_differ(has_joint_as_remedy: bool) -> Wording:
    """Maps differ in size, so that quantities of a whole map have no mean."""
    joint = called("rl.Joint")
    return (
        "the maps differ in size: give mean pressures as loads to compare quantities per area",
        "the maps differ in size, so quantities of a whole map have no common mean; give mean "
        "pressures as loads to compare quantities per area"
        + (f", or the area of the joint ({joint})" if has_joint_as_remedy else ""),
    )


@kind(LIMITS)
def sealed_in_some(load: str, names: tuple[str, ...]) -> Wording:
    """Some maps are sealed, and others leak."""
    return (
        f"under {load} some maps ({len(names)}) are sealed and others leak: press more maps",
        f"under {load}, {listed(names)} let nothing through, and other maps do: what leaks has no "
        "mean over them there, and hangs on the leakiest places; press more maps",
    )


@kind(INTERVALS, "note")
def single_map() -> Wording:
    """One map has no scatter."""
    return (
        "a single map shows no scatter between places: map at least two more places, better four",
        "a single map shows no scatter between places: no interval for the part; map at least two "
        "more places, better four",
    )


@kind(INTERVALS, "note")
def mean_of_maps(count: int) -> Wording:
    """What the mean and the scatter of a part are."""
    return (
        f"mean: geometric, over {count} maps, taken to be of places chosen at random",
        f"mean: geometric, over {count} maps, taken to be of places chosen at random; scatter: "
        "about two of three places lie within this factor of the mean",
    )


@kind(INTERVALS, "note")
def interval_of_part(
    count: int, student: float, is_joint: bool, more: int, student_of_more: float
) -> Wording:
    """What the interval of a part is; `more` maps would narrow it, none if it is zero."""
    scope = "the mean over all its places"
    if is_joint:
        scope = "the whole part, its places sharing the load"
    text = (
        f"interval of the part: 95 % for {scope}; Student's t on logarithms ({student:.3g} "
        f"standard errors for {count} maps), widened by errors that all maps may have in common "
        "and that do not average out, such as the grid's"
    )
    if is_joint:
        text += ", and by how a map differs from the part behind it"
    if more:
        narrower = student / student_of_more * (more / count) ** 0.5
        text += (
            f"; with {more} maps it is {student_of_more:.3g}, and intervals are narrower by a "
            f"factor of {narrower:.2g} for the same scatter"
        )
    return f"interval of the part: 95 % for {scope}, from {count} maps", text


@kind(INTERVALS, "note")
def some_without_interval() -> Wording:
    """Maps without an interval of their own."""
    option = called("grid_error", True)
    return (
        f"some maps have no interval of their own ({option} gives the maps intervals)",
        "some maps have no interval of their own; where they have none, the part's interval is "
        f"that of the scatter alone ({option} gives the maps intervals)",
    )


@kind(LIMITS)
def behind_maps_unknown(why: str, answers: tuple[str, ...], is_joint: bool) -> Wording:
    """Why maps do not tell of the part, and which answers have no interval."""
    names = "answers of the joint" if is_joint else listed_in_short(answers)
    verb = "comes" if len(answers) == 1 and not is_joint else "come"
    return f"no interval: {why}", f"{why}; {names} {verb} without an interval"


@kind(LIMITS, "note")
def maps_agree(between: float, within: float, ratio: float, chance: float) -> Wording:
    """Rms heights scatter between maps as between quarters, by factors."""
    return (
        f"the maps agree: rms heights scatter by a factor of {_factor(between):.3g} between them",
        f"the maps agree: {_scatter(between, within, ratio, chance)}",
    )


@kind(LIMITS, "grave")
def maps_disagree(between: float, within: float, ratio: float, chance: float) -> Wording:
    """Rms heights scatter more between maps than between quarters, by factors."""
    return (
        f"the maps do not agree: rms heights scatter by {_factor(between):.3g}, by chance "
        f"{_factor(within):.3g}: ask for each region",
        f"the maps do not agree: {_scatter(between, within, ratio, chance)}; places of the part "
        "differ, and rougher ones bear more of its load than maps under one pressure show: the "
        "intervals allow for that; if the part has regions, ask for each of them",
    )


def _scatter(between: float, within: float, ratio: float, chance: float) -> str:
    return (
        f"rms heights scatter by a factor of {_factor(between):.3g} between maps, and chance "
        f"explains {_factor(within):.3g}, as between quarters of a map (ratio of variances "
        f"{ratio:.2g}, and chance allows up to {chance:.2g})"
    )


def _factor(excess: float) -> float:
    return 1 + float(f"{excess:.2g}")
