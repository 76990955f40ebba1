"""Judge the flow: exact values, near sealing, the grid, luck, a rare gas: ``make permeance``.

Writes a part of ``docs/flow.md``. Nothing in it is a time: it depends on the code alone.
"""

import math
from fractions import Fraction

import numpy as np
from kinetic import kinetic
from page import Page
from scipy import sparse
from scipy.sparse import linalg

import roughline as rl
from roughline.exact import flow as exact

GRIDS = (32, 64, 128, 256, 512)
RADII = (0.1, 0.2, 0.3, 0.4)
ROUNDING = 1e-12
THROATS = (1e-1, 1e-2, 1e-3, 1e-4, 1e-6, 1e-8)
CELLS = (2, 4, 8, 16)  # for the shortest wave
SHORTEST = 32  # waves along a side, of the shortest
PRESSURES = (0.02, 0.06, 0.12, 0.18, 0.21, 0.24)  # over E* and the rms slope
SURFACES = 8  # of each grid
FREE_PATHS = (0.1, 0.25, 0.5, 1, 2, 5, 20)  # over the gap
MORE_SURFACES, ROLL_OFFS = 40, (2, 4, 8)


def middles(n):
    return (np.arange(n) + 0.5) / n


def disc(n, radius):
    """Permeance of a round contact in a square cell, over the exact one, less 1."""
    distance = np.hypot(*np.meshgrid(middles(n) - 0.5, middles(n) - 0.5))
    found = rl.flow(np.where(distance < radius, 0.0, 1.0), (1.0, 1.0)).permeance
    return found / exact.disc_in_a_square_cell(radius, 1.0) - 1


def wave(n):
    """The same for a wave of 0.8 of the mean gap, across its crests."""
    gap = np.repeat(1 + 0.8 * np.cos(2 * np.pi * middles(n))[:, np.newaxis], 2, axis=1)
    return rl.flow(gap, (1.0, 1.0)).permeance / exact.across_a_wave(1.0, 0.8) - 1


def wedge(n):
    gap = np.repeat((0.9 - 0.6 * middles(n))[:, np.newaxis], 2, axis=1)
    return rl.flow(gap, (1.0, 1.0), sides="y").permeance / exact.wedge(0.9, 0.3) - 1


def dual(n):
    """The flow along x times that of the reciprocal gap along y, less 1; of a rough gap."""
    heights = rl.SelfAffine(
        hurst=0.8, rms_height=0.5, q_roll=2 * math.tau, q_high=6 * math.tau
    ).surface(n, 3)
    gap = np.exp(heights.heights)
    first = rl.flow(gap, (1.0, 1.0), sides="closed").permeance
    return first * rl.flow(1 / gap, (1.0, 1.0), along="y", sides="closed").permeance - 1


def exact_values(page):
    page.heading("Beside exact values")
    page.say(
        "Permeance found, over the exact one, less 1. The rate is the power of 1/n with which it "
        "falls, by least squares; means over whole waves come nearer faster than any power."
    )
    page.table("gap", *(f"{n}²" for n in GRIDS), "rate", at_most=4)
    cases = {f"disc of contact, R = {R:g} of the cell": (disc, R) for R in RADII}
    cases |= {
        "wave, across its crests": (wave,),
        "wedge": (wedge,),
        "dual of a rough gap": (dual,),
    }
    for name, (error, *given) in cases.items():
        errors = [error(n, *given) for n in GRIDS]
        slope = -np.polyfit(np.log(GRIDS), np.log(np.abs(errors)), 1)[0]
        rate = "faster" if abs(errors[-1]) < ROUNDING else f"{slope:.1f}"
        page.row(name, *(f"{value:+.1e}" for value in errors), rate)


def throttled(throat, shape=(9, 8)):
    """Two rough halves that one cell joins, narrower than the others by a factor."""
    gap = np.random.default_rng(1).uniform(0.5, 1.5, shape)
    gap[shape[0] // 2] = 0.0
    gap[shape[0] // 2, 3] = throat
    return gap


def conductances(gap):
    """Pairs of cells with their conductances; -1 is the inlet, -2 the outlet. All are fractions."""
    nx, ny = gap.shape
    cubes = {
        (i, j): Fraction(float(gap[i, j])) ** 3 for i, j in np.ndindex(nx, ny) if gap[i, j] > 0
    }
    for (i, j), cube in cubes.items():
        here = i * ny + j
        for p, q in ((i + 1, j), (i, (j + 1) % ny)):
            if (p, q) in cubes:
                yield here, p * ny + q, 2 * cube * cubes[p, q] / (cube + cubes[p, q])
        if i == 0:
            yield here, -1, 2 * cube
        if i == nx - 1:
            yield here, -2, 2 * cube


def in_fractions(gap):
    """Conductance from inlet to outlet without any rounding, cell after cell eliminated."""
    nodes = {}
    for first, second, value in conductances(gap):
        for a, b in ((first, second), (second, first)):
            of = nodes.setdefault(a, {})
            of[b] = of.get(b, 0) + value
    for node in sorted(key for key in nodes if key >= 0):
        others = nodes.pop(node)
        total = sum(others.values())
        for a in others:
            del nodes[a][node]
            for b in others:
                if a != b:
                    nodes[a][b] = nodes[a].get(b, 0) + others[a] * others[b] / total
    return nodes[-1][-2]


def by_factors(gap):
    """Inflow and outflow from the pressures that SuperLU finds."""
    size, found = gap.size, list(conductances(gap))
    matrix, right = sparse.lil_matrix((size, size)), np.zeros(size)
    for first, second, value in found:
        matrix[first, first] += float(value)
        if second >= 0:
            matrix[second, second] += float(value)
            matrix[first, second] -= float(value)
            matrix[second, first] -= float(value)
        elif second == -1:
            right[first] = float(value)
    kept = matrix.diagonal() > 0
    pressure = np.zeros(size)
    pressure[kept] = linalg.splu(sparse.csc_matrix(matrix)[kept][:, kept]).solve(right[kept])
    inflow = sum(float(g) * (1 - pressure[a]) for a, b, g in found if b == -1)
    return inflow, sum(float(g) * pressure[a] for a, b, g in found if b == -2)


def near_sealing(page):
    page.heading("Near sealing")
    page.say(
        "Two rough halves that a single cell joins: errors beside the same equations solved in "
        "fractions, without rounding. SuperLU is given those equations in double precision, and "
        "its flow is taken at the inlet, where pressures are near 1, or at the outlet."
    )
    columns = ("roughline", "its imbalance", "SuperLU, inlet", "outlet")
    page.table("gap of the throat", *columns, at_most=0)
    for throat in THROATS:
        gap = throttled(throat)
        flow, reference = rl.flow(gap, (9.0, 8.0), sides="y"), in_fractions(gap)
        errors = [
            abs(float(Fraction(float(each)) / reference - 1))
            for each in (flow.inflow, *by_factors(gap))
        ]
        row = (errors[0], flow.imbalance, *errors[1:])
        page.row(f"{throat:.0e}", *(f"{value:.0e}" for value in row))


def flows(spectrum, n, seed, sides=("periodic",)):
    """Contact, and hydraulic apertures both ways between each kind of sides, under each load."""
    surface = spectrum.surface(n, seed)
    slope = spectrum.lattice(max(CELLS) * SHORTEST).rms_slope
    forces = slope * np.array(PRESSURES)
    curve = rl.press(surface, E_star=1.0, forces=forces, periodic=True, fields=True, rtol=1e-5)
    found = [
        [
            [each.hydraulic_aperture for each in rl.flow(fields, along="both", sides=kind)]
            for kind in sides
        ]
        for fields in curve.fields
    ]
    return curve.area_fraction_corrected, np.array(found)  # (loads, sides, 2)


def spectrum_with(roll):
    return rl.SelfAffine(
        hurst=0.8, rms_height=0.01, q_roll=roll * math.tau, q_high=SHORTEST * math.tau
    )


def the_grid(page):
    page.heading("The grid")
    page.say(
        f"{SURFACES} periodic surfaces, H = 0.8, roll-off at 4 waves along a side and the shortest "
        f"at {SHORTEST}, pressed with 2, 4, 8 and 16 cells for the shortest wave, both ways. "
        "Hydraulic aperture over that of the finest grid: geometric mean, and least and largest; "
        "of cases that are open on both."
    )
    all_of = {
        cells: [flows(spectrum_with(4), cells * SHORTEST, i) for i in range(SURFACES)]
        for cells in CELLS
    }
    areas = {cells: np.mean([area for area, _ in all_of[cells]], axis=0) for cells in CELLS}
    apertures = {cells: np.array([found[:, 0] for _, found in all_of[cells]]) for cells in CELLS}
    finest = apertures[CELLS[-1]]
    page.table("p/(E*∇h)", "contact", *(f"{cells} cells" for cells in CELLS[:-1]), "sealed")
    for load, pressure in enumerate(PRESSURES):
        row = []
        for cells in CELLS[:-1]:
            both = (finest[:, load] > 0) & (apertures[cells][:, load] > 0)
            row.append(spread(apertures[cells][:, load][both] / finest[:, load][both]))
        sealed = ", ".join(str(int((apertures[cells][:, load] == 0).sum())) for cells in CELLS)
        page.row(pressure, f"{areas[CELLS[-1]][load]:.0%}", *row, sealed)


def spread(ratios):
    """Geometric mean of some ratios, with the least and the largest."""
    if not ratios.size:
        return ""
    return f"{np.exp(np.log(ratios).mean()):.3f} ({ratios.min():.2f}-{ratios.max():.2f})"


def luck(page):
    page.heading("One map is one place")
    page.say(
        f"{MORE_SURFACES} periodic surfaces of each spectrum, H = 0.8, four cells for the "
        f"shortest wave ({4 * SHORTEST}²), both ways. The flow is the cube of the aperture. It "
        "lies within a factor of its middle for 90 of 100 of these maps, the root of the ratio of "
        "the 95th to the 5th percentile; there is none where one of twenty is sealed. The last "
        "columns are the apertures between closed sides over those between periodic ones, of one "
        "gap."
    )
    page.table(
        "roll-off, waves",
        "p/(E*∇h)",
        "contact",
        "sealed",
        "factor of the flow",
        "closed sides over periodic",
        "sealed by them",
        at_most=0,
    )
    for roll in ROLL_OFFS:
        found = [
            flows(spectrum_with(roll), 4 * SHORTEST, i, ("periodic", "closed"))
            for i in range(MORE_SURFACES)
        ]
        areas, apertures = (np.array(each) for each in zip(*found, strict=True))
        for load, pressure in enumerate(PRESSURES):
            periodic, closed = apertures[:, load, 0].ravel(), apertures[:, load, 1].ravel()
            low, high = np.percentile(periodic, [5, 95])
            both = (periodic > 0) & (closed > 0)
            page.row(
                roll,
                pressure,
                f"{areas[:, load].mean():.0%}",
                f"{(periodic == 0).mean():.0%}",
                f"{(high / low) ** 1.5:.2g}" if low > 0 else "",
                spread(closed[both] / periodic[both]),
                f"{(closed == 0).mean():.0%}",
            )


def a_rare_gas(page):
    page.heading("A rare gas")
    page.say(
        "Flow between flat plates by kinetic theory, the BGK equation solved, over that with slip "
        "of the first order, and over that of `rl.flow`."
    )
    page.table("mean free path over the gap", *FREE_PATHS, at_most=0)
    ratios = [kinetic(path) / (1 + 6 * path) for path in FREE_PATHS]
    plates = [rl.flow(np.ones((2, 2)), (1.0, 1.0), mean_free_path=path) for path in FREE_PATHS]
    page.row("kinetic theory over slip", *(f"{ratio:.2f}" for ratio in ratios))
    solved = [kinetic(path) / each.permeance for path, each in zip(FREE_PATHS, plates, strict=True)]
    page.row("kinetic theory over `rl.flow`", *(f"{ratio:.3f}" for ratio in solved))


def main():
    page = Page("permeance", "flow.md", "permeance")
    exact_values(page)
    near_sealing(page)
    the_grid(page)
    luck(page)
    a_rare_gas(page)
    page.save()


if __name__ == "__main__":
    main()
