"""Both models for one roughness, a spectrum or a measured surface, and the trust map's entry."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

from roughline.comparison.models import Comparison, compare
from roughline.comparison.trust import Difference, trust_map
from roughline.errors import InputError
from roughline.errors.checks import refuse
from roughline.measurement.homogeneity import ISOTROPIC_FROM
from roughline.spectra.isotropic import isotropy
from roughline.spectra.self_affine import SelfAffine
from roughline.statistics.verdict import Verdict
from roughline.topography.body import Body, Line, Surface


@dataclass(frozen=True)
class NamedBody:
    """A body that was read, and what its file is called."""

    body: Body
    name: str


@dataclass(frozen=True)
class ModelComparison:
    """What a comparison gave."""

    what: str  # was compared
    comparison: Comparison
    tolerance: float  # relative difference up to which the two models count as agreeing
    from_map: list[Difference | None]  # of the trust map, by load; None outside, and for surfaces

    @property
    def verdicts(self) -> list[Verdict]:
        """Whether the models agree within the tolerance, load by load."""
        return [each.verdict(self.tolerance) for each in self.comparison.differences()]


def compare_models(
    roughness: SelfAffine | NamedBody,
    *,
    n: int = 256,
    surfaces: int = 20,
    force_bars: list[float] | None = None,
    tolerance: float = 0.1,
    seed: int = 0,
    progress: Callable[[int, int], None] | None = None,
) -> ModelComparison:
    """Compare the two models for a spectrum or for a surface that was read.

    Models count as agreeing up to a relative difference, the tolerance; progress is told of
    (surfaces done, surfaces in all). The rest is as for :func:`roughline.compare`.
    """
    if not 0 < tolerance < 1:
        refuse("tolerance", tolerance, "a share between 0 and 1 is needed")
    if isinstance(roughness, SelfAffine):
        body: SelfAffine | Surface = roughness
        what = (
            f"{surfaces} surfaces of {n} x {n} points, D_f = {roughness.fractal_dimension:g}, "
            f"q_roll / q_0 = {roughness.q_roll / roughness.q_low:.3g}"
        )
    else:
        if isinstance(roughness.body, Line):
            raise InputError(f"{roughness.name} holds a line; the models are compared on a surface")
        body, what = roughness.body, _what_is_in(roughness.name, roughness.body)
    result = compare(
        body, n=n, surfaces=surfaces, force_bars=force_bars, rng=seed, progress=progress
    )
    from_map = [_on_map(body, force_bar) for force_bar in result.force_bar]
    return ModelComparison(what, result, tolerance, from_map)


def _what_is_in(name: str, surface: Surface) -> str:
    """Say what is compared, and whether a spectrum without directions stands for it."""
    what = f"{name}, {surface.shape[0]} x {surface.shape[1]} points, and lines of its spectrum"
    if (ratio := isotropy(surface)) < ISOTROPIC_FROM:
        what += (
            f"; its rms slope depends on direction, the least is {ratio:.2f} of the largest: a "
            "spectrum averaged over directions does not describe such a surface"
        )
    return what


def _on_map(body: SelfAffine | Surface, force_bar: float) -> Difference | None:
    if isinstance(body, Surface):
        return None
    try:
        return trust_map().at(body.fractal_dimension, force_bar, body.q_roll / body.q_low)
    except InputError:  # outside the map, which is no fault of the comparison
        return None
