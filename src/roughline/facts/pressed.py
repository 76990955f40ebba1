"""What a user of a curve must know, beside the borders of its body."""

from __future__ import annotations

from roughline.facts.fact import INTERVALS, LIMITS, Wording, kind
from roughline.units import decimal


@kind(INTERVALS)
def no_grid_error(why: str) -> Wording:
    """A coarser grid cannot be pressed."""
    return f"no grid error: on a coarser grid {why}"


@kind(LIMITS)
def pulling_zone_unresolved(cells: str, needed: float, has_pull_off: bool, wider: float) -> Wording:
    """The zone that pulls is narrower than cells resolve; a range so many times as large helps.

    The cells are written so that they are below those that are needed.
    """
    pull_off = "" if has_pull_off else "no pull-off is given; "
    return (
        f"the pulling zone is {cells} cells wide, {needed:.0f} are needed: give {wider:.3g} times "
        "the range",
        f"the zone that pulls about a contact, E* w / (pi sigma_0²), is {cells} cells wide, and "
        f"{needed:.0f} are needed: {pull_off}give a range {wider:.3g} times as large, or a finer "
        "grid",
    )


@kind(LIMITS)
def pulled_everywhere() -> Wording:
    """The range is larger than all heights."""
    return (
        "the range of the pull is larger than all heights: bodies are pulled everywhere",
        "the range of the pull is larger than all heights: bodies in contact are pulled everywhere",
    )


@kind(LIMITS)
def all_of_profile_touches(depth: float) -> Wording:
    """A body of revolution ends at its largest radius."""
    return (
        f"from depth {depth:.3g} on all of the profile touches: where it goes on, give more of it",
        f"from depth {depth:.3g} on all of the profile touches: the body ends at its largest "
        "radius, as a cylinder does. Where it goes on, give a larger one",
    )


@kind(LIMITS)
def ends_do_not_meet(steps: float) -> Wording:
    """Ends of a line that is given as a reduced one."""
    return (
        f'its ends are {steps:.2g} steps apart, so this is no reduced line: kind="profile"',
        f"the ends of this line are {steps:.2g} ordinary steps apart, and those of a reduced line "
        "meet where it is made from a spectrum: a measured scan is no reduced line "
        '(kind="profile"); where the line is one, say that its ends need not meet '
        "(is_cut_out=True)",
    )


@kind(LIMITS, "note")
def one_line_only() -> Wording:
    """What a line scan does not show."""
    return (
        "a line scan shows one line only; its surface is taken to be alike everywhere: press a map",
        "a line scan shows one line only: the surface is assumed to be isotropic, alike everywhere "
        "and without waves longer than the scan, and a square whose side is the scan's length",
    )


@kind(LIMITS)
def few_heights(heights: float, needed: int) -> Wording:
    """A scan is too short to show whether its heights are Gaussian."""
    count = decimal(heights, 2)
    return (
        f"it has {count} independent heights, and {needed} are needed: measure a map",
        f"the scan has about {count} independent heights, too few to show whether those of its "
        f"surface are Gaussian: {needed} are needed, or rl.press_scan(..., gaussian=True) where "
        "that is known",
    )


@kind(LIMITS)
def stiff_heights(ratio: float, allowed: float, load: int) -> Wording:
    """Heights of a scan are stiffer as springs, or softer, than Gaussian ones of its spectrum."""
    times, chance = decimal(ratio, 2), decimal(allowed, 2)
    return (
        f"heights are {times} times as stiff, by chance {chance}: measure a map",
        "heights are not Gaussian: pressed as independent springs, those of the scan are "
        f"{times} times as stiff under load {load} as Gaussian ones of its spectrum, and chance "
        f"allows {chance}",
    )
