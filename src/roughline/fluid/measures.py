"""Measures of the gap under each load: what a fluid finds there, and what a gas conducts."""

from __future__ import annotations

import functools
import math
from collections.abc import Sequence
from dataclasses import dataclass, replace
from weakref import WeakKeyDictionary

import numpy as np

from roughline.contact.fields import Fields
from roughline.contact.measures import Measure
from roughline.errors.checks import allowed_choice
from roughline.errors.public import public
from roughline.fluid.flow import Flow, flow
from roughline.fluid.gap import Along, Gap, checked_free_path
from roughline.fluid.rarefied import Rarefied

LIQUID = Rarefied()
"""What has no mean free path."""


@dataclass(frozen=True)
class _FlowNumbers:
    """What is kept of a flow; NaN where it did not converge."""

    permeance: float = math.nan
    aperture: float = math.nan
    factor: float = math.nan
    share: float = math.nan
    slope: float = math.nan
    places: Sequence[tuple[float, float]] = ()  # along the seal: their weights and free paths


_FOUND: WeakKeyDictionary[Fields, dict[tuple[Along, Rarefied], _FlowNumbers]] = WeakKeyDictionary()
"""By the fields of a load, as long as these are there: several measures are of one flow."""

_AT_BORDER: WeakKeyDictionary[
    Fields, dict[tuple[Along, Rarefied], tuple[_FlowNumbers, _FlowNumbers]]
] = WeakKeyDictionary()


def _found(fields: Fields, along: Along, fluid: Rarefied) -> _FlowNumbers:
    """Let a fluid through the gap under a load."""
    known = _FOUND.setdefault(fields, {})
    if (along, fluid) not in known:
        places = _along_seal(fields, along, fluid)
        for through in zip(*(flows for _, flows in places), strict=True):
            weights = [weight for weight, _ in places]
            known[through[0].along, fluid] = _combined(weights, through, fluid)
    return known[along, fluid]


def _along_seal(
    fields: Fields, along: Along, fluid: Rarefied
) -> list[tuple[float, tuple[Flow, ...]]]:
    """Weights of places along the seal, and the flow at each of them."""
    if fluid.is_even(fields.mean_gap):  # as a rule, more than the aperture
        found = _flows(fields, along, fluid.path)
        if fluid.is_even(min(each.hydraulic_aperture or math.inf for each in found)):
            return [(1.0, found)]
    return [(weight, _flows(fields, along, path)) for weight, path in fluid.stations]


def _flows(fields: Fields, along: Along, path: float) -> tuple[Flow, ...]:
    """The flow along a side; along both where one factorisation serves both."""
    if fields.repeats == (True, True):
        return flow(fields, along="both", mean_free_path=path)
    return (flow(fields, along=along, mean_free_path=path),)


def _combined(weights: Sequence[float], through: Sequence[Flow], fluid: Rarefied) -> _FlowNumbers:
    """What is kept of the flow at places along the seal; of channels, at the last of them."""
    if not all(each.converged for each in through):
        return _FlowNumbers()
    last = through[-1]
    permeance = sum(weight * each.permeance for weight, each in zip(weights, through, strict=True))
    found = _from_permeance(permeance, float(last.gap.mean()), fluid)
    places = [(weight, each.mean_free_path) for weight, each in zip(weights, through, strict=True)]
    return replace(found, share=last.largest_share, slope=last.slope, places=places)


def _from_permeance(permeance: float, mean_gap: float, fluid: Rarefied) -> _FlowNumbers:
    """What follows from the permeance alone."""
    aperture = fluid.gap_of_plates(permeance)
    of_liquid = permeance if fluid == LIQUID else aperture**3
    return _FlowNumbers(permeance, aperture, of_liquid / mean_gap**3 if mean_gap > 0 else 0.0)


def _at_border(fields: Fields, along: Along, fluid: Rarefied) -> tuple[_FlowNumbers, _FlowNumbers]:
    """Let a fluid through with the flow given along the border, then with the pressure even."""
    from roughline.fluid.border import permeances_of_border  # here because it loads slowly

    known = _AT_BORDER.setdefault(fields, {})
    if (along, fluid) not in known:
        places = _found(fields, along, fluid).places
        sums = np.zeros(2) if places else np.full(2, np.nan)
        for weight, path in places:
            gap = Gap.of(fields, None, None, path)
            sums += weight * np.array(permeances_of_border(gap, along))
        mean = float(gap.distances.mean()) if places else math.nan
        given, held = (_from_permeance(float(each), mean, fluid) for each in sums)
        known[along, fluid] = given, held
    return known[along, fluid]


@public
def hydraulic_aperture(along: Along = "x", mean_free_path: float = 0.0) -> Measure:
    """Measure how much a gap lets through, under each load that is pressed.

    What a periodic half-space repeats has no ends: the pressure falls by its difference with each
    repetition. A free body has an inlet, an outlet and closed sides.

    Parameters
    ----------
    along : {"x", "y"}, optional
        Side along which the fluid flows.
    mean_free_path : float, optional
        Of a gas, at its pressure there. Default: 0, a liquid. [length]

    Returns
    -------
    Measure
        The hydraulic aperture, with the name "hydraulic_aperture_x" or "hydraulic_aperture_y"; of a
        gas the gap of plates between which as much of a liquid would flow, "slip_aperture_x" or
        "slip_aperture_y". It is 0 where the gap is sealed.

    Raises
    ------
    InputError
        If there is no such side, or the mean free path is negative or not finite.

    Examples
    --------
    >>> import roughline as rl
    >>> surface = rl.SelfAffine(hurst=0.8, rms_height=0.01, q_roll=25.0).surface(64, rng=7)
    >>> aperture = rl.hydraulic_aperture("x")
    >>> curve = rl.press(
    ...     surface, E_star=1.0, forces=[0.02, 0.05, 0.1], periodic=True, measures=[aperture]
    ... )
    >>> print(curve.measured["hydraulic_aperture_x"].values.round(5))
    [0.00555 0.00162 0.     ]
    """
    allowed_choice("along", along, ("x", "y"))
    return _hydraulic_aperture(along, checked_free_path(mean_free_path))


@functools.cache
def _hydraulic_aperture(along: Along, path: float) -> Measure:
    if path == 0:
        return equivalent_aperture(LIQUID, along)
    return Measure(
        f"slip_aperture_{along}",
        "u_s",
        "length",
        f"gap of flat plates that let as much gas through along {along}, were it a liquid",
        lambda fields: float(np.cbrt(_found(fields, along, Rarefied(path)).permeance)),
        intensive=True,
    )


@functools.cache
def equivalent_aperture(fluid: Rarefied, along: Along) -> Measure:
    """Gap of flat plates that let as much through as a gap does, of a liquid or of a gas."""
    return Measure(
        f"hydraulic_aperture_{along}",
        "u_h",
        "length",
        f"gap of flat plates that let as much through along {along}",
        lambda fields: _found(fields, along, fluid).aperture,
        intensive=True,
    )


@functools.cache
def flow_factor(fluid: Rarefied, along: Along) -> Measure:
    """Cube of the hydraulic aperture over the mean gap, a flow over that of flat plates [1]_.

    References
    ----------
    .. [1] N. Patir and H. S. Cheng, "An average flow model for determining effects of
       three-dimensional roughness on partial hydrodynamic lubrication", J. Lubr. Technol. 100,
       12-17 (1978).
    """
    return Measure(
        f"pressure_flow_factor_{along}",
        r"\phi_p",
        "1",
        f"flow along {along} over that of flat plates at the mean gap",
        lambda fields: _found(fields, along, fluid).factor,
        intensive=True,
    )


def names_at_border(name: str) -> tuple[str, str]:
    """Names of a measure with the flow given along the border across it, and with the pressure."""
    return f"{name}_flow_given", f"{name}_pressure_held"


@functools.cache
def measures_at_border(fluid: Rarefied, along: Along) -> Sequence[Measure]:
    """Aperture and flow factor with the flow given along the border across it, and the pressure.

    They are of what repeats along the flow.
    """
    listed = []
    for of, key in (
        (equivalent_aperture(fluid, along), "aperture"),
        (flow_factor(fluid, along), "factor"),
    ):
        for k, what in enumerate(("flow given", "pressure held even")):
            value = functools.partial(_value_at_border, along, fluid, k, key)
            meaning = f"{of.meaning}, with the {what} along the border"
            name = names_at_border(of.name)[k]
            listed.append(Measure(name, of.symbol, of.dimension, meaning, value, of_this_grid=True))
    return listed


def _value_at_border(along: Along, fluid: Rarefied, k: int, key: str, fields: Fields) -> float:
    """One number of what is found with the flow given, or with the pressure."""
    return float(getattr(_at_border(fields, along, fluid)[k], key))


@functools.cache
def largest_share(fluid: Rarefied, along: Along) -> Measure:
    """Share of the flow that its strongest channel carries."""
    return Measure(
        f"largest_share_{along}",
        "s_1",
        "1",
        f"share of the flow along {along} in its strongest channel",
        lambda fields: _found(fields, along, fluid).share,
    )


@functools.cache
def slope_of_flow(fluid: Rarefied, along: Along) -> Measure:
    """Slope of the gap where the flow is throttled, by which Reynolds' equation is judged."""
    return Measure(
        f"flow_slope_{along}",
        "",
        "1",
        f"slope of the gap where the flow along {along} is throttled",
        lambda fields: _found(fields, along, fluid).slope,
    )


@functools.cache
def inverse_gap(jump: float) -> Measure:
    """Mean over the nominal area of 1 / (u + M) of the open gap, M the temperature jump length."""
    return Measure(
        "inverse_gap",
        r"\langle 1/(u+M) \rangle",
        "1/length",
        "mean of one over the gap and the temperature jump length, zero where the bodies touch",
        lambda fields: _mean_inverse(fields, jump),
        intensive=True,
    )


def _mean_inverse(fields: Fields, jump: float) -> float:
    is_open = ~fields.contact
    return float((1 / (np.maximum(fields.gap[is_open], 0.0) + jump)).sum() / is_open.size)
