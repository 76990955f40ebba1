"""The bodies of a state: its surface, and the lines of its spectrum with the same waves."""

from __future__ import annotations

import math
from dataclasses import replace
from functools import lru_cache

import roughline as rl
from roughline.lab.explore.state import ExploreState

LINES = 20
"""Lines whose mean stiffness stands for the reduced model."""
_SPRINGS_PER_POINT = 32
_FEWEST_SPRINGS = 2**13


def spectrum_of(state: ExploreState, n: int) -> rl.SelfAffine:
    """The spectrum of a state, with the waves that n points carry. [m]"""
    return _spectrum(state, n, rms_height(state))


def surface_of(state: ExploreState, n: int) -> rl.Surface:
    """The surface of a state on n points along a side. [m]"""
    return _surface(spectrum_of(state, n), n, state.seed)


def lines_of(state: ExploreState, count: int = LINES) -> tuple[rl.Line, ...]:
    """Lines of the spectrum of a state, with the waves of its surface. [m]"""
    springs = max(_FEWEST_SPRINGS, _SPRINGS_PER_POINT * state.n)
    return _lines(spectrum_of(state, state.n), springs, state.seed, count)


def rms_height(state: ExploreState) -> float:
    """Rms height of a state, given or from its rms slope on its grid. [m]"""
    if state.rms == "height":
        return state.h * state.length
    slope = _surface(_spectrum(state, state.n, 1.0), state.n, state.seed).rms_slope
    return state.slope / slope


def hardness(state: ExploreState) -> float | None:
    """Hardness of a state, the same on every grid; None if both bodies are elastic. [Pa]"""
    if state.hardness_bar is None:
        return None
    return state.hardness_bar * state.E_star * rms_slope(state)


def rms_slope(state: ExploreState) -> float:
    """Rms slope of a state on its grid. [1]"""
    return state.slope if state.rms == "slope" else surface_of(state, state.n).rms_slope


def most_force_bar(state: ExploreState) -> float:
    """Dimensionless force under which all of the area would yield. [1]"""
    borne = hardness(state)
    if borne is None:
        return math.inf
    return borne * state.length / (state.E_star * rms_height(state))


def _spectrum(state: ExploreState, n: int, height: float) -> rl.SelfAffine:
    q_low = 2 * math.pi / state.length
    return rl.SelfAffine(
        fractal_dimension=state.D_f,
        length=state.length,
        rms_height=height,
        q_roll=q_low / state.roll_off,
        q_high=q_low * min(1 / state.cutoff, n / 2),
    )


@lru_cache(maxsize=4)
def _surface(spectrum: rl.SelfAffine, n: int, seed: int) -> rl.Surface:
    return replace(spectrum.surface(n, seed), unit="m")


@lru_cache(maxsize=2)
def _lines(spectrum: rl.SelfAffine, springs: int, seed: int, count: int) -> tuple[rl.Line, ...]:
    return tuple(spectrum.line(springs, seed + i) for i in range(count))
