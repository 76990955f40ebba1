"""The full model against exact solutions, with the rates at which it converges to them."""

import numpy as np
import pytest

import roughline as rl
from roughline.exact import indenters, punch, westergaard

pytestmark = pytest.mark.usefixtures("either_search")

GRIDS = (64, 128, 256)
RADIUS = 0.3  # of the contact, in a square of side 1


def centred(n, m=None, size=(1.0, 1.0)):
    """Distance of each cell from the axis in the middle, between the cells of an even grid."""
    m = n if m is None else m
    x = (np.arange(n) - (n - 1) / 2) * size[0] / n
    y = (np.arange(m) - (m - 1) / 2) * size[1] / m
    return np.hypot(x[:, None], y)


def rate(sizes, errors):
    return -np.polyfit(np.log(sizes), np.log(np.abs(errors)), 1)[0]


def pressed_to(heights, depth, size=(1.0, 1.0), **settings):
    return rl.press(rl.Surface(heights, size), E_star=1.0, depths=[depth], **settings)


@pytest.mark.parametrize("n", [8, 16, 32, 64, 128, 256])
def test_square_punch_of_uniform_elements(n, judged):
    table = {8: 1.10650, 16: 1.12863, 32: 1.14021, 64: 1.14617, 128: 1.14921, 256: 1.15074}
    curve = pressed_to(np.zeros((n, n)), 1.0)
    assert curve.stiffness[0] == pytest.approx(table[n], abs=6e-6)
    assert curve.force[0] == pytest.approx(curve.stiffness[0], rel=1e-6)
    exact = punch.square_stiffness(1.0, 1.0)
    judged("square punch, flat", "stiffness", n, abs(curve.stiffness[0] / exact - 1))


def test_square_punch_converges_like_one_over_n_to_its_capacity(judged):
    sizes = np.array([32, 64, 128])
    stiffness = np.array([pressed_to(np.zeros((n, n)), 1.0).stiffness[0] for n in sizes])
    errors = punch.square_stiffness(1.0, 1.0) - stiffness
    assert rate(sizes, errors) == pytest.approx(1.0, abs=0.03)
    assert errors * sizes == pytest.approx(0.396, rel=0.03)
    # Richardson, twice: the error is a / n + b / n²
    once = 2 * stiffness[1:] - stiffness[:-1]
    twice = (4 * once[1] - once[0]) / 3
    assert twice == pytest.approx(rl.EXACT_PUNCH, abs=2e-5)
    off = abs(twice / rl.EXACT_PUNCH - 1)
    judged("square punch, flat", "stiffness, extrapolated from 32, 64 and 128", 128, off)


@pytest.mark.parametrize(
    ("name", "indenter", "reference"),
    [
        ("ball (Hertz)", indenters.PowerLawIndenter(2.0, 0.05, 1.0), (1.6e-4, 3.3e-5, 1.2e-5)),
        ("cone", indenters.PowerLawIndenter(1.0, 0.05, 1.0), (1.1e-4, 2.3e-5, 8e-6)),
        ("body of revolution, fourth power", indenters.PowerLawIndenter(4.0, 0.5, 1.0), None),
    ],
    ids=["Hertz", "cone", "quartic"],
)
def test_axisymmetric_indenters_converge_faster_than_first_order(name, indenter, reference, judged):
    depth = indenter.depth(RADIUS)
    forces, stiffnesses = [], []
    for n in GRIDS:
        heights = -indenter.coefficient * centred(n) ** indenter.exponent
        # depth counts from the highest cell, which is half a diagonal off the axis
        curve = pressed_to(heights, depth + heights.max())
        forces.append(abs(curve.force[0] / indenter.force(depth) - 1))
        stiffnesses.append(abs(curve.stiffness[0] / indenter.stiffness(depth) - 1))
        judged(name, "force", n, forces[-1])
        judged(name, "stiffness", n, stiffnesses[-1])
    assert rate(GRIDS, forces) > 1.3
    assert stiffnesses[-1] < 4e-3
    if reference:
        assert forces == pytest.approx(reference, rel=0.06)  # they are given to two digits
    else:
        assert forces[-1] < 3e-5


def test_disc_punch_converges(judged):
    errors = []
    for n in GRIDS:
        heights = np.where(centred(n) <= RADIUS, 0.0, -10.0)
        stiffness = pressed_to(heights, 1e-3).stiffness[0]
        errors.append(abs(stiffness / punch.disc_stiffness(1.0, RADIUS) - 1))
        judged("disc punch, flat", "stiffness", n, errors[-1])
    # the disc is drawn by whole cells: its area is off by about 1 / n, its edge singular
    assert (np.array(errors) < 1.3 * np.array([4.8e-3, 3.0e-3, 1.4e-3])).all()


@pytest.mark.parametrize(
    ("shape", "size"), [((96, 96), (1, 1)), ((96, 48), (1, 1)), ((60, 150), (1, 1.25))]
)
def test_hertz_on_rectangular_cells(shape, size, judged):
    ball = indenters.paraboloid(10.0, E_star=1.0)
    depth = ball.depth(RADIUS)
    heights = -(centred(*shape, size) ** 2) / 20
    curve = pressed_to(heights, depth + heights.max(), size, fields=True)
    assert curve.force[0] == pytest.approx(ball.force(depth), rel=1e-3)
    assert curve.stiffness[0] == pytest.approx(ball.stiffness(depth), rel=1e-2)
    area = curve.area_fraction[0] * size[0] * size[1]
    assert area == pytest.approx(np.pi * RADIUS**2, rel=0.03)
    expected = indenters.hertz_pressure(depth, 10.0, 1.0, centred(*shape, size))
    off = np.abs(curve.fields[0].pressure - expected)
    off = off[centred(*shape, size) < 0.9 * RADIUS].max() / expected.max()
    assert off < 0.02
    grid = f"{shape[0]} x {shape[1]}"
    judged("ball (Hertz)", "force", grid, abs(curve.force[0] / ball.force(depth) - 1))
    judged("ball (Hertz)", "stiffness", grid, abs(curve.stiffness[0] / ball.stiffness(depth) - 1))
    judged("ball (Hertz)", "area in cells", grid, abs(area / (np.pi * RADIUS**2) - 1))
    judged("ball (Hertz)", "pressure within 0.9 a, over its largest", grid, off)


def test_the_pressure_under_a_disc(judged):
    n = 128
    heights = np.where(centred(n) <= RADIUS, 0.0, -10.0)
    curve = pressed_to(heights, 1e-3, fields=True)
    r = centred(n)
    inner = r < 0.7 * RADIUS
    expected = punch.disc_pressure(curve.force[0], RADIUS, r)
    off = np.abs(curve.fields[0].pressure[inner] / expected[inner] - 1).max()
    assert off < 0.02
    judged("disc punch, flat", "pressure within 0.7 a", n, off)


def wave(n, crossed=False, amplitude=0.01):
    phase = 2 * np.pi * np.arange(n) / n
    other = np.cos(phase) if crossed else np.ones(4)
    size = (1.0, 1.0) if crossed else (1.0, 4 / n)
    return rl.Surface(amplitude * np.outer(np.cos(phase), other), size)


@pytest.mark.parametrize("half_width", [0.1, 0.25, 0.4])
def test_westergaards_wave(half_width, judged):
    errors = []
    for n in (64, 128, 256):
        surface = wave(n)
        mean = westergaard.mean_pressure(np.array(half_width), 0.01, 1.0, 1.0)
        force = float(mean) * surface.area
        curve = rl.press(surface, E_star=1.0, forces=[force], periodic=True, fields=True)
        x = np.arange(n) / n
        x = np.where(x > 0.5, x - 1, x)
        expected = westergaard.pressure(x, half_width, 0.01, 1.0, 1.0)
        found = curve.fields[0].pressure[:, 0]
        errors.append(np.sqrt(np.mean((found - expected) ** 2)) / expected.max())
        assert curve.area_fraction[0] == pytest.approx(2 * half_width, abs=2.1 / n)
        solution = f"sine wave (Westergaard), {2 * half_width:.0%} in contact"
        judged(solution, "rms of the pressure, over its largest", n, errors[-1])
    assert errors[-1] < 0.01
    assert (np.array(errors) < 0.6 / np.array([64, 128, 256])).all()  # first order


@pytest.mark.parametrize("crossed", [False, True])
def test_full_contact_is_exact(crossed, judged):
    surface = wave(64, crossed)
    full = westergaard.full_contact_pressure(0.01, 1.0, 1.0)
    if crossed:
        full = westergaard.crossed_full_contact_pressure(0.01, 1.0, 1.0)
    below, above = 0.97 * full * surface.area, 1.001 * full * surface.area
    curve = rl.press(
        surface, E_star=1.0, forces=[below, above], periodic=True, fields=True, rtol=1e-11
    )
    assert curve.area_fraction[0] < 1
    assert curve.area_fraction[1] == 1
    assert np.isinf(curve.stiffness[1])
    assert curve.depth[1] == pytest.approx(0.01, rel=1e-10)
    expected = 1.001 * full + full * surface.heights / 0.01
    off = np.abs(curve.fields[1].pressure - expected).max() / full
    assert off < 1e-10
    solution = "crossed sine waves, full contact" if crossed else "sine wave, full contact"
    judged(solution, "pressure, over that of full contact", 64, off)
