"""The corrected contact area: round contacts, flat tops, and what is neither."""

import numpy as np
import pytest

import roughline as rl
from roughline.exact.indenters import PowerLawIndenter

RIGHT = 0.002  # counts of cells that are as good as this stay so
CLOSE = 0.01  # to within this
PAIR = (np.pi - 1 + np.log(2)) / 24  # Yastrebov, Anciaux and Molinari 2017


def from_centre(n, x0=0.0137, y0=-0.0071):
    x = (np.arange(n) + 0.5) / n - 0.5
    return np.hypot((x - x0)[:, np.newaxis], x - y0)


def pressed(heights, forces, **settings):
    return rl.press(rl.Surface(heights, (1.0, 1.0)), E_star=1.0, forces=forces, **settings)


def switches(contact, periodic):
    """Pairs of neighbours of which one touches, counted one by one."""
    count = 0
    for axis in (0, 1):
        rolled = np.roll(contact, -1, axis)
        differ = contact != rolled
        count += differ.sum() if periodic else np.delete(differ, -1, axis).sum()
    return count


@pytest.mark.parametrize("n", [32, 64, 128])
def test_a_square_punch_is_as_large_as_its_cells(n):
    x = np.abs((np.arange(n) + 0.5) / n - 0.5)
    inside = (x[:, np.newaxis] < 0.25) & (x < 0.25)
    curve = pressed(np.where(inside, 0.0, -10.0), [1e-3])
    assert curve.area_fraction[0] == 0.25
    assert curve.area_fraction_corrected[0] == pytest.approx(0.25, rel=1e-3)


@pytest.mark.parametrize("n", [64, 128, 256])
@pytest.mark.parametrize("radius", [0.1, 0.2, 0.3])
def test_a_disc_punch_keeps_the_count_of_its_cells(n, radius):
    curve = pressed(np.where(from_centre(n) <= radius, 0.0, -10.0), [1e-3])
    area = np.pi * radius**2
    raw, corrected = curve.area_fraction[0], curve.area_fraction_corrected[0]
    assert abs(corrected / area - 1) < abs(raw / area - 1) + 3e-3
    assert corrected == pytest.approx(area, rel=CLOSE)


@pytest.mark.parametrize("exponent", [1.0, 2.0, 4.0])
@pytest.mark.parametrize("radius", [0.05, 0.1, 0.3])
def test_round_contacts_lose_the_whole_correction(exponent, radius):
    n = 128
    indenter = PowerLawIndenter(exponent, 1.0, E_star=1.0)
    force = indenter.force(indenter.depth(radius))
    curve = pressed(-(from_centre(n) ** exponent), [force], fields=True)
    area = np.pi * radius**2
    raw, corrected = curve.area_fraction[0], curve.area_fraction_corrected[0]
    pairs = switches(curve.fields[0].contact, periodic=False)
    assert corrected == pytest.approx(raw - PAIR * pairs / n**2, rel=2e-3)
    assert abs(corrected / area - 1) < abs(raw / area - 1)


def test_many_paraboloids_side_by_side():
    """Four by four summits of one sphere each, apart enough to be Hertz's."""
    n, side, radius = 256, 0.25, 0.02
    x = (np.arange(n) + 0.5) / n % side - side / 2
    heights = -(x[:, np.newaxis] ** 2 + x**2)
    sphere = PowerLawIndenter(2.0, 1.0, E_star=1.0)
    curve = pressed(heights, [16 * sphere.force(sphere.depth(radius))], periodic=True)
    area = 16 * np.pi * radius**2
    raw, corrected = curve.area_fraction[0], curve.area_fraction_corrected[0]
    assert abs(corrected / area - 1) < 0.6 * abs(raw / area - 1)


@pytest.mark.parametrize(("hurst", "roll"), [(0.3, 2), (0.5, 4), (0.8, 1)])
def test_surfaces_whose_top_is_cut_flat(hurst, roll):
    """Judged by four times finer grids, on which all corrections are four times smaller."""
    n, q_0 = 64, 2 * np.pi
    spectrum = rl.SelfAffine(hurst=hurst, rms_height=1.0, q_roll=roll * q_0, q_high=8 * q_0)
    rough = spectrum.surface(4 * n, 11).heights
    errors = []
    for bearing in (0.1, 0.3, 0.6):
        honed = np.minimum(rough, np.quantile(rough, 1 - bearing))
        forces = [0.001, 0.01, 0.1, 0.3, 1.0]
        curve = pressed(honed[1::4, 1::4], forces, periodic=True)
        finer = pressed(honed, forces, periodic=True)
        raw, corrected = curve.area_fraction, curve.area_fraction_corrected
        truth = finer.area_fraction_corrected
        flat = np.abs(raw / truth - 1) < RIGHT
        assert (np.abs(corrected / truth - 1)[flat] < CLOSE).all()
        # under the lightest load the plateaus alone touch: points hit more or less of them
        sampled = abs(raw[0] / truth[0] - 1)
        assert (np.abs(corrected / truth - 1) < sampled + 2 * CLOSE).all()
        assert (truth <= curve.area_fraction_most).all()
        errors.append((corrected / truth - 1, raw / truth - 1))
    corrected, raw = np.swapaxes(errors, 0, 1)
    assert np.sqrt((corrected**2).mean()) < 1.5 * CLOSE
    assert np.sqrt((corrected**2).mean()) < 0.5 * np.sqrt((raw**2).mean())


@pytest.mark.parametrize("periodic", [False, True])
@pytest.mark.parametrize("hurst", [0.3, 0.8])
def test_on_rough_surfaces_the_correction_is_the_literatures(hurst, periodic):
    spectrum = rl.SelfAffine(hurst=hurst, rms_height=1.0, q_high=2 * np.pi * 12)
    surface = spectrum.surface(96, 4)
    curve = rl.press(surface, E_star=1.0, forces=[0.05, 0.3, 1.0], periodic=periodic, fields=True)
    pairs = [switches(fields.contact, periodic) for fields in curve.fields]
    whole = PAIR * np.array(pairs) / 96**2
    assert curve.area_fraction - curve.area_fraction_corrected == pytest.approx(whole, rel=0.03)
    assert (curve.area_fraction_corrected < curve.area_fraction).all()
    room = curve.area_fraction_most - curve.area_fraction_corrected
    assert room == pytest.approx(whole, rel=1e-9)


def test_plateaus_and_summits_on_one_surface_are_told_apart():
    """A disc punch beside a sphere: each keeps its own correction."""
    n = 128
    disc, ball = from_centre(n, -0.25, 0.0), from_centre(n, 0.25, 0.0)
    heights = np.maximum(np.where(disc < 0.12, 0.0, -10.0), -(ball**2))
    curve = pressed(heights, [0.03], fields=True)
    contact = curve.fields[0].contact
    left, right = contact.copy(), contact.copy()
    left[n // 2 :], right[: n // 2] = False, False
    expected = (left.sum() + right.sum() - PAIR * switches(right, periodic=False)) / n**2
    assert right.sum() > 100
    assert curve.area_fraction_corrected[0] == pytest.approx(expected, rel=3e-3)


def test_the_unit_of_length_does_not_matter():
    small = pressed(np.where(from_centre(32) < 0.2, 0.0, -1.0), [1e-3])
    heights = np.where(from_centre(32) < 0.2, 0.0, -1e-6)
    tiny = rl.press(rl.Surface(heights, (1e-6, 1e-6)), E_star=1e11, forces=[1e-3 * 1e11 * 1e-12])
    assert tiny.area_fraction_corrected == pytest.approx(small.area_fraction_corrected, rel=1e-9)


def test_a_strip_one_cell_wide_has_no_outline_across():
    heights = -(np.linspace(-1, 1, 64)[:, np.newaxis] ** 2)
    for periodic in (False, True):
        surface = rl.Surface(heights, (1.0, 1 / 64))
        curve = rl.press(surface, E_star=1.0, forces=[1e-3], periodic=periodic, fields=True)
        pairs = switches(curve.fields[0].contact, periodic)
        lost = curve.area_fraction_most[0] - curve.area_fraction_corrected[0]
        assert lost == pytest.approx(PAIR * pairs / 64, rel=1e-9)
