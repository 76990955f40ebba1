"""The shape of an isotropic spectrum: a plateau, then a power law, between two cutoffs."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

from roughline.computing.arrays import Real
from roughline.errors import InputError

# A wavenumber computed as m q_low may miss a cutoff of the same name by rounding.
_WAVENUMBER_ROUNDING = 1e-12


@dataclass(frozen=True)
class Band:
    """One to ``q_roll``, ``(q / q_roll)**-decay`` beyond, zero outside ``q_low`` to ``q_high``."""

    q_low: float  # of the longest waves [1 / length]
    q_roll: float  # where the plateau ends [1 / length]
    q_high: float  # of the shortest waves; may be infinite [1 / length]
    decay: float  # exponent of the power law, 2 (H + 1) for a self-affine surface

    def shape(self, q: Real) -> Real:
        """Values at wavenumbers q >= 0."""
        shape = np.ones_like(q)
        falling = q > self.q_roll
        shape[falling] = (q[falling] / self.q_roll) ** -self.decay
        outside = (q < self.q_low * (1 - _WAVENUMBER_ROUNDING)) | (
            q > self.q_high * (1 + _WAVENUMBER_ROUNDING)
        )
        shape[outside] = 0.0
        return shape

    def moment(self, order: int) -> float:
        """Integral over the plane of wavevectors, 2 pi int q^(1 + order) shape dq."""
        if self.q_high == math.inf and 2 + order - self.decay >= 0:
            raise InputError(
                f"the moment of order {order} diverges for H = {self.decay / 2 - 1:g} without a "
                "cutoff: give q_high, or take lattice(n) of a grid of n points"
            )
        plateau = _power_integral(1 + order, self.q_low, self.q_roll)
        tail = _power_integral(1 + order - self.decay, self.q_roll, self.q_high)
        return 2 * math.pi * (plateau + tail * self.q_roll**self.decay)

    def cut(self, q: Real) -> Real:
        """Abel transform to a straight cut, 2 int_q^inf shape q' dq' / sqrt(q'² - q²), at q >= 0.

        The plateau integrates to square roots. With t = (q / q')² the power law gives
        ``q (q / q_roll)**-decay`` times the incomplete beta function B(t; (decay - 1) / 2, 1/2)
        between the cutoffs; at q = 0 it is a plain power.
        """
        from scipy.special import beta, betainc  # here because it loads slowly

        start, end = np.maximum(q, self.q_low), np.maximum(q, self.q_roll)
        plateau = 2 * (np.sqrt(end**2 - q**2) - np.sqrt(start**2 - q**2))
        at_zero = 2 * _power_integral(-self.decay, self.q_roll, self.q_high)
        power_law = np.full(q.shape, at_zero * self.q_roll**self.decay)
        positive = q > 1e-6 * self.q_low  # below, the limit is exact to rounding
        q = q[positive]
        upper = np.minimum(1.0, (q / self.q_roll) ** 2)
        lower = np.minimum(upper, (q / self.q_high) ** 2)
        a, b = (self.decay - 1) / 2, 0.5
        part = beta(a, b) * (betainc(a, b, upper) - betainc(a, b, lower))
        power_law[positive] = q * (q / self.q_roll) ** -self.decay * part
        return plateau + power_law


def _power_integral(exponent: float, start: float, end: float) -> float:
    """Integral of q**exponent from start to end, which may be infinite for exponent < -1."""
    if exponent == -1:
        return math.log(end / start)
    rise = exponent + 1
    at_end = 0.0 if end == math.inf else end**rise
    return (at_end - start**rise) / rise
