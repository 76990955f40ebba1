"""A layer of another material on the body."""

from __future__ import annotations

from dataclasses import dataclass

import roughline as rl
from roughline.lab.controls import ControlError, Number, as_code
from roughline.lab.explore.controls import over_side, poissons_ratio
from roughline.lab.explore.state import AddedCode, ExploreState, Physics, StripFigure, StripWords
from roughline.report.values import figure, up_to_three_digits

_THINNEST_LAYER = 0.5  # of a cell, below which the library refuses a layer
_LAYER = StripFigure(
    "layer",
    "layer",
    "Thickness of the layer in cells of this grid; with its unit, and the contact modulus of the "
    "layer, below.",
    after="roughness",
)


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
    controls = (
        over_side(
            key="t",
            symbol="t/L",
            name="thickness of the layer",
            low=2e-3,
            high=1.0,
            default=0.05,
            meaning="Thickness of the layer. Relative to the side of the surface, or with a unit: "
            "2 um. It has to be half a cell of the grid at least.",
        ),
        Number(
            key="E_l",
            symbol="E*_l/E*",
            name="modulus of the layer",
            low=1e-3,
            high=1e3,
            default=0.1,
            meaning="Contact modulus E/(1-ν²) of the layer over E*, which is that of the base; or "
            "with a unit: 110 GPa.",
            unit="Pa",
            state_scale=lambda state: float(state.E_star),
            over="E*",
        ),
        poissons_ratio(
            key="nu_l",
            symbol="ν_l",
            name="Poisson's ratio of the layer",
            meaning="Of the layer, without unit, at the same contact modulus; at 0.5 it keeps its "
            "volume.",
        ),
        poissons_ratio(
            key="nu_b",
            symbol="ν_b",
            name="Poisson's ratio of the base",
            meaning="Of the base, without unit, at the same contact modulus.",
        ),
    )
    unlike = "on the homogeneous base"
    strip = (_LAYER,)

    def half_space(self, state: ExploreState) -> rl.HalfSpace:
        """The layer on its base."""
        return rl.Layered(*self._constants(state), periodic=state.periodic)

    def _constants(self, state: ExploreState) -> tuple[float, float, float, float, float]:
        """Young's modulus, Poisson's ratio and thickness of the layer, and those of the base."""
        return (
            *(self.E_l * state.E_star * (1 - self.nu_l**2), self.nu_l, self.t * state.length),
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
        thickness = up_to_three_digits(self.t * state.length, None, "m")
        modulus = up_to_three_digits(self.E_l * state.E_star, None, "Pa")
        cells = self.t * len(fields.gap)
        yield _LAYER.in_words(f"{figure(cells)} cells", f"{thickness}, E*_l {modulus}")

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
            materials=f"{layer} on E={base} Pa nu={of_base}, rigid",
        )
