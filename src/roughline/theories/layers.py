"""How layers feel a roughness, for theories that ask for the pressures of full contact.

In full contact a wave h takes the pressure h / C(q) and stores the energy h² / (2 C(q)), with the
displacement C over the pressure. Of a homogeneous half-space C is 2 / (E* q). So layers take the
wave as that takes one of the wavenumber 2 / (E* C(q)), which is the only one that Persson's theory
asks for.

This form is derived here, from full contact alone. Persson treats layers in [1]_, and a modulus
that depends on the depth in section 5 of [2]_; the form was not compared with the equations there.
What judges it are its limits, plain integrals over the pressures of full contact, and the full
model.

References
----------
.. [1] B. N. J. Persson, "Contact mechanics for layered materials with randomly rough surfaces",
   J. Phys.: Condens. Matter 24, 095008 (2012).
.. [2] B. N. J. Persson, "Contact mechanics for randomly rough surfaces", Surf. Sci. Rep. 61,
   201-227 (2006).
"""

from __future__ import annotations

from dataclasses import replace

from roughline.halfspace.elasticity.half_space import HalfSpace
from roughline.spectra.moments import Bands

HOLDS_UP_TO = 1.1
"""Stiffening up to which the theory was found as accurate as of a homogeneous body."""

_STIFFENING_ROUNDING = 1e-9


def effective_roughness(spectrum: Bands, half_space: HalfSpace) -> Bands:
    """The roughness that a homogeneous half-space of E* would have to feel to respond alike."""
    return replace(spectrum, q=spectrum.q * (half_space.modulus(spectrum.q) / half_space.E_star))


def stiffening(spectrum: Bands, half_space: HalfSpace) -> float:
    """Energy of full contact with a half-space over that with what lies at its surface. [1]"""
    waves = effective_roughness(spectrum, half_space)
    return float(waves.q @ waves.power) / float(spectrum.q @ spectrum.power)


def is_even(ratio: float) -> bool:
    """Whether a stiffening is none, as of layers that are of one material or thick."""
    return abs(ratio - 1) < _STIFFENING_ROUNDING


def on_layers(ratio: float) -> str:
    """What to add to a validity for a stiffening."""
    if is_even(ratio):
        return ""
    found = (
        "area was found to be 0.65 to 1.2 times, stiffness 0.75 to 1.25 times that of the solved "
        "contact"
        if ratio <= HOLDS_UP_TO
        else f"above {HOLDS_UP_TO:g}, area was found to be down to 0.25 times, stiffness 0.7 to 2 "
        "times that of the solved contact"
    )
    return f"; these waves are met {ratio:.2g} times as stiffly as by the top layer alone: {found}"
