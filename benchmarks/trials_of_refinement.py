"""How often intervals hold what the same surface gives on a grid four times finer.

Surfaces are self-affine: 64 x 64 points, and 256 x 256 of the same seed, or of the same layer. The
finer grid adds waves where they are rough down to the grid.
"""

import math

import numpy as np
from trials import E_STAR, Study
from trials_of_grids import GRID, rows_beside

import roughline as rl
from roughline.spectra.moments import bands
from roughline.theories.layers import effective_roughness

N = 64
KINDS = {"rough down to the grid": None, "cutoff at 16 waves": math.tau * 16}
HURSTS = (0.2, 0.5, 0.8)
ELASTIC_BARS = np.array([0.01, 0.05, 0.2, 1.0])  # F / (E* h L)
YIELDING_BARS = np.array([0.01, 0.05, 0.2, 0.4])  # F / (H L^2)
GAP_BARS = np.array([0.02, 0.06, 0.12, 0.18, 0.22])  # p / (E* times the rms slope)
LAYER_BARS = np.geomspace(0.01, 0.3, 4)
NOISE_BARS = np.array([0.05, 0.2, 1.0])
NOISE = 0.3  # of white noise, over the rms height
ELASTIC = "elastic"


def _pairs(kind, seed, **law):
    """The surface of a seed on both grids, for each Hurst exponent."""
    for hurst in HURSTS:
        spectrum = rl.SelfAffine(hurst=hurst, rms_height=1.0, q_high=KINDS[kind], **law)
        yield spectrum.surface(N, seed), spectrum.surface(4 * N, seed)


def _of(rows, *quantities):
    return (each for each in rows if each["quantity"] in quantities)


def refined_rows(kind, option, seed):
    """Stiffness and area, elastic or with a hardness over E* and the rms slope."""
    for coarse, fine in _pairs(kind, seed):
        if option == ELASTIC:
            bars, given, quantities = ELASTIC_BARS * E_STAR, {}, ("k", "A")
        else:
            hardness = float(option.removeprefix("H ")) * E_STAR * fine.rms_slope
            bars, given = YIELDING_BARS * hardness, {"hardness": hardness}
            quantities = "k", "k_u", "A"
        yield from _of(rows_beside(fine, coarse, bars, bars, **given), *quantities)


def layer_rows(kind, option, seed):
    """Layers of six tenths to eight cells, on a base that is softer or stiffer than they are."""
    rng, periodic = np.random.default_rng(seed), option.endswith("periodic")
    base = 0.01 if option.startswith("softer") else 100.0
    for coarse, fine in _pairs(kind, seed):
        thickness = 10 ** rng.uniform(np.log10(0.6), np.log10(8)) / N
        layer = rl.Layered(1.0, 0.3, thickness, base, 0.3, periodic=periodic)
        waves = effective_roughness(bands(fine), layer)
        forces = np.sqrt(waves.q**2 @ waves.power) * layer.E_star * LAYER_BARS
        yield from _of(rows_beside(fine, coarse, forces, LAYER_BARS, half_space=layer), "k", "A")


def noise_rows(kind, option, seed):
    """Means of four by four points of a surface with white noise, which goes on below them."""
    rough = rl.SelfAffine(hurst=0.8, rms_height=1.0).surface(4 * N, seed)
    noise = NOISE * np.random.default_rng(seed).standard_normal(rough.shape)
    fine = rl.Surface(rough.heights + noise, rough.sizes)
    coarse, forces = fine.coarsened().coarsened(), NOISE_BARS * E_STAR
    yield from _of(rows_beside(fine, coarse, forces, NOISE_BARS), "k", "A")


def gap_rows(kind, option, seed):
    """Mean gaps and hydraulic apertures from an open gap to sealing."""
    for coarse, fine in _pairs(kind, seed):
        forces = GAP_BARS * E_STAR * fine.rms_slope
        given = {"periodic": True, "measures": [rl.MEAN_GAP, rl.hydraulic_aperture("x")]}
        if option != ELASTIC:
            given["hardness"] = float(option.removeprefix("H ")) * E_STAR * fine.rms_slope
        yield from _of(rows_beside(fine, coarse, forces, GAP_BARS, **given), "u_m", "u_h")


def pixel_rows(kind, option, seed):
    """Maps of a made surface whose pixels lose ridges or the edges of plateaus."""
    quantities = ("k", "A") if kind == "turned" else ("u_m", "u_h")
    yield from _of(GRID.rows_of(kind, option, seed), *quantities)


def _study(rows_of, heading, kinds, options, seeds, groups):
    columns = "held", "silent", "half width"
    return Study(rows_of, heading, rows_of.__doc__, kinds, options, seeds, groups, columns)


REFINED = _study(
    refined_rows,
    "Refined with the same seed",
    (*KINDS,),
    (ELASTIC, "H 0.3", "H 0.05"),
    6,
    ("option",),
)
LAYER = _study(
    layer_rows,
    "Layers",
    (*KINDS,),
    ("softer base", "softer base, periodic", "stiffer base", "stiffer base, periodic"),
    6,
    ("option",),
)
NOISY = _study(noise_rows, "White noise", ("noise",), (ELASTIC,), 8, ("kind",))
GAP = _study(gap_rows, "Gaps", (*KINDS,), (ELASTIC, "H 0.4"), 4, ("option",))
PIXELS = _study(
    pixel_rows,
    "Pixels of made surfaces",
    ("turned", "worn", "ground, 30"),
    ("pixel means, H none", "pixel means, H 0.15"),
    8,
    ("kind",),
)
