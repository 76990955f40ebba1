"""Gap, pressure and patches of a contact: exact values, sums, and what units and borders do."""

import numpy as np
import pytest
from scipy.sparse import csgraph

import roughline as rl
from roughline.contact.patches import find_patches
from roughline.exact import westergaard

SPECTRUM = rl.SelfAffine(hurst=0.8, length=1.0, rms_height=0.01)


def sphere(n, radius=1.0, side=1.0, centre=(0.0, 0.0)):
    x, y = np.meshgrid(*[(np.arange(n) + 0.5) / n * side - side / 2] * 2, indexing="ij")
    heights = -((x - centre[0]) ** 2 + (y - centre[1]) ** 2) / (2 * radius)
    return rl.Surface(heights, (side, side), is_cut_out=False)


def pressed(surface, force, **more):
    curve = rl.press(surface, E_star=1.0, forces=[force], fields=True, **more)
    return curve, curve.fields[0]


def hertz(force, radius=1.0):
    """Contact radius and largest pressure of a sphere, E* = 1."""
    a = (3 * force * radius / 4) ** (1 / 3)
    return a, 3 * force / (2 * np.pi * a**2)


@pytest.mark.parametrize("n", [64, 128])
def test_under_a_sphere_the_density_rises_with_the_pressure(n):
    # p = p_0 sqrt(1 - r²/a²): the area with a pressure of at most p is πa² (p/p_0)²
    _, fields = pressed(sphere(n), 0.02)
    a, p_0 = hertz(0.02)
    found = fields.distribution("pressure")
    below = np.cumsum(found.shares) / (1 - found.at_zero)
    exact = np.minimum((found.edges[1:] / p_0) ** 2, 1.0)
    assert np.abs(below - exact).max() < 0.75 / (a * n)  # cells of the edge over those inside
    assert found.edges[-1] == pytest.approx(p_0, rel=0.02)
    # moments over the contact: mean 2/3 p_0, mean square 1/2 p_0²
    inside = 1 - found.at_zero
    assert found.mean / inside == pytest.approx(2 / 3 * p_0, rel=3 / (a * n))
    square = (found.std**2 + found.mean**2) / inside
    assert square == pytest.approx(p_0**2 / 2, rel=3 / (a * n))


def test_a_sphere_has_one_patch_with_its_area_force_and_place():
    _, fields = pressed(sphere(128, centre=(0.11, -0.07)), 0.02)
    patches = fields.patches()
    a, _ = hertz(0.02)
    assert patches.count == 1
    assert patches.areas[0] == pytest.approx(np.pi * a**2, rel=0.02)
    assert patches.forces[0] == pytest.approx(0.02, rel=1e-6)
    assert patches.centroids[0] == pytest.approx([0.61, 0.43], abs=0.3 / 128)


def wave(nx, ny=8, moved=0.0):
    """A wave of unit length and height 0.02 along x, its crest moved on."""
    x = (np.arange(nx) + 0.5) / nx
    heights = 0.02 * np.cos(2 * np.pi * (x - moved))
    return rl.Surface(np.repeat(heights[:, None], ny, 1), (1.0, ny / nx), is_cut_out=False)


@pytest.mark.parametrize("share", [0.2, 0.5, 0.8])
def test_under_a_wave_pressures_are_distributed_as_westergaard_says(share):
    n, half = 512, share / 2
    surface = wave(n)
    mean = westergaard.mean_pressure(half, 0.02, 1.0, 1.0)
    _, fields = pressed(surface, mean * surface.area, periodic=True)
    found = fields.distribution("pressure")
    x = (np.arange(200_000) + 0.5) / 200_000 - 0.5
    exact = np.histogram(westergaard.pressure(x, half, 0.02, 1.0, 1.0), found.edges)[0] / x.size
    exact[0] -= 1 - share  # where the bodies do not touch
    assert found.at_zero == pytest.approx(1 - share, abs=4 / n)
    assert np.abs(np.cumsum(found.shares) - np.cumsum(exact)).max() < 4 / n
    assert found.mean == pytest.approx(mean, rel=1e-6)


def test_a_patch_across_a_border_is_one_and_a_strip_has_no_place_along_itself():
    surface = wave(64)
    mean = westergaard.mean_pressure(0.1, 0.02, 1.0, 1.0)
    _, fields = pressed(surface, mean * surface.area, periodic=True)
    patches = fields.patches()
    assert fields.is_periodic
    assert patches.count == 1
    assert patches.forces[0] == pytest.approx(mean * surface.area, rel=1e-6)
    x, y = patches.centroids[0]
    assert min(x, 1 - x) < 1e-12
    assert np.isnan(y)
    assert set(np.unique(patches.labels)) == {0, 1}


def test_of_a_piece_borders_end_patches():
    contact = np.zeros((8, 8), dtype=bool)
    contact[[0, -1], 3] = True
    alone = find_patches(contact, contact * 2.0, (8.0, 4.0), periodic=False)
    assert alone.count == 2
    together = find_patches(contact, contact * 2.0, (8.0, 4.0), periodic=True)
    assert together.areas.tolist() == [1.0]
    assert together.forces.tolist() == [2.0]
    assert together.centroids[0] % 8.0 == pytest.approx([0.0, 1.75])


def test_corners_join_cells_across_both_borders():
    contact = np.zeros((6, 5), dtype=bool)
    contact[0, 0] = contact[-1, -1] = True
    patches = find_patches(contact, contact * 1.0, (6.0, 5.0), periodic=True)
    assert patches.count == 1
    assert np.isin(patches.centroids[0], [0.0, 6.0, 5.0]).all()


def brute_force(contact):
    """Number of the patch of each cell in contact, by a graph of all neighbours on the torus."""
    nx, ny = contact.shape
    number = np.arange(contact.size).reshape(nx, ny)
    graph = np.zeros((contact.size, contact.size))
    for dx, dy in ((0, 1), (1, 0), (1, 1), (1, -1)):
        other = np.roll(number, (-dx, -dy), (0, 1))
        both = contact & contact.flat[other.ravel()].reshape(nx, ny)
        graph[number[both], other[both]] = 1
    return csgraph.connected_components(graph, directed=False)[1].reshape(nx, ny)


@pytest.mark.parametrize("shape", [(7, 9), (1, 6), (12, 12), (2, 2), (3, 1)])
def test_patches_are_the_components_of_the_graph_of_neighbours(shape):
    rng = np.random.default_rng(shape)
    for density in rng.uniform(0, 1, 60):
        contact = rng.uniform(size=shape) < density
        pressure = np.where(contact, rng.uniform(0.5, 1, shape), 0.0)
        patches = find_patches(contact, pressure, (1.0, 1.0), periodic=True)
        exact = brute_force(contact)[contact]
        found = patches.labels[contact]
        assert patches.count == np.unique(exact).size
        assert len(set(zip(found, exact, strict=True))) == patches.count
        assert (np.diff(patches.areas) <= 0).all()
        for i in range(patches.count):
            mine = patches.labels == i + 1
            assert patches.areas[i] == pytest.approx(mine.sum() / contact.size)
            assert patches.forces[i] == pytest.approx(pressure[mine].sum() / contact.size)


def test_a_patch_is_found_where_it_is_moved_to():
    """Rolling a periodic contact moves every centre, and nothing else."""
    rng = np.random.default_rng(4)
    contact = rng.uniform(size=(20, 16)) < 0.25
    before = find_patches(contact, contact * 1.0, (2.0, 1.6), periodic=True)
    for steps in ((3, 0), (0, 5), (11, 9)):
        after = find_patches(
            np.roll(contact, steps, (0, 1)), contact * 1.0, (2.0, 1.6), periodic=True
        )
        assert after.areas == pytest.approx(before.areas)
        moved = (before.centroids + 0.1 * np.array(steps)) % (2.0, 1.6)
        one, other = (
            np.sort(np.round(each, 9).view("c16").ravel()) for each in (moved, after.centroids)
        )
        assert one == pytest.approx(other, nan_ok=True)


@pytest.mark.parametrize("periodic", [False, True])
@pytest.mark.parametrize("hardness", [None, 0.05])
def test_shares_and_sums_are_those_of_the_curve(periodic, hardness):
    curve, fields = pressed(SPECTRUM.surface(64, rng=2), 0.01, periodic=periodic, hardness=hardness)
    gap, pressure = fields.distribution("gap"), fields.distribution("pressure")
    for each in (gap, pressure):
        total = each.at_zero + each.at_hardness + each.shares.sum()
        assert total == pytest.approx(1.0, abs=1e-12)
        assert each.edges[0] == 0
        assert 8 <= each.density.size <= 128
    assert gap.at_zero == curve.area_fraction[0]
    assert pressure.at_zero == pytest.approx(1 - curve.area_fraction[0], abs=1e-12)
    assert pressure.mean == pytest.approx(0.01, rel=1e-6)
    assert gap.mean == pytest.approx(fields.mean_gap, rel=1e-12)
    assert gap.std == pytest.approx(np.std(np.where(fields.contact, 0, fields.gap)), rel=1e-9)
    patches = fields.patches()
    assert patches.forces.sum() == pytest.approx(0.01, rel=1e-6)
    assert patches.areas.sum() == pytest.approx(curve.area_fraction[0], rel=1e-12)


def test_yielding_pressures_are_kept_apart():
    curve, fields = pressed(SPECTRUM.surface(64, rng=2), 0.01, hardness=0.05)
    found = fields.distribution("pressure")
    share = curve.plastic_fraction[0] * curve.area_fraction[0]
    assert share > 0.01
    assert found.at_hardness == pytest.approx(share)
    assert found.edges[-1] <= 0.05


def test_the_mean_gap_falls_by_the_approach_of_periodic_bodies():
    # their mean displacement is zero, so that the mean gap is the mean distance less the approach
    surface = SPECTRUM.surface(64, rng=3)
    separation = surface.heights.max() - surface.heights.mean()
    for force in (0.003, 0.03):
        curve, fields = pressed(surface, force, periodic=True)
        assert fields.mean_gap == pytest.approx(separation - curve.depth[0], rel=1e-5)


def test_units_do_not_matter():
    surface = SPECTRUM.surface(64, rng=5)
    _, one = pressed(surface, 0.01, periodic=True)
    length, pressure = 2.0**-20, 2.0**30
    other = rl.press(
        rl.Surface(surface.heights * length, (length, length), is_cut_out=False),
        E_star=pressure,
        forces=[0.01 * pressure * length**2],
        periodic=True,
        fields=True,
    ).fields[0]
    for of, unit in (("gap", length), ("pressure", pressure)):
        before, after = one.distribution(of), other.distribution(of)
        assert after.at_zero == before.at_zero
        assert after.edges / unit == pytest.approx(before.edges, rel=1e-5)
        assert after.shares == pytest.approx(before.shares, abs=3 / 64**2)
        assert after.skewness == pytest.approx(before.skewness, rel=1e-4)
    assert other.patches().areas / length**2 == pytest.approx(one.patches().areas)
    assert other.patches().centroids / length == pytest.approx(one.patches().centroids, nan_ok=True)


def test_small_pressures_are_rare_in_proportion():
    """Persson: the density of pressures vanishes in proportion to the pressure at zero."""
    spectrum = rl.SelfAffine(hurst=0.8, length=1.0, rms_height=0.01, q_high=2 * np.pi * 4)
    found = []
    for n in (256, 512):
        _, fields = pressed(spectrum.surface(n, rng=6), 0.02, periodic=True)
        pressure = fields.pressure[fields.contact]
        bounds = np.array([0.1, 0.2, 0.3])
        below = [(pressure < each * pressure.mean()).mean() for each in bounds]
        found.append(np.array(below) / bounds**2)
    # the share below p over p²: cells at the edge add to it in the first order of their size
    assert found[0][0] > 1.1 * found[1][0]
    limit = 2 * found[1] - found[0]
    assert limit == pytest.approx(limit[1], rel=0.08)


def test_patches_are_counted_in_bins_that_double():
    contact = np.zeros((16, 16), dtype=bool)
    contact[0, 0] = contact[0, 4] = True  # two of one cell, one of 2, 3, 4 and 8
    contact[3, 0:2] = contact[6, 0:3] = contact[9, 0:4] = contact[12, 0:8] = True
    patches = find_patches(contact, contact * 1.0, (8.0, 8.0), periodic=False)
    found = patches.distribution()
    assert found.edges.tolist() == [0.125, 0.375, 0.875, 1.875, 3.875]
    assert found.shares * patches.count == pytest.approx([2, 2, 1, 1])
    assert found.mean == patches.areas.mean()
    assert found.at_zero == 0


def test_without_contact_and_in_full_contact():
    apart = rl.press(
        SPECTRUM.surface(16, rng=1), E_star=1.0, forces=[0.01, 0.0], fields=True
    ).fields[1]
    assert apart.distribution("gap").at_zero == 0
    pressure = apart.distribution("pressure")
    assert pressure.at_zero == 1
    assert pressure.edges.tolist() == [0]
    assert apart.patches().count == 0
    nothing = find_patches(np.zeros((4, 4), bool), np.zeros((4, 4)), (1.0, 1.0), periodic=True)
    assert nothing.count == 0
    assert nothing.labels.max() == 0
    assert nothing.centroids.shape == (0, 2)
    smooth = rl.Surface(1e-6 * wave(32).heights, (1.0, 0.25), is_cut_out=False)
    _, closed = pressed(smooth, 0.1, periodic=True)
    gap, pressure = closed.distribution("gap"), closed.distribution("pressure")
    assert gap.at_zero == 1
    assert gap.density.size == 0
    assert np.isnan(gap.skewness)
    assert closed.mean_gap == 0
    assert pressure.at_zero == 0
    whole = closed.patches()
    assert whole.count == 1
    assert np.isnan(whole.centroids).all()


@pytest.mark.parametrize("of", ["height", None, 3])
def test_another_field_is_refused(of):
    _, fields = pressed(SPECTRUM.surface(16, rng=1), 0.01)
    with pytest.raises(rl.InputError, match='of is .*; allowed are "gap" and "pressure"'):
        fields.distribution(of)
