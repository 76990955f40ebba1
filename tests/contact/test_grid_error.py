"""The estimated discretisation error covers the true one."""

import numpy as np
import pytest

import roughline as rl
from benchmarks.made_surfaces import Make, parent_of
from roughline.contact.grid_error import grid_steepening
from roughline.contact.terraces import with_whole_plateaus
from roughline.exact.indenters import PowerLawIndenter
from roughline.spectra.moments import bands
from roughline.theories.layers import effective_roughness

CLAIMED_ON_64 = np.array([0.109, 0.017, 0.060])  # of the sphere below, on 64 x 64 points
PUNCH = 1.15230  # k / (E* L) of a square punch, tests/exact


@pytest.mark.parametrize("n", [16, 32, 64])
def test_it_covers_the_punch(n):
    surface = rl.Surface(np.zeros((n, n)), (1.0, 1.0))
    curve = rl.press(surface, E_star=1.0, forces=[1.0], grid_error=True)
    error = abs(curve.stiffness[0] - PUNCH)
    assert error <= curve.stiffness_error[0] < 3 * error
    assert curve.area_fraction_error[0] == 0


@pytest.mark.parametrize("n", [64, 128, 256])
def test_it_covers_hertz(n):
    x = (np.arange(n) + 0.5) / n - 0.5
    surface = rl.Surface(-(x[:, np.newaxis] ** 2 + x**2), (1.0, 1.0))
    sphere = PowerLawIndenter(2.0, 1.0, E_star=1.0)
    radii = np.array([0.08, 0.15, 0.25, 0.35])
    forces = np.array([sphere.force(sphere.depth(radius)) for radius in radii])
    curve = rl.press(surface, E_star=1.0, forces=forces, grid_error=True)
    assert (np.abs(curve.stiffness - 2 * radii) <= curve.stiffness_error).all()
    area = np.pi * radii**2
    assert (np.abs(curve.area_fraction_corrected - area) <= curve.area_fraction_error).all()
    # an area of so many points scatters as a count does
    points = curve.area_fraction_corrected * n**2
    scatter = np.log1p(curve.area_fraction_error / curve.area_fraction_corrected)
    assert (scatter >= 1 / np.sqrt(points)).all()
    # the perimeter correction brings the area nearer on average
    raw, corrected = (
        np.abs(found / area - 1).mean()
        for found in (curve.area_fraction, curve.area_fraction_corrected)
    )
    assert corrected < raw


@pytest.mark.parametrize("n", [32, 128])
@pytest.mark.parametrize("hurst", [0.3, 0.8])
@pytest.mark.parametrize("is_cut", [False, True])
def test_it_covers_a_rough_surface_refined_with_the_same_seed(n, hurst, is_cut):
    q_high = 2 * np.pi * 3 / 16 * n if is_cut else None
    spectrum = rl.SelfAffine(hurst=hurst, rms_height=1.0, q_high=q_high)
    forces = [0.01, 0.1, 1.0]
    curve = rl.press(spectrum.surface(n, 11), E_star=1.0, forces=forces, grid_error=True)
    finer = rl.press(spectrum.surface(4 * n, 11), E_star=1.0, forces=forces)
    assert (np.abs(curve.stiffness - finer.stiffness) <= curve.stiffness_error).all()
    difference = np.abs(curve.area_fraction_corrected - finer.area_fraction_corrected)
    assert (difference <= curve.area_fraction_error).all()
    # cells that touch overstate the area, and finer waves take away from it
    assert (finer.area_fraction_corrected <= curve.area_fraction).all()


@pytest.mark.parametrize("hardness", [None, 0.05])
def test_the_error_under_a_load_does_not_depend_on_the_loads_after_it(hardness):
    """Such as those on the way back to none, which say nothing of it."""
    surface = rl.SelfAffine(hurst=0.8, rms_height=0.02).surface(64, 7)
    force = 0.05 * surface.rms_height
    alone, unloaded = (
        rl.press(surface, E_star=1.0, hardness=hardness, forces=forces, grid_error=True)
        for forces in ([force], [force, 0.75 * force, 0.5 * force, 0.1 * force, 0.0])
    )
    assert (alone.plastic_fraction[0] > 0.1) == (hardness is not None)
    if hardness is not None:  # the stiffness on loading is the less certain of both
        assert (alone.stiffness_error / alone.stiffness)[0] >= (
            alone.unloading_stiffness_error / alone.unloading_stiffness
        )[0]
    for name in ("stiffness_error", "unloading_stiffness_error", "area_fraction_error"):
        assert getattr(alone, name)[0] == pytest.approx(getattr(unloaded, name)[0], rel=1e-3)
        assert getattr(alone, name)[0] > 0


def test_a_grating_that_only_the_last_grid_resolves_has_an_error_of_its_own_size():
    """The coarser grids are flat: their slopes are none, and their difference is none."""
    heights = np.tile([0.0, 0.01], (32, 16))
    curve = rl.press(rl.Surface(heights, (1.0, 1.0)), E_star=1.0, forces=[1e-3], grid_error=True)
    area = curve.area_fraction_corrected[0]
    assert 0.4 < area < 0.6
    assert area + curve.area_fraction_error[0] >= 1.0  # that of the coarser grids


def test_near_full_contact_errors_are_those_of_compliances():
    """Coarser grids are in full contact before: the logarithm of their stiffness has no value."""
    surface = rl.SelfAffine(hurst=0.8, rms_height=0.01, q_high=2 * np.pi * 30).surface(64, 5)
    spectrum = np.fft.fft2(surface.heights)
    q = 2 * np.pi * np.hypot(*np.meshgrid(*[np.fft.fftfreq(64, 1 / 64)] * 2, indexing="ij"))
    closing = -np.fft.ifft2(q / 2 * spectrum).real.min()  # mean pressure that closes all gaps
    curve = rl.press(
        surface, E_star=1.0, forces=[0.97 * closing, 1.01 * closing], periodic=True, grid_error=True
    )
    k, error = curve.stiffness, curve.stiffness_error
    assert np.isfinite(k[0])
    assert np.isinf(k[1])
    assert 2 * k[0] <= error[0] < np.inf  # twice the compliance, at least
    assert error[1] == 0  # full contact on all grids


@pytest.mark.parametrize("hurst", [0.2, 0.5, 0.8])
def test_a_grid_four_times_finer_is_as_steep_as_three_coarser_ones_tell(hurst):
    coarse, fine = quarter_of(rl.SelfAffine(hurst=hurst, rms_height=1.0).surface(256, 5))
    found = grid_steepening(coarse)
    assert found == pytest.approx(fine.rms_slope / coarse.rms_slope, rel=0.06)
    # means of two by two points add to the mean square slope what those of four by four did, times
    # one factor
    half = coarse.coarsened()
    slopes = [each.rms_slope for each in (half.coarsened(), half, coarse)]
    before, last = np.diff(np.square(slopes))
    added = last * (last / before + (last / before) ** 2)
    assert found == pytest.approx(np.hypot(slopes[2], np.sqrt(added)) / slopes[2], rel=1e-9)


def covered_by(curve, finer):
    """Which resolved loads have the value of the finer grid in their intervals, by quantity."""
    found = {}
    for name, error in (
        ("stiffness", "stiffness_error"),
        ("area_fraction_corrected", "area_fraction_error"),
    ):
        value = getattr(curve, name)
        with np.errstate(divide="ignore"):  # in full contact on the coarser grid alone
            off = np.abs(np.log(getattr(finer, name) / value))
        found[name] = (off <= np.log1p(getattr(curve, error) / value))[curve.resolved].tolist()
    return found


@pytest.mark.parametrize("periodic", [False, True])
@pytest.mark.parametrize("base", [0.01, 100.0])
def test_it_covers_a_layer_of_few_cells_harder_or_softer_than_its_base(base, periodic):
    """Hard ones bend as plates do, and meet short waves stiffly."""
    spectrum = rl.SelfAffine(hurst=0.5, rms_height=1.0)
    coarse, fine = spectrum.surface(32, 4000), spectrum.surface(128, 4000)
    layer = rl.Layered(1.0, 0.3, 2 / 32, base, 0.3, periodic=periodic)
    waves = effective_roughness(bands(fine), layer)
    steepness = np.sqrt(waves.q**2 @ waves.power) * layer.E_star
    loads = {"half_space": layer, "forces": steepness * np.geomspace(0.01, 0.3, 4)}
    curve = rl.press(coarse, grid_error=True, **loads)
    for quantity, inside in covered_by(curve, rl.press(fine, **loads)).items():
        assert len(inside) >= 3
        assert all(inside), quantity


def quarter_of(surface):
    """Means of four by four points, and the part of the surface that has them."""
    whole = surface.cropped(*((0, n - n % 16) for n in surface.shape))
    return whole.coarsened().coarsened(), whole


LEAST_COVERED = {  # of 13, 19 and 12 resolved loads: stiffnesses, areas
    "opd-1.opd": (13, 13),
    "di-1.di": (17, 18),
    "al3d-1.al3d": (11, 12),
}


@pytest.mark.parametrize("name", LEAST_COVERED)
def test_it_covers_measured_maps_averaged_over_four_by_four_points(topographies, name):
    """As often as with a growth that was taken from all loads together."""
    whole = rl.prepared(rl.read(topographies / name))
    covered = {"stiffness": [], "area_fraction_corrected": []}
    for rows in ((0, whole.shape[0] // 2), (whole.shape[0] // 2, whole.shape[0])):
        for columns in ((0, whole.shape[1] // 2), (whole.shape[1] // 2, whole.shape[1])):
            coarse, fine = quarter_of(whole.cropped(rows, columns))
            forces = np.geomspace(0.003, 1.0, 6) * fine.rms_height * fine.length
            curve = rl.press(coarse, E_star=1.0, forces=forces, grid_error=True)
            finer = rl.press(fine, E_star=1.0, forces=forces)
            for quantity, inside in covered_by(curve, finer).items():
                covered[quantity] += inside
    for inside, least in zip(covered.values(), LEAST_COVERED[name], strict=True):
        assert sum(inside) >= least


def test_it_covers_noise_that_goes_on_below_the_spacing():
    """Differences of the rms slope grow from grid to grid, and tell that those of areas will."""
    rough = rl.SelfAffine(hurst=0.8, rms_height=1.0).surface(256, 3000)
    noise = 0.3 * np.random.default_rng(3000).standard_normal(rough.shape)
    coarse, fine = quarter_of(rl.Surface(rough.heights + noise, rough.sizes))
    assert grid_steepening(coarse) > 3 * grid_steepening(quarter_of(rough)[0])
    forces = [0.05, 0.2, 1.0]
    curve = rl.press(coarse, E_star=1.0, forces=forces, grid_error=True)
    finer = rl.press(fine, E_star=1.0, forces=forces)
    for quantity, inside in covered_by(curve, finer).items():
        assert len(inside) == 3
        assert all(inside), quantity


@pytest.mark.parametrize("n", [32, 64])
@pytest.mark.parametrize("hardness_bar", [0.3, 0.05])
def test_it_covers_a_rough_surface_that_yields(n, hardness_bar):
    """Its stiffness on loading, that on unloading, and its area."""
    spectrum = rl.SelfAffine(hurst=0.2, rms_height=1.0)
    coarse, fine = spectrum.surface(n, 2000), spectrum.surface(4 * n, 2000)
    hardness = hardness_bar * fine.rms_slope
    loads = {"E_star": 1.0, "hardness": hardness}
    loads["forces"] = hardness * np.array([0.01, 0.05, 0.2, 0.4])
    curve, finer = rl.press(coarse, grid_error=True, **loads), rl.press(fine, **loads)
    for name, error in (
        ("stiffness", "stiffness_error"),
        ("unloading_stiffness", "unloading_stiffness_error"),
        ("area_fraction_corrected", "area_fraction_error"),
    ):
        factor = 1 + getattr(curve, error) / getattr(curve, name)
        true = getattr(finer, name) / getattr(curve, name)
        assert ((1 / factor <= true) & (true <= factor)).all(), name


def test_grids_that_cannot_be_halved_twice_are_refused():
    surface = rl.Surface(np.random.default_rng(0).normal(size=(15, 32)), (1.0, 1.0))
    with pytest.raises(rl.InputError, match="15 x 32: give at least 16 a side"):
        rl.press(surface, E_star=1.0, forces=[1.0], grid_error=True)


@pytest.mark.parametrize("n", [65, 66, 67])
def test_points_need_not_be_multiples_of_four(n):
    x = (np.arange(n) + 0.5) / n - 0.5
    sphere = PowerLawIndenter(2.0, 1.0, E_star=1.0)
    radii = np.array([0.15, 0.25, 0.35])
    forces = np.array([sphere.force(sphere.depth(radius)) for radius in radii])
    round_ = rl.Surface(-(x[:, np.newaxis] ** 2 + x**2), (1.0, 1.0))
    curve = rl.press(round_, E_star=1.0, forces=forces, grid_error=True)
    assert (np.abs(curve.stiffness - 2 * radii) <= curve.stiffness_error).all()
    assert (curve.stiffness_error / curve.stiffness < 1.1 * CLAIMED_ON_64).all()
    area = np.pi * radii**2
    assert (np.abs(curve.area_fraction_corrected - area) <= curve.area_fraction_error).all()
    flat = rl.Surface(np.full((n, n), 0.3), (1.0, 1.0))  # stays flat on every grid
    punch = rl.press(flat, E_star=1.0, forces=[1.0], grid_error=True)
    error = abs(punch.stiffness[0] - PUNCH)
    assert error <= punch.stiffness_error[0] < 3 * error


HALF_ELASTIC = (
    0.06,
    0.1,
    0.15,
    0.25,
)  # H / (E* ∇h): finer grids yield where the coarse one does not


@pytest.mark.parametrize("hardness_bar", HALF_ELASTIC)
def test_yield_of_waves_that_a_finer_grid_adds_is_covered(hardness_bar):
    """Yield changes k_u most where the surface is elastic and the finer grid is not."""
    off, claimed = [], []
    for seed, hurst in ((9002, 0.2), (9003, 0.4)):
        spectrum = rl.SelfAffine(hurst=hurst, rms_height=1.0, q_roll=12 * np.pi)
        coarse, fine = spectrum.surface(64, seed), spectrum.surface(256, seed)
        loads = {"E_star": 1.0, "hardness": hardness_bar * fine.rms_slope}
        loads["forces"] = [0.03, 0.1, 0.3, 1.0]
        curve = rl.press(coarse, grid_error=True, **loads)
        found, error = curve.unloading_stiffness, curve.unloading_stiffness_error
        off += np.abs(np.log(rl.press(fine, **loads).unloading_stiffness / found)).tolist()
        claimed += np.log1p(error / found).tolist()
    assert np.median(off) > 0.05  # more than the differences of elastic grids
    assert (np.array(off) <= claimed).all()
    assert np.median(claimed) < 4 * np.median(off)


def test_a_body_that_yields_nowhere_has_the_errors_of_an_elastic_one():
    surface = rl.SelfAffine(hurst=0.5, rms_height=0.01).surface(32, 1)
    elastic, hard = (
        rl.press(surface, E_star=1.0, forces=[1e-3], hardness=hardness, grid_error=True)
        for hardness in (None, 1e3)
    )
    for name in ("stiffness_error", "unloading_stiffness_error", "area_fraction_error"):
        np.testing.assert_array_equal(getattr(hard, name), getattr(elastic, name))


def test_means_of_a_turned_surface_are_covered():
    """Means lose the ridges between feed marks in a way of which one difference tells little."""
    make = Make(points=256, maps=1, hurst=0.6, waves=6.0, cells=8.0)
    coarse, fine = quarter_of(parent_of("turned", make, np.random.default_rng(15)))
    forces = np.geomspace(0.01, 1.0, 5) * fine.rms_height * fine.length
    curve = rl.press(coarse, E_star=1.0, forces=forces, grid_error=True)
    finer = rl.press(fine, E_star=1.0, forces=forces)
    for quantity, inside in covered_by(curve, finer).items():
        assert len(inside) >= 4
        assert all(inside), quantity


def terraced(seed, n=128):
    """Plateaus of six heights, whose shares are equal, on points four times finer than a map."""
    make = Make(n, 1, hurst=0.7, waves=4.0, cells=16.0)
    rough = make.rough(np.random.default_rng(seed))
    levels = np.digitize(rough, np.quantile(rough, np.arange(1, 6) / 6))
    return rl.Surface(1e-3 * levels, (1.0, 1.0), is_cut_out=True)


@pytest.mark.parametrize("seed", range(3))
def test_it_covers_plateaus_whose_rims_pixels_lose(seed):
    fine = terraced(seed)
    coarse = fine.coarsened().coarsened()
    loads = {"E_star": 1.0, "forces": [3e-6, 3e-5, 3e-4]}
    curve, finer = rl.press(coarse, grid_error=True, **loads), rl.press(fine, **loads)
    assert (finer.stiffness <= curve.stiffness + curve.unloading_stiffness_error).all()


def test_edges_are_raised_to_the_highest_of_their_points():
    fine = terraced(1, 256)
    coarse = fine.coarsened().coarsened()
    highest = fine.heights.reshape(64, 4, 64, 4).max((1, 3))
    raised = with_whole_plateaus(coarse).heights
    assert (raised >= coarse.heights).all()
    # but for pixels across two edges, far from the upper plateau
    reached = [
        (each >= highest - 1e-9 * np.ptp(highest)).mean() for each in (coarse.heights, raised)
    ]
    assert reached[0] < 0.4
    assert reached[1] > 0.85
    for other in (fine, rl.SelfAffine(hurst=0.7, rms_height=1.0).surface(64, 1)):
        assert with_whole_plateaus(other) is None  # points, and a surface without plateaus
