"""The parameters of one surface or profile: filters, parameters, and what stands in their way."""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping
from dataclasses import dataclass, replace
from types import MappingProxyType
from typing import TYPE_CHECKING

from roughline.computing.notebook import in_notebook, printed
from roughline.errors import InputError
from roughline.errors.checks import number, positive
from roughline.errors.public import public
from roughline.facts.fact import Fact
from roughline.texture.filters import smoothed
from roughline.texture.found import Found
from roughline.texture.heights import height_parameters
from roughline.texture.material_ratio import (
    Layers,
    compute_layers,
    compute_volumes,
    material_ratio_curve,
    mean_step,
)
from roughline.texture.parameters import PROFILE_PARAMETERS, SURFACE_PARAMETERS, Parameter
from roughline.texture.peaks import peak_parameters
from roughline.texture.profile import Sections, mean_spacing, section_parameters
from roughline.texture.slopes import gradient_and_length, slope_parameters
from roughline.texture.waves import wave_parameters
from roughline.topography.body import (
    Body,
    Line,
    Surface,
    piece,
    point_spacings,
    side_lengths,
)
from roughline.topography.heights import rms_deviation
from roughline.topography.preparation import TILT_MATTERS
from roughline.topography.trend import Trend, refuse_unknown_trend, without_trend
from roughline.units import in_words

if TYPE_CHECKING:
    import pandas

_FEW_LENGTHS = 10  # autocorrelation lengths along a side below which the map decides them
_COARSE_STEP = 0.02  # of the rms height, between heights that occur, from which on it is told


@dataclass(frozen=True, eq=False)
class IsoParameters:
    """Parameters of surface texture, as :func:`roughline.iso` returns them.

    Each is an attribute, such as ``found.Sq``; one that the body does not define is NaN, and
    `undefined` says why.

    Attributes
    ----------
    body : Surface or Line
        What was evaluated, after all filters. [length]
    filters : mapping of str to str
        The trend that was removed (F), the S-filter and the L-filter, and what was done at the
        borders, in words.
    values : mapping of str to float
        Values by names, in the order in which people read them.
    undefined : mapping of str to str
        By name, why a parameter is not defined for this body.
    facts : tuple of Fact
        What makes values depend on more than the surface: a tilt, a short map, stepped heights.

    Notes
    -----
    Filters are Gaussian, after ISO 16610-61 and -21, and half of the amplitude of a wave of the
    cutoff passes. At the borders of a piece the weights are those of the points that there are
    (renormalised); nothing is left out.

    Slopes (Sdq, Sdr, Rdq, Rdr) are from forward differences. Sal and Str are where the
    autocorrelation of the whole surface falls to 0.2: products are divided by the points that
    overlap. Std is the direction of the waves, across the
    lay, in degrees counter-clockwise from x as pictures show the map, the first row, y = 0, at the
    top: the wave vector (qx, qy) is at atan2(-qy, qx). Sk is of the least-squares line through the
    40 % of the material ratio curve whose secant is least steep, and points of equal height are
    counted as they are. Spd and Spc are of the peaks of hills higher than 5 % of Sz (Wolf pruning);
    ridges, and hills whose tops meet the border, are no peaks. Rp, Rv and Rz are means of five
    sections.
    """

    body: Body
    filters: Mapping[str, str]
    values: Mapping[str, float]
    undefined: Mapping[str, str]
    facts: tuple[Fact, ...]

    __str__ = printed
    _repr_html_ = in_notebook

    def __repr__(self) -> str:
        """Tell the leading heights, and how many parameters there are."""
        first = "Sq Sz" if isinstance(self.body, Surface) else "Rq Rz"
        leading = ", ".join(
            f"{name} {in_words(self.values[name], self.body.unit)}" for name in first.split()
        )
        return f"<IsoParameters: {leading} and {len(self.values) - 2} more>"

    def __getattr__(self, name: str) -> float:
        """Return a parameter by its name, or by the one of an earlier edition."""
        if name.startswith("_") or "values" not in self.__dict__:
            raise AttributeError(name)
        for each in self.parameters:
            if name in (each.name, each.formerly):
                return self.values[each.name]
        known = ", ".join(self.values)
        raise AttributeError(f"there is no parameter {name} of this body; there are {known}")

    def __dir__(self) -> list[str]:
        """Return the names, those of the parameters among them."""
        return sorted([*super().__dir__(), *self.values])

    @property
    def remarks(self) -> tuple[str, ...]:
        """The facts in words."""
        return tuple(map(str, self.facts))

    @property
    def parameters(self) -> Iterator[Parameter]:
        """What each parameter is: name, unit, meaning and clause of the standard."""
        yield from (
            SURFACE_PARAMETERS if isinstance(self.body, Surface) else PROFILE_PARAMETERS
        ).values()

    def material_ratio(self, height: float) -> float:
        """Return the share of points that are higher than so far above the mean: Smr(c), Rmr(c).

        Parameters
        ----------
        height : float
            Height above the mean plane or line, c; negative below it. [length]

        Returns
        -------
        float
            Material ratio, from 0 to 100. [%]
        """
        level = number("height", height)
        heights = self.body.heights
        return 100 * float((heights - heights.mean() > level).mean())

    def to_dataframe(self) -> pandas.DataFrame:
        """Return a table of pandas, a row for each parameter.

        Its columns are the value, its unit, what it means, the clause, and why it is undefined.
        """
        import pandas  # here because it loads slowly

        rows = [
            (
                each.name,
                self.values[each.name],
                each.unit_in(self.body.unit),
                each.meaning,
                f"{each.standard}, {each.clause}",
                self.undefined.get(each.name, ""),
            )
            for each in self.parameters
        ]
        columns = ["parameter", "value", "unit", "meaning", "clause", "undefined"]
        found = pandas.DataFrame(rows, columns=columns).set_index("parameter")
        found.attrs["filters"] = dict(self.filters)
        return found


@public
def iso(
    body: Body,
    *,
    trend: Trend = "none",
    s_filter: float | None = None,
    l_filter: float | None = None,
) -> IsoParameters:
    """Return the parameters of ISO 25178-2 of a surface, or of ISO 21920-2 of a profile.

    Nothing is filtered unless it is asked for; the result says what was, before and now. Heights
    count from their mean. A body that is periodic is evaluated around its borders; a piece of a
    larger one, as measured maps are, up to them. Where programs differ, :class:`IsoParameters` says
    what is chosen.

    Parameters
    ----------
    body : Surface or Line
        A surface, or a Line of kind "profile". [length]
    trend : {"none", "mean", "tilt", "curvature"}, optional
        Least-squares polynomial that is removed first: F. :func:`roughline.read` removes the tilt.
    s_filter : float, optional
        Cutoff wavelength (nesting index) of the S-filter, which removes shorter waves. [length]
    l_filter : float, optional
        Cutoff wavelength of the L-filter, which removes longer waves; of a profile it is the length
        of a section too. [length]

    Returns
    -------
    IsoParameters
        The parameters as attributes, lengths in the body's unit, shares and angles in % and °.

    Raises
    ------
    InputError
        For a reduced line, and for cutoffs that the body cannot show or that are not in order.

    References
    ----------
    ISO 25178-2:2021; ISO 21920-2:2021; ISO 16610-21:2011; ISO 16610-61:2015.

    Examples
    --------
    >>> import roughline as rl
    >>> spectrum = rl.SelfAffine(hurst=0.8, length=1.0, rms_height=0.01, q_roll=60)
    >>> surface = spectrum.surface(64, rng=7)
    >>> found = rl.iso(surface, l_filter=0.5)
    >>> print(f"{found.Sq:.4f} {found.Sku:.2f} {found.Sk:.4f} {found.Sal:.4f}")
    0.0098 2.98 0.0252 0.0326
    """
    if isinstance(body, Line) and body.kind == "reduced":
        raise InputError(
            "this is a reduced line, made for springs, and no profile: take the parameters of its "
            "surface"
        )
    refuse_unknown_trend(trend)
    _refuse_other_cutoffs(body, s_filter, l_filter)
    evaluated = _filtered(body, trend, s_filter, l_filter)
    filters = MappingProxyType(_filters_in_words(body, trend, s_filter, l_filter))
    facts = [*_tilt_facts(evaluated)]
    if isinstance(evaluated, Surface):
        found = _surface_parameters(evaluated)
        facts += _short_map_facts(evaluated, found)
    else:
        sections = Sections.of(evaluated.heights.size, evaluated.spacing, l_filter)
        facts += _section_facts(evaluated, sections, l_filter)
        evaluated = piece(evaluated, (sections.points,))
        found = _profile_parameters(evaluated, sections)
    facts += _step_facts(evaluated)
    return IsoParameters(evaluated, filters, *_values_and_causes(found), tuple(facts))


def _values_and_causes(found: Found) -> tuple[Mapping[str, float], Mapping[str, str]]:
    """Return values, NaN where there is none, in the order of the table, and why there is none."""
    names = [name for name in (*SURFACE_PARAMETERS, *PROFILE_PARAMETERS) if name in found]
    causes = {name: text for name in names if isinstance(text := found[name], str)}
    values = {name: math.nan if isinstance(value := found[name], str) else value for name in names}
    return MappingProxyType(values), MappingProxyType(causes)


def _surface_parameters(surface: Surface) -> Found:
    """Find all parameters of a surface."""
    is_periodic = not surface.is_cut_out
    heights = surface.heights - surface.heights.mean()
    curve = material_ratio_curve(heights)
    layers, volumes = compute_layers(curve), compute_volumes(curve)
    return {
        **height_parameters(heights, "S"),
        **wave_parameters(heights, surface.spacing, is_periodic=is_periodic),
        **slope_parameters(heights, surface.spacing, is_periodic=is_periodic),
        **_named(layers, "S", "Smrk"),
        "Vmp": volumes.peaks,
        "Vmc": volumes.core,
        "Vvc": volumes.void_of_core,
        "Vvv": volumes.void_of_pits,
        **peak_parameters(heights, surface.sizes, is_periodic=is_periodic),
    }


def _profile_parameters(line: Line, sections: Sections) -> Found:
    """Find all parameters of a profile over its evaluation length."""
    heights = line.heights - line.heights.mean()
    over_all = height_parameters(heights, "R")
    parted = section_parameters(heights, sections.count)
    gradient, length = gradient_and_length(heights, line.spacing, is_periodic=not line.is_cut_out)
    spacing: float | str = "all heights are equal"
    if over_all["Rz"] and isinstance(parted["Rp"], str):
        spacing = parted["Rp"]
    elif over_all["Rz"]:
        spacing = mean_spacing(heights, line.spacing, float(parted["Rp"]), float(parted["Rv"]))
    return {
        **over_all,
        "Rt": over_all["Rz"],
        **parted,
        "RSm": spacing,
        "Rdq": gradient,
        "Rdr": length,
        **_named(compute_layers(material_ratio_curve(heights)), "R", "Rmrk"),
    }


def _named(layers: Layers, letter: str, ratio: str) -> Found:
    return {
        f"{letter}k": layers.core,
        f"{letter}pk": layers.peaks,
        f"{letter}vk": layers.pits,
        f"{ratio}1": 100 * layers.first,
        f"{ratio}2": 100 * layers.second,
    }


def _refuse_other_cutoffs(body: Body, s_filter: float | None, l_filter: float | None) -> None:
    """Refuse cutoffs that the grid or the size of a body cannot show."""
    least, most = 2 * max(point_spacings(body)), max(side_lengths(body))
    for name, cutoff in (("s_filter", s_filter), ("l_filter", l_filter)):
        if cutoff is None:
            continue
        positive(name, cutoff, "a positive wavelength is needed")
        if not least <= cutoff <= most:
            raise InputError(
                f"is {in_words(cutoff, body.unit)}; a wavelength from "
                f"{in_words(least, body.unit)}, two points, to {in_words(most, body.unit)}, the "
                "longest side, is needed",
                name,
            )
    if s_filter is not None and l_filter is not None and not s_filter < l_filter:
        longer = in_words(l_filter, body.unit)
        shorter = in_words(s_filter, body.unit)
        raise InputError(f"is {shorter}; less than the L-filter, {longer}, is needed", "s_filter")


def _filtered(body: Body, trend: Trend, s_filter: float | None, l_filter: float | None) -> Body:
    """Return a body without a trend, and without waves shorter or longer than cutoffs."""
    if trend != "none":
        body = body.detrended(trend)
    heights, is_periodic, spacings = body.heights, not body.is_cut_out, point_spacings(body)
    if s_filter is not None:
        heights = smoothed(heights, spacings, s_filter, is_periodic=is_periodic)
    if l_filter is not None:
        heights = heights - smoothed(heights, spacings, l_filter, is_periodic=is_periodic)
    return body if heights is body.heights else replace(body, heights=heights)


def _filters_in_words(
    body: Body, trend: Trend, s_filter: float | None, l_filter: float | None
) -> dict[str, str]:
    """Say which filters there were, before and now."""
    part = "ISO 16610-61" if isinstance(body, Surface) else "ISO 16610-21"

    def gaussian(cutoff: float | None) -> str:
        return "none" if cutoff is None else f"Gaussian ({part}), {in_words(cutoff, body.unit)}"

    removed = trend if trend != "none" else body.removed_trend
    is_new = trend != "none" or removed == "none"
    short = gaussian(s_filter)
    if before := body.provenance.low_pass:
        earlier = f"{gaussian(before)}, when it was prepared"
        short = earlier if s_filter is None else f"{earlier}, and {short}"
    borders = "renormalised weights within half a cutoff of them"
    if not body.is_cut_out:
        borders = "none: the body is periodic"
    return {
        "F": removed if is_new else f"{removed}, removed before",
        "S": short,
        "L": gaussian(l_filter),
        **({} if s_filter is None and l_filter is None else {"borders": borders}),
    }


def _tilt_facts(body: Body) -> Iterator[Fact]:
    """Tell a tilt that is left in a piece."""
    rough = body.rms_height
    if not body.is_cut_out or rough == 0:
        return
    lower = 1 - rms_deviation(without_trend(body.heights, "tilt")) / rough
    if lower > TILT_MATTERS:
        yield Fact("tilt_left", letter="S" if isinstance(body, Surface) else "R", lower=lower)


def _short_map_facts(surface: Surface, found: Found) -> Iterator[Fact]:
    """Tell a map that is too short for its autocorrelation length."""
    length = found["Sal"]
    if isinstance(length, str) or not surface.is_cut_out:
        return
    count = min(surface.sizes) / length
    if count < _FEW_LENGTHS:
        yield Fact("map_is_short", count=count, needed=_FEW_LENGTHS)


def _section_facts(line: Line, sections: Sections, cutoff: float | None) -> Iterator[Fact]:
    """Tell how a profile is parted, and that it is no roughness profile without an L-filter."""
    if cutoff is None:
        yield Fact("primary_profile", sections=sections.in_words(line.unit))
        return
    points = sections.points.stop - sections.points.start
    length = line.length if points < line.heights.size else None
    sizes = {"evaluated": points * line.spacing, "length": length, "unit": line.unit}
    yield Fact("evaluated_over", sections=sections.in_words(line.unit), **sizes)


def _step_facts(body: Body) -> Iterator[Fact]:
    """Tell heights in steps, which decide where the material ratio curve is cut."""
    rough, step = body.rms_height, mean_step(material_ratio_curve(body.heights))
    if step > _COARSE_STEP * rough > 0:
        is_map = isinstance(body, Surface)
        sizes = {"step": step, "share": step / rough, "unit": body.unit}
        yield Fact("texture_in_steps", letter="S" if is_map else "R", is_map=is_map, **sizes)
