"""Measures of the gap under each load: what a fluid finds there, and what a gas conducts."""

from __future__ import annotations

import functools
import math
from dataclasses import dataclass
from weakref import WeakKeyDictionary

import numpy as np

from roughline.contact.fields import Fields
from roughline.contact.measures import Measure
from roughline.errors.checks import one_of
from roughline.errors.public import public
from roughline.fluid.flow import Along, Flow, checked_free_path, flow


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
        if fields.repeats == (True, True):  # one factorisation serves both directions
            through = flow(fields, along="both", mean_free_path=path)
        else:
            through = (flow(fields, along=along, mean_free_path=path),)
        known |= {(each.along, path): _kept(each) for each in through}
    return known[along, path]


def _kept(through: Flow) -> _Found:
    """What is kept of a flow."""
    if not through.converged:
        return _Found()
    mean = float(through.gap.mean())
    factor = through.permeance / mean**3 if mean > 0 else 0.0
    return _Found(through.hydraulic_aperture, factor, through.largest_share, through.slope)


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
        Of a gas, at its mean pressure; it slips. Default: 0, a liquid. [length]

    Returns
    -------
    Measure
        The hydraulic aperture, with the name "hydraulic_aperture_x" or "hydraulic_aperture_y", of a
        gas that slips "slip_aperture_x" or "slip_aperture_y"; 0 where the gap is sealed.

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
    [0.00561 0.00163 0.     ]
    """
    one_of("along", along, ("x", "y"))
    return _hydraulic_aperture(along, checked_free_path(mean_free_path))


@functools.cache
def _hydraulic_aperture(along: Along, path: float) -> Measure:
    slips = path > 0
    return Measure(
        f"{'slip_aperture' if slips else 'hydraulic_aperture'}_{along}",
        "u_s" if slips else "u_h",
        "length",
        f"gap of flat plates that let as much {'gas' if slips else ''} through along {along}",
        lambda fields: _found(fields, along, path).aperture,
        intensive=True,
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
        intensive=True,
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
        intensive=True,
    )


def _mean_inverse(fields: Fields, jump: float) -> float:
    is_open = ~fields.contact
    return float((1 / (np.maximum(fields.gap[is_open], 0.0) + jump)).sum() / is_open.size)
