"""Pictures show what the numbers are, with their units, and say what is missing."""

import re
from dataclasses import replace

import numpy as np
import pytest
import xarray
from matplotlib import pyplot
from matplotlib.figure import Figure

import roughline as rl

SPECTRUM = rl.SelfAffine(fractal_dimension=2.2, length=1e-3, rms_height=1e-6)


@pytest.fixture(autouse=True, scope="module")
def no_screen():
    before = pyplot.get_backend()
    pyplot.switch_backend("agg")
    yield
    pyplot.switch_backend(before)


@pytest.fixture(autouse=True)
def closed_afterwards():
    yield
    pyplot.close("all")


@pytest.fixture(scope="module")
def surface():
    heights = SPECTRUM.surface(64, 3).heights
    return rl.Surface(heights, (1e-3, 1e-3), "m")


@pytest.fixture(scope="module")
def curve(surface):
    return rl.press(surface, E_star=1e11, n_loads=8, fields=True)


def texts(axes):
    """Everything that is written in a picture."""
    legend = axes.get_legend()
    written = [*axes.texts, *(legend.get_texts() if legend else [])]
    title = legend.get_title().get_text() if legend else ""
    return " ".join([*(text.get_text() for text in written), axes.get_title(), title])


def points(axes):
    """The points that are marked, x and y, in the order of x."""
    marked = [line.get_xydata() for line in axes.lines if line.get_marker() == "o"]
    found = np.concatenate(marked)
    return found[np.argsort(found[:, 0])].T


def test_axes_are_made_or_taken_and_returned(surface):
    made = rl.plot.topography(surface)
    assert made.figure.canvas.manager is not None  # so that a notebook or a screen shows it
    given = Figure().subplots()
    assert rl.plot.topography(surface, given) is given


def test_axes_have_units_where_the_body_has():
    heights = SPECTRUM.surface(16, 3).heights
    for unit, x, height in (
        ("m", "x [mm]", "height [µm]"),
        ("inch", "x [inch]", "height [inch]"),
        (None, "x", "height"),
    ):
        axes = rl.plot.topography(rl.Surface(heights, (1e-3, 2e-3), unit))
        assert axes.get_xlabel() == x
        assert axes.figure.axes[1].get_ylabel() == height
        (image,) = axes.images
        assert image.get_extent() == pytest.approx(
            [0, 1, 2, 0] if unit == "m" else [0, 1e-3, 2e-3, 0]
        )
    line = rl.Line(SPECTRUM.line(64, 1).heights, 1e-3, "m")
    axes = rl.plot.topography(line)
    assert (axes.get_xlabel(), axes.get_ylabel()) == ("x [mm]", "height [µm]")
    assert axes.lines[0].get_ydata() == pytest.approx(1e6 * (line.heights - line.heights.mean()))


def test_a_curve_is_drawn_in_the_units_of_its_axes(curve):
    axes = rl.plot.curve(curve)
    assert (axes.get_xlabel(), axes.get_ylabel()) == ("force $F$ [N]", "stiffness $k$ [MN/m]")
    assert points(axes) == pytest.approx(np.array([curve.force, curve.stiffness / 1e6]))
    axes = rl.plot.curve(curve, "depth", "area_fraction")
    assert axes.get_xlabel() == "depth $d$ [µm]"
    assert points(axes)[1] == pytest.approx(curve.area_fraction)
    axes = rl.plot.curve(curve, "force_bar", "stiffness_bar")
    assert axes.get_xlabel() == r"force $\bar F = F\,/\,(E^* h L)$"
    assert points(axes) == pytest.approx(np.array([curve.force_bar, curve.stiffness_bar]))


def is_open(line):
    return line.get_markerfacecolor() == "w"


def test_open_marks_are_where_the_grid_decides(curve):
    axes = rl.plot.curve(curve)
    marks = [line for line in axes.lines if line.get_marker() == "o"]
    counts = dict.fromkeys((False, True), 0)
    for line in marks:
        counts[is_open(line)] += len(line.get_xdata())
    assert counts == {False: curve.resolved.sum(), True: (~curve.resolved).sum()}
    assert 0 < counts[True] < curve.force.size
    assert "fewer than 10 cells touch" in texts(axes)


def test_open_marks_stay_open_and_explained_under_another_curve(curve, surface):
    other = rl.press(surface, E_star=1e11, forces=[30, 100, 30], hardness=3e9)
    axes = rl.plot.curve(other, axes=rl.plot.curve(curve))
    marks = [line for line in axes.lines if line.get_marker() == "o"]
    highest_filled = max(line.get_zorder() for line in marks if not is_open(line))
    assert all(line.get_zorder() > highest_filled for line in marks if is_open(line))
    legend = [text.get_text() for text in axes.get_legend().get_texts()]
    assert legend == ["fewer than 10 cells touch", "after a larger load"]


def test_unloading_is_told_from_loading(surface):
    curve = rl.press(surface, E_star=1e11, forces=[1, 10, 1], hardness=3e9)
    axes = rl.plot.curve(curve, "depth", "force")
    assert axes.get_xscale() == axes.get_yscale() == "linear"
    assert "after a larger load" in texts(axes)


def test_a_cycle_of_bodies_that_stick_is_drawn_as_force_over_depth(surface):
    body = rl.Surface(surface.heights, surface.sizes)
    depth = float(np.ptp(body.heights))
    curve = rl.press(
        body,
        E_star=1.0,
        law=rl.Exponential(0.3 * depth, depth),
        depths=[-depth, 0.5 * depth, 0.0, -depth],
    )
    assert curve.force.min() < 0
    axes = rl.plot.curve(curve)
    assert (axes.get_xlabel(), axes.get_ylabel()) == ("depth $d$", "force $F$")
    assert "as the bodies go apart" in texts(axes)
    for drawn in (axes, rl.plot.curve(curve, "force", "stiffness"), rl.plot.area(curve)):
        assert (drawn.get_xscale(), drawn.get_yscale()) == ("linear", "linear")
        assert drawn.lines[-1].get_xdata().size == 0  # a word of the legend
        (way,) = (line for line in drawn.lines if line.get_linestyle() == "-")
        assert len(way.get_xdata()) == 4


def test_loads_that_logarithmic_scales_cannot_show_are_counted(surface):
    curve = rl.press(surface, E_star=1e11, forces=[1, 10, 0])
    assert "1 of 3 loads not shown" in texts(rl.plot.curve(curve))
    assert "1 of 3 loads not shown" in texts(rl.plot.area(curve))
    assert "not shown" not in texts(rl.plot.curve(curve, "depth", "force"))


def test_area_is_the_corrected_one_and_the_band_ends_at_the_cells(curve):
    axes = rl.plot.area(curve)
    assert axes.get_ylabel() == "real contact area $A/A_0$"
    assert "corrected for the steps of its outline up to the area in cells" in texts(axes)
    assert points(axes)[1] == pytest.approx(curve.area_fraction_corrected)
    (band,) = axes.collections
    assert band.get_paths()[0].vertices[:, 1].max() == pytest.approx(curve.area_fraction.max())
    with pytest.raises(rl.InputError, match="has no area_fraction_corrected"):
        rl.plot.area(rl.press(SPECTRUM.line(256, 1), E_star=1.0, n_loads=3))


def test_loads_that_were_not_solved_are_told_in_the_picture(surface):
    curve = rl.press(
        surface,
        E_star=1e11,
        forces=[1, 3, 10],
        solver=rl.Solver(max_iterations=2),
        throw=False,
        fields=True,
    )
    assert not curve.converged.any()
    assert "no load was solved" in texts(rl.plot.curve(curve))
    for draw in (rl.plot.contact, rl.plot.pressure):
        text = texts(draw(curve, 1))
        assert "load 1 was not solved" in text
        assert "max_iterations reached" in text


def test_some_loads_that_were_not_solved_are_counted(curve):
    status, force = curve.status.copy(), curve.force.copy()
    status[2], force[2] = rl.Status.STALLED, np.nan
    axes = rl.plot.curve(replace(curve, status=status, force=force))
    assert "1 of 8 loads not solved" in texts(axes)
    assert axes.get_xscale() == "log"


def test_contact_and_pressure_are_those_of_the_load(curve):
    axes = rl.plot.contact(curve, 3)
    (image,) = axes.images
    assert (image.get_array() == curve.fields[3].contact.T).all()
    share = 100 * curve.area_fraction_corrected[3]
    assert f"corrected area {share:.4g}%" in axes.get_title()
    assert f"$F$ = {curve.force[3]:.4g} N" in axes.get_title()
    (image,) = rl.plot.pressure(curve, 3).images
    shown = image.get_array()
    touching = curve.fields[3].contact.T
    assert (~np.ma.getmaskarray(shown) == touching).all()
    assert np.asarray(shown[touching]) == pytest.approx(curve.fields[3].pressure.T[touching] / 1e9)


@pytest.mark.parametrize(("of", "unit"), [("gap", 1e6), ("pressure", 1e-9)])
def test_a_distribution_is_that_of_the_load_in_the_units_of_its_axes(curve, of, unit):
    axes = rl.plot.distribution(curve, of, 3)
    found = curve.fields[3].distribution(of)
    filled, outline = axes.patches
    of_all = 1 if of == "gap" else 1 - found.at_zero  # the rest of the pressures is zero
    for drawn in (filled, outline):
        values, edges, _ = drawn.get_data()
        assert edges == pytest.approx(found.edges * unit)
        assert values * np.diff(edges) * of_all == pytest.approx(found.shares)
    (of_density,) = re.findall(r"density.* \[1/(.*)\]", axes.get_ylabel())
    assert axes.get_xlabel().endswith(f"[{of_density}]")
    assert f"{100 * curve.area_fraction[3]:.3g}% of the cells in contact" in axes.get_title()
    assert f"at $F$ = {curve.force[3]:.4g} N" in axes.get_title()


def test_the_share_at_the_hardness_is_told(surface):
    pressed = rl.press(surface, E_star=1e11, hardness=1e8, forces=[1.0], fields=True)
    share = f"{100 * pressed.plastic_fraction[0]:.3g}% of them at the hardness"
    assert share in rl.plot.distribution(pressed, "pressure").get_title()
    assert "hardness" not in rl.plot.distribution(pressed, "gap").get_title()


def test_patches_are_counted_from_the_largest(curve):
    axes = rl.plot.patches(curve, 5)
    found = curve.fields[5].patches()
    areas, count = points(axes)
    assert (np.diff(count) < 0).all()
    for area, at_least in zip(areas, count, strict=True):
        assert at_least == (found.areas * 1e6 >= area * (1 - 1e-9)).sum()
    assert axes.get_xlabel() == "area of a patch [mm²]"
    share = f"{100 * found.forces[0] / found.forces.sum():.3g}%"
    assert f"bears {share} of the force" in texts(axes)


def test_a_load_without_contact_has_no_patches(surface):
    pressed = rl.press(surface, E_star=1e11, forces=[1.0, 0.0], fields=True)
    assert "no contact" in texts(rl.plot.patches(pressed))
    assert "no contact" in texts(rl.plot.distribution(pressed, "pressure"))
    assert "0% of the cells in contact" in texts(rl.plot.distribution(pressed, "gap"))


def test_a_load_that_is_not_there_is_refused(curve, surface):
    with pytest.raises(rl.InputError, match="load is 8; the curve has loads 0 to 7"):
        rl.plot.contact(curve, 8)
    with pytest.raises(rl.InputError, match="press with fields=True"):
        rl.plot.pressure(rl.press(surface, E_star=1e11, n_loads=3))
    with pytest.raises(rl.InputError, match="reduced model of a line gives no fields; press"):
        rl.plot.contact(rl.press(SPECTRUM.line(256, 1), E_star=1.0, n_loads=3))
    with pytest.raises(
        rl.InputError, match="no quantity 'areas' over the loads; allowed are depth"
    ):
        rl.plot.curve(curve, y="areas")


def test_a_spectrum_has_its_law_and_the_exponent(surface):
    axes = rl.plot.spectrum(surface)
    assert axes.get_ylabel() == "spectrum $C_{2D}$ [m⁴]"
    parameters = rl.roughness(surface)
    assert axes.get_title().startswith(f"H = {parameters.fit.hurst:.2f} (")
    assert axes.lines[0].get_ydata() == pytest.approx(parameters.power)
    assert rl.plot.spectrum(parameters).get_ylabel() == "spectrum $C_{2D}$"
    flat = rl.plot.spectrum(rl.Surface(np.zeros((8, 8)), (1.0, 1.0)))
    assert "no spectrum" in texts(flat)


def test_a_spectrum_that_follows_no_law_is_drawn_without_one():
    noise = rl.Surface(np.random.default_rng(1).normal(size=(64, 64)), (1.0, 1.0))
    axes = rl.plot.spectrum(noise)
    assert axes.get_title() == "not self-affine"
    assert len(axes.lines) == 1


@pytest.mark.parametrize("n", [64, 200])
def test_a_spectrum_leaves_out_rounding_and_nothing_else(n):
    """Beyond the cutoff of a surface there is rounding alone, 28 powers of ten below its waves."""
    cut = rl.SelfAffine(hurst=0.5, rms_height=1e-6, length=1e-3, q_high=10 * 2 * np.pi / 1e-3)
    heights = cut.surface(n, 2).heights
    q = rl.plot.spectrum(rl.Surface(heights, (1e-3, 1e-3))).lines[0].get_xdata()
    assert q[-1] == pytest.approx(cut.q_high, rel=0.15)
    # of the digits of an instrument, 12 decades below, every wave is drawn
    noisy = rl.Surface(heights + np.random.default_rng(0).normal(0, 1e-15, (n, n)), (1e-3, 1e-3))
    q = rl.plot.spectrum(noisy).lines[0].get_xdata()
    assert q == pytest.approx(rl.roughness(noisy).spectrum.q)


def test_a_power_law_names_what_was_fitted(curve):
    law = rl.fit_power_law(curve.force, curve.area_fraction, (curve.force[1], curve.force[5]))
    axes = rl.plot.power_law(curve.force, curve.area_fraction, law, x="force", y="area_fraction")
    assert axes.get_xlabel() == "force $F$"
    assert axes.get_ylabel().startswith("area fraction")
    with pytest.raises(rl.InputError, match="no quantity 'k' over the loads; allowed are depth"):
        rl.plot.power_law(curve.force, curve.stiffness, law, y="k")


def test_a_power_law_is_drawn_over_its_window():
    force = np.geomspace(1e-3, 1, 13)
    factors = np.exp(np.random.default_rng(0).normal(0, 0.1, (10, 1)))
    stiffness = 0.8 * force**0.6 * factors
    law = rl.fit_power_law(force, stiffness, (1e-3, 1e-1))
    axes = rl.plot.power_law(force, stiffness, law)
    assert axes.get_title().startswith(r"$\alpha$ = 0.600 (")
    assert axes.get_title().endswith("10 realisations")
    drawn = axes.lines[-1].get_xydata()
    assert drawn[:, 0] == pytest.approx(law.window)
    assert drawn[:, 1] == pytest.approx(law(np.array(law.window)))
    assert points(axes)[1] == pytest.approx(stiffness.mean(axis=0))


def test_exponents_are_drawn_over_the_fractal_dimension_beside_the_paper_s_formulas():
    force, dimensions = np.geomspace(1e-3, 1, 13), [2.2, 2.6]
    factors = np.exp(np.random.default_rng(0).normal(0, 0.1, (2, 10, 1)))
    stiffness = np.array([force**0.55, force**0.7])[:, np.newaxis] * factors
    laws = {
        dimension: rl.fit_power_law(force, values, (1e-3, 1e-1))
        for dimension, values in zip(dimensions, stiffness, strict=True)
    }
    axes = rl.plot.exponents(laws)
    marks, _, (bars,) = axes.containers[0]
    assert marks.get_xydata() == pytest.approx(np.array([[2.2, 0.55], [2.6, 0.7]]))
    ends = [sorted(segment[:, 1]) for segment in bars.get_segments()]
    assert ends == [pytest.approx(laws[each].exponent_interval) for each in dimensions]
    assert r"$1/(4 - D_f)$ $0.2567\,D_f$ power law, $\bar F$ = 0.001 to 0.1" in texts(axes)
    stiffness[0, 0, 3] = np.nan  # a load that did not converge
    ensemble = xarray.Dataset(
        {"stiffness": (("fractal_dimension", "realisation", "force_bar"), stiffness)},
        {"fractal_dimension": dimensions, "force_bar": force},
        {"model": "reduced"},
    )
    assert rl.plot.exponents(ensemble, (1e-3, 1e-1), axes=axes) is axes
    assert "lines, $" in texts(axes)
    assert texts(axes).count("1/(4 - D_f)") == 1
    again = axes.containers[1][0].get_ydata()
    left = rl.fit_power_law(force, stiffness[0, 1:], (1e-3, 1e-1))
    assert again == pytest.approx([left.exponent, 0.7])
    with pytest.raises(rl.InputError, match="give a window, such as"):
        rl.plot.exponents(ensemble)
    with pytest.raises(rl.InputError, match="leave the window out"):
        rl.plot.exponents(laws, (1e-3, 1e-1))
    with pytest.raises(rl.InputError, match="there is no law to draw"):
        rl.plot.exponents({})


@pytest.mark.parametrize(("n", "force_bars"), [(16, [0.01, 0.1]), (32, None)])
def test_a_comparison_is_both_models_and_their_difference(n, force_bars):
    compared = rl.compare(SPECTRUM, n=n, surfaces=2, force_bars=force_bars)
    axes = rl.plot.comparison(compared)
    assert "full model, mean of 2 surfaces" in texts(axes)
    assert "reduced model, mean of 200 lines" in texts(axes)
    axes = rl.plot.difference(compared, tolerance=0.2)
    assert points(axes)[1] == pytest.approx(compared.difference)


def test_the_trust_map_is_drawn_for_its_own_roll_offs():
    axes = rl.plot.trust_map(4)
    (mesh, *_) = axes.collections
    (i,) = np.flatnonzero(rl.trust_map().roll_off_ratios == 4)
    assert np.asarray(mesh.get_array()).ravel() == pytest.approx(
        rl.trust_map().difference[i].ravel()
    )
    with pytest.raises(rl.InputError, match="roll_off_ratio is 3; the map has 1, "):
        rl.plot.trust_map(3)
