"""Surface and Line: what they hold, and what they refuse."""

from dataclasses import replace
from fractions import Fraction

import numpy as np
import pytest

import roughline as rl
from roughline.topography.provenance import Provenance


def wave(nx=64, ny=48):
    x, y = np.meshgrid(np.arange(nx) / nx, np.arange(ny) / ny, indexing="ij")
    return np.cos(2 * np.pi * x) * np.cos(4 * np.pi * y)


def test_sizes_and_spacing_belong_together():
    surface = rl.Surface(wave(), sizes=(2.0, 3.0))
    assert surface.shape == (64, 48)
    assert surface.spacing == (2 / 64, 3 / 48)
    assert (surface.area, surface.length) == (6.0, pytest.approx(np.sqrt(6)))
    assert rl.Line([0.0, 1.0, 0.0, 1.0], length=2.0).spacing == 0.5


def test_rms_quantities_converge_to_those_of_a_wave():
    coarse, fine = (rl.Surface(wave(n, n), sizes=(1.0, 1.0)) for n in (128, 256))
    q2 = 4 * np.pi**2 * (1 + 4)
    for surface, tolerance in ((coarse, 0.02), (fine, 0.01)):  # the borders count for 1 / n
        assert surface.rms_height == pytest.approx(0.5)
        assert surface.rms_slope == pytest.approx(0.5 * np.sqrt(q2), rel=tolerance)
        assert surface.rms_curvature == pytest.approx(0.25 * q2, rel=2 * tolerance)
    line = rl.Line(np.cos(2 * np.pi * np.arange(4096) / 4096), length=1.0)
    assert line.rms_slope == pytest.approx(2 * np.pi * np.sqrt(0.5), rel=1e-3)
    assert line.rms_curvature == pytest.approx(4 * np.pi**2 * np.sqrt(0.5), rel=1e-3)


@pytest.mark.parametrize("scale", [1e-150, 1e-12, 1e12, 1e149])
def test_rms_quantities_neither_underflow_nor_overflow(scale):
    reference, scaled = rl.Surface(wave(), (1, 1)), rl.Surface(wave() * scale, (1, 1))
    for name in ("rms_height", "rms_slope", "rms_curvature"):
        assert getattr(scaled, name) == pytest.approx(getattr(reference, name) * scale, rel=1e-12)


def test_detrending_removes_mean_and_tilt_and_nothing_else():
    x, y = np.meshgrid(np.arange(64), np.arange(48), indexing="ij")
    flat = rl.Surface(wave(), (1, 1)).detrended()
    tilted = rl.Surface(wave() + 5 + 0.3 * x - 0.2 * y, (1, 1)).detrended()
    assert tilted.heights == pytest.approx(flat.heights, abs=1e-12)
    assert tilted.settings["detrended"] == "tilt"
    twisted = rl.Surface((x - x.mean()) * (y - y.mean()), (1, 1))  # of the second degree
    assert twisted.detrended().heights == pytest.approx(twisted.heights, abs=1e-12)
    assert twisted.detrended("curvature").heights == pytest.approx(0, abs=1e-12)
    plane = np.stack([np.ones(x.size), x.ravel(), y.ravel()])
    assert np.abs(plane @ tilted.heights.ravel()).max() < 1e-8
    plane_alone = rl.Surface(1e3 + 0.3 * x - 0.2 * y, (1, 1)).detrended()
    assert not plane_alone.heights.any()  # without the rounding of the subtraction
    line = rl.Line(np.sin(np.arange(50.0)) + 3 * np.arange(50), 1.0).detrended()
    assert abs(line.heights.sum()) < 1e-10
    assert abs(line.heights @ np.arange(50.0)) < 1e-8


def test_scaled_heights_say_so():
    surface = rl.Surface(wave(), (1, 1)).scaled(3.0)
    assert surface.heights == pytest.approx(3 * wave())
    assert surface.settings["height_factor"] == 3.0


@pytest.mark.parametrize(("unit", "metres"), [("µm", 1e-6), ("mm", 1e-3), (None, 1.0)])
def test_a_topography_of_surfacetopography_is_taken(unit, metres):
    from SurfaceTopography import Topography

    given = Topography(wave(), (20.0, 30.0), unit=unit)
    found = rl.Surface(given)
    assert found.sizes == pytest.approx((20 * metres, 30 * metres))
    assert found.heights == pytest.approx(wave() * metres)
    assert found.unit == ("m" if unit else None)
    assert found.is_cut_out
    assert not rl.Surface(Topography(wave(), (1.0, 1.0), periodic=True)).is_cut_out
    assert found.scaled(2.0).sizes == found.sizes


def test_a_piece_stays_a_piece_whatever_is_done_to_it():
    whole = rl.Surface(wave(), (1.0, 1.0))
    piece = rl.Surface(wave(), (1.0, 1.0), is_cut_out=True)
    for change in (
        rl.Surface.coarsened,
        rl.Surface.detrended,
        lambda surface: surface.scaled(2.0),
        lambda surface: rl.prepared(surface, rl.Preparation(low_pass=0.1, points=32)),
        lambda surface: rl.facing(surface, whole),
        lambda surface: rl.facing(whole, surface),
    ):
        assert change(piece).is_cut_out is True
        assert change(whole).is_cut_out is False
    assert whole.cropped((0, 8), (0, 8)).is_cut_out
    assert rl.prepared(whole, rl.Preparation(crop=(0, 0.5, 0, 0.5))).is_cut_out
    with pytest.raises(rl.InputError, match='is_cut_out is "yes"; True or False is needed'):
        rl.Surface(wave(), (1.0, 1.0), is_cut_out="yes")


@pytest.mark.parametrize(
    "settings",
    [
        {"origin": "instrument file"},
        {"origin": "self-affine surface", "cropped": "x 0:8, y 0:8"},
        {"detrended": "tilt", "tilt_removed_x": 0.1, "tilt": "mounting"},
        {"pixels": "means", "blur": 0.1, "missing_points": 7, "missing_share": 0.5},
    ],
)
def test_settings_decide_nothing(settings):
    """They are a record for people; what decides is a field."""
    for given in (settings, {}):
        body = rl.Surface(wave(), (1.0, 1.0), None, given)
        assert not body.is_cut_out  # as its borders tell
        assert body.removed_trend == "none"
        assert body.provenance == Provenance(borders=body.provenance.borders)


def test_the_trend_that_was_removed_is_known():
    for body in (rl.Surface(wave(), (1.0, 1.0)), rl.Line(wave()[0], 1.0)):
        assert body.removed_trend == "none"
        assert body.detrended("curvature").scaled(2.0).removed_trend == "curvature"
        assert replace(body, settings={"detrended": "tilt"}).removed_trend == "none"
    known = Provenance(detrended="mean")
    assert rl.Line(wave()[0], 1.0, provenance=known).removed_trend == "mean"
    with pytest.raises(rl.InputError, match='trend is "cubic"'):
        Provenance(detrended="cubic")


def test_what_is_no_map_or_says_things_twice_is_refused():
    from SurfaceTopography import Topography, UniformLineScan

    given = Topography(wave(), (20.0, 30.0), unit="um")
    for arguments, message in (
        ((given, (1.0, 1.0)), "has its own sizes; leave sizes= out"),
        ((UniformLineScan(wave()[0], 1.0),), "the topography is a line scan"),
        ((wave(),), r"no sizes are given; give the sides of the surface, \(Lx, Ly\)"),
        ((Topography(np.ma.masked_greater(wave(), 0.9), (1.0, 1.0)),), "heights are masked"),
    ):
        with pytest.raises(rl.InputError, match=message):
            rl.Surface(*arguments)
    with pytest.raises(rl.InputError, match='states its unit, um; leave unit="m" out'):
        rl.Surface(given, unit="m")


@pytest.mark.parametrize(
    "huge", [10**400, 10**6000, Fraction(10**400)], ids=["400 digits", "6000", "a fraction"]
)
def test_numbers_beyond_those_of_floats_are_refused(huge):
    for build in (
        lambda: rl.Surface(wave(), (huge, 1)),
        lambda: rl.Surface([[0, huge], [1, 1]], (1, 1)),
        lambda: rl.Line(wave()[0], huge),
        lambda: rl.Line([0, huge, 1], 1.0),
        lambda: rl.flow([[0, huge], [1, 1]]),
    ):
        with pytest.raises(rl.InputError, match="0000 ... 000|a Fraction|a number of thousands"):
            build()


def test_bodies_are_values():
    heights = wave()
    surface = rl.Surface(heights, (1, 1))
    with pytest.raises(ValueError, match="read-only"):
        surface.heights[0, 0] = 1
    heights[0, 0] = 2.0  # the caller's array stays the caller's
    with pytest.raises(AttributeError):
        surface.sizes = (2.0, 2.0)
    with pytest.raises(TypeError):
        surface.settings["n"] = 1


NAN, INF = wave(), wave()
NAN[3, 4], INF[0, :2] = np.nan, -np.inf


@pytest.mark.parametrize(
    ("heights", "sizes", "message"),
    [
        (NAN, (1, 1), "1 of 3072 heights are NaN or infinite"),
        (INF, (1, 1), "2 of 3072 heights are NaN or infinite"),
        (np.ma.masked_greater(wave(), 0.5), (1, 1), "heights are masked"),
        (wave()[0], (1, 1), "the heights have 1 dimensions; a Surface takes 2"),
        (wave()[:1, :1], (1, 1), "1 x 1 points; at least 1 x 2"),
        (np.zeros((0, 0)), (1, 1), "0 x 0 points"),
        (wave() + 1j, (1, 1), "not an array of real numbers"),
        ([["a", "b"], ["c", "d"]], (1, 1), "not an array of real numbers"),
        (wave() * 1e200, (1, 1), "heights reach 1e[+]200"),
        (wave(), (1, 0), "sizes is .1, 0.; give two positive"),
        (wave(), (1, -1), "sizes is .1, -1."),
        (wave(), (1, np.nan), "sizes is .1, nan."),
        (wave(), 1.0, "sizes is 1.0; give two"),
        (wave(), (1, 2, 3), "sizes is .1, 2, 3."),
    ],
)
def test_impossible_surfaces_are_refused(heights, sizes, message):
    with pytest.raises(rl.InputError, match=message):
        rl.Surface(heights, sizes)


@pytest.mark.parametrize(
    ("heights", "length", "kind", "message"),
    [
        ([1.0], 1.0, "reduced", "the line has 1 points; at least 2"),
        (wave(), 1.0, "reduced", "the heights have 2 dimensions; a Line takes 1"),
        ([0.0, np.nan], 1.0, "reduced", "1 of 2 heights are NaN"),
        ([0.0, 1.0], 0.0, "reduced", "length is 0.0; a positive, finite number is needed"),
        ([0.0, 1.0], 1.0, "scan", 'kind is "scan"'),
    ],
)
def test_impossible_lines_are_refused(heights, length, kind, message):
    with pytest.raises(rl.InputError, match=message):
        rl.Line(heights, length, kind=kind)


@pytest.mark.parametrize("order", ["C", "F"])
def test_heights_in_either_order_are_not_copied(order):
    heights = np.asarray(wave(), order=order)
    assert np.shares_memory(rl.Surface(heights, (1.0, 1.0)).heights, heights)
    assert not np.shares_memory(rl.Surface(heights[::2, ::2], (1.0, 1.0)).heights, heights)


@pytest.mark.parametrize("periodic", [False, True])
def test_the_order_in_memory_changes_nothing(periodic):
    made = rl.SelfAffine(hurst=0.8, rms_height=1.0).surface(64, 3).heights[:, :48]
    surfaces = [rl.Surface(np.array(made, order=order), (1.0, 0.75)) for order in "CF"]
    first, second = (
        rl.press(
            surface,
            E_star=1.0,
            forces=[0.01, 0.1, 1.0],
            periodic=periodic,
            fields=True,
            grid_error=True,
        )
        for surface in surfaces
    )
    for name in ("depth", "force", "stiffness", "area_fraction", "stiffness_error"):
        assert getattr(first, name) == pytest.approx(getattr(second, name), rel=1e-9), name
    assert (first.fields[1].contact == second.fields[1].contact).all()
    for name in ("rms_height", "rms_slope", "rms_curvature"):
        expected = pytest.approx(getattr(surfaces[1], name), rel=1e-13)
        assert getattr(surfaces[0], name) == expected
    spectra = [rl.isotropic_spectrum(surface).C_2d for surface in surfaces]
    assert spectra[0] == pytest.approx(spectra[1], rel=1e-9)
