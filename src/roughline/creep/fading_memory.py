"""What is left of an input of long ago: a constant and exponentials of the time since."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from roughline.computing.arrays import Real

_TIME_PRECISION = 1e-30  # of zeros in a piece of time; exponentials may be as short


@dataclass(frozen=True, eq=False)
class FadingMemory:
    """What an input of long ago still does: f(t) = end + sum of weights exp(-rates t), for t >= 0.

    The rates rise. Boltzmann's superposition of a history x is int f(t - s) dx(s). Histories are
    straight between given times, and step from zero to their first value at the first time.
    """

    end: float
    weights: Real
    rates: Real

    def at(self, t: Real) -> Real:
        """The function at times."""
        return self.end + np.exp(-np.multiply.outer(t, self.rates)) @ self.weights

    def mean(self, near: Real, far: Real) -> Real:
        """The mean of the function from times to later ones."""
        fading = np.exp(-np.multiply.outer(near, self.rates))
        faded = fading * _mean_of_fading(np.multiply.outer(far - near, self.rates))
        return self.end + faded @ self.weights

    def remembered(self, times: Real, values: Real) -> Real:
        """Return int exp(-rates (t - s)) dx(s) of a history at its times, shape (times, rates)."""
        found = np.empty((times.size, self.rates.size))
        state = np.full(self.rates.size, values[0])
        steps, changes = np.diff(times, prepend=times[0]), np.diff(values, prepend=values[0])
        for i, (step, change) in enumerate(zip(steps.tolist(), changes.tolist(), strict=True)):
            faded = self.rates * step
            state = state * np.exp(-faded) + change * _mean_of_fading(faded)
            found[i] = state
        return found

    def superposed(self, times: Real, values: Real) -> Real:
        """Return int f(t - s) dx(s) of a history at its times."""
        return self.end * values + self.remembered(times, values) @ self.weights

    def slope_of_superposed(self, rate: float, remembered: Real) -> FadingMemory:
        """Return d/dt int f(t - s) dx(s) over the time since x has changed at an even rate.

        What is remembered is that from before.
        """
        weights = self.weights * (rate - self.rates * remembered)
        return FadingMemory(self.end * rate, weights, self.rates)

    def zeros(self, length: float) -> list[float]:
        """Return the times between zero and `length` at which the function changes its sign.

        They lie between those of its derivative. Over the slowest exponential, the derivative is
        such a function of one exponential less.
        """
        if not self.rates.size:
            return []
        from scipy.optimize import brentq  # here because it loads slowly

        steeper = self.weights * self.rates
        slope = FadingMemory(steeper[0], steeper[1:], self.rates[1:] - self.rates[0])
        ends = np.array([0.0, *slope.zeros(length), length])
        signs = np.sign(self.at(ends))
        precise = {
            "xtol": _TIME_PRECISION * length,
            "rtol": 4 * np.finfo(float).eps,
            "maxiter": 500,
        }
        return [
            float(brentq(lambda t: float(self.at(np.array(t))), *ends[i : i + 2], **precise))
            for i in np.flatnonzero(signs[:-1] * signs[1:] < 0)
        ]


def _mean_of_fading(x: Real) -> Real:
    """Mean of exp(-t) from zero to x."""
    return np.where(x > 0, -np.expm1(-x) / np.where(x > 0, x, 1.0), 1.0)
