"""A layer of another material on the body."""

from __future__ import annotations

from dataclasses import dataclass

import roughline as rl
from roughline.lab.controls import ControlError, as_code
from roughline.lab.explore.controls import DECLARED
from roughline.lab.explore.state import (
    FIGURES,
    AddedCode,
    ExploreState,
    Physics,
    StripWords,
    figures,
)
from roughline.report.values import figure, up_to_three_digits

_THINNEST_LAYER = 0.5  # of a cell, below which the library refuses a layer


@dataclass(frozen=True)
class LayerPhysics(Physics):
    """A layer that is bonded to the body; the rough surface is rigid."""

    t: float
    E_l: float
    nu_l: float
    nu_b: float

    key = "t"
    tick = "a layer lies on the body"
    meaning = (
        "A layer of another material is bonded to the flat body. E* stays that of the body below, "
        "the base: F̄, k / (E* L), p_c, the hardness and the work of adhesion are over it."
    )
    controls = (DECLARED["t"], DECLARED["E_l"], DECLARED["nu_l"], DECLARED["nu_b"])
    unlike = "on the homogeneous base"
    strip = figures("layer")

    def half_space(self, state: ExploreState) -> rl.HalfSpace:
        """The layer on its base."""
        return rl.Layered(*self._constants(state), periodic=state.periodic)

    def _constants(self, state: ExploreState) -> tuple[float, float, float, float, float]:
        """Young's modulus, Poisson's ratio and thickness of the layer, and those of the base."""
        return (
            *(self.in_si("E_l", state) * (1 - self.nu_l**2), self.nu_l, self.in_si("t", state)),
            *(state.E_star * (1 - self.nu_b**2), self.nu_b),
        )

    def check(self, state: ExploreState) -> None:
        """Refuse a layer that the grid does not resolve."""
        if not self.is_resolved(state, state.n):
            least = _THINNEST_LAYER / state.n
            raise ControlError(
                f"a layer of {self.t:.3g} sides is less than half a cell of {state.n} points, "
                f"where its base alone is felt: give {least:.3g} or more, or take more points",
                "t",
                "n",
            )

    def is_resolved(self, state: ExploreState, n: int) -> bool:
        """Whether it is half a cell thick."""
        return self.t * n >= _THINNEST_LAYER

    def words(self, pressed: rl.SurfaceCurve, fields: rl.Fields, state: ExploreState) -> StripWords:
        """Its thickness on the grid, and its modulus."""
        thickness = up_to_three_digits(self.in_si("t", state), None, "m")
        modulus = up_to_three_digits(self.in_si("E_l", state), None, "Pa")
        cells = self.t * len(fields.gap)
        yield FIGURES["layer"].in_words(f"{figure(cells)} cells", f"{thickness}, E*_l {modulus}")

    def code(self, state: ExploreState) -> AddedCode:
        """The layer on its base, under a rigid surface."""
        names = ("young", "poisson", "thickness", "base_young", "base_poisson")
        values = young, poisson, thickness, base, of_base = [
            as_code(each) for each in self._constants(state)
        ]
        arguments = [f"{name}={value}" for name, value in zip(names, values, strict=True)]
        arguments += ["periodic=True"] * state.periodic
        layered = "\n".join(f"    {each}," for each in arguments)
        layer = f"E={young} Pa nu={poisson} {thickness} m"
        return AddedCode(
            half_space=f"half_space = rl.Layered(\n{layered}\n)\n",
            materials=f"rigid, {layer} on E={base} Pa nu={of_base}",
        )
