"""Measures of the gap under each load: what a fluid finds there, and what a gas conducts."""

from __future__ import annotations

import functools
import math
from dataclasses import dataclass
from weakref import WeakKeyDictionary

import numpy as np

from roughline.contact.fields import Fields
from roughline.contact.measures import Measure
from roughline.fluid.flow import Along, Sides, flow


@dataclass(frozen=True)
class _Found:
    """What is kept of a flow; NaN where it did not converge."""

    aperture: float = math.nan
    factor: float = math.nan
    share: float = math.nan
    slope: float = math.nan


_FOUND: WeakKeyDictionary[Fields, dict[tuple[Along, float], _Found]] = WeakKeyDictionary()
"""By the fields of a load, as long as these are there: several measures are of one flow."""


def _found(fields: Fields, along: Along, path: float) -> _Found:
    """Let a fluid of some mean free path [length] through the gap under a load."""
    known = _FOUND.setdefault(fields, {})
    if (along, path) not in known:
        sides: Sides = "periodic" if fields.is_periodic else "closed"
        through = flow(fields, fields.sizes, along=along, sides=sides, mean_free_path=path)
        known[along, path] = _Found()
        if through.converged:
            mean = float(through.gap.mean())
            factor = through.permeance / mean**3 if mean > 0 else 0.0
            aperture, share = through.hydraulic_aperture, through.largest_share
            known[along, path] = _Found(aperture, factor, share, through.slope)
    return known[along, path]


@functools.cache
def hydraulic_aperture(along: Along, path: float = 0.0) -> Measure:
    """Gap of two flat plates that let as much through; of a gas that slips, by its free path."""
    slips = path > 0
    return Measure(
        f"{'slip_aperture' if slips else 'hydraulic_aperture'}_{along}",
        "u_s" if slips else "u_h",
        "length",
        f"gap of flat plates that let as much {'gas' if slips else ''} through along {along}",
        lambda fields: _found(fields, along, path).aperture,
    )


@functools.cache
def flow_factor(along: Along) -> Measure:
    """Permeance over that of flat plates at the mean gap [1]_.

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
        lambda fields: _found(fields, along, 0.0).factor,
    )


@functools.cache
def largest_share(along: Along) -> Measure:
    """Share of the flow that its strongest channel carries."""
    return Measure(
        f"largest_share_{along}",
        "s_1",
        "1",
        f"share of the flow along {along} in its strongest channel",
        lambda fields: _found(fields, along, 0.0).share,
    )


@functools.cache
def slope_of_flow(along: Along) -> Measure:
    """Slope of the gap where the flow is throttled, by which Reynolds' equation is judged."""
    return Measure(
        f"flow_slope_{along}",
        "",
        "1",
        f"slope of the gap where the flow along {along} is throttled",
        lambda fields: _found(fields, along, 0.0).slope,
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
    )


def _mean_inverse(fields: Fields, jump: float) -> float:
    is_open = ~fields.contact
    return float((1 / (np.maximum(fields.gap[is_open], 0.0) + jump)).sum() / is_open.size)
