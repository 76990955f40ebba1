"""Pictures of the flow show where the fluid goes, how much of it, and where it is sealed."""

import numpy as np
import pytest
from matplotlib import pyplot

import roughline as rl

SPECTRUM = rl.SelfAffine(hurst=0.8, rms_height=0.01, q_roll=25.0)
APERTURE = rl.hydraulic_aperture("x")


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


def pressed(forces, *, unit=None, seed=7, **settings):
    made = SPECTRUM.surface(64, rng=seed)
    surface = rl.Surface(made.heights, made.sizes, unit)
    return rl.press(surface, forces=forces, periodic=True, measures=[APERTURE], **settings)


@pytest.fixture(scope="module")
def gap():
    return pressed([0.06], E_star=1.0, fields=True).fields[0]


@pytest.fixture(scope="module")
def there_and_back():
    up = [0.005, 0.05, 0.1, 0.2]
    return pressed([*up, *up[-2::-1]], E_star=1.0, hardness=0.5)


def shown(image):
    return np.ma.filled(image.get_array(), 0.0).T


def marks(axes, look):
    """Points of the lines of a look that stand where the data are."""
    at_data = [line for line in axes.lines if line.get_transform() == axes.transData]
    found = [line.get_xydata() for line in at_data if line.get_linestyle() == look]
    return np.concatenate(found)


def at_the_foot(axes):
    """Pressures that are marked as sealed, with whether their marks are open."""
    rows = [line for line in axes.lines if line.get_transform() == axes.get_xaxis_transform()]
    return [(list(row.get_xdata()), row.get_markerfacecolor() == "w") for row in rows]


@pytest.mark.parametrize("along", ["x", "y"])
def test_the_flux_is_shown_over_its_mean(gap, along):
    flow = rl.flow(gap, (1.0, 2.0), along=along)
    closed, flux = rl.plot.flow(flow).images
    assert np.array_equal(shown(closed) == 0, gap.contact)
    width = 2.0 if along == "x" else 1.0
    expected = np.hypot(*flow.flux) * width / flow.inflow
    assert shown(flux) == pytest.approx(expected)
    assert flux.norm.vmax == pytest.approx(expected.max())
    plates = rl.flow(np.full((8, 4), 0.1), (1.0, 2.0), along=along)
    assert shown(rl.plot.flow(plates).images[1]) == pytest.approx(np.ones((8, 4)))


def test_the_ring_is_around_the_constriction_and_the_axes_have_units(gap):
    flow = rl.flow(gap, (1e-3, 2e-3))
    axes = rl.plot.flow(flow, "m")
    assert (axes.get_xlabel(), axes.get_ylabel()) == ("x [mm]", "y [mm]")
    assert axes.images[1].get_extent() == pytest.approx([0, 1, 2, 0])
    (ring,) = axes.lines
    place = (np.array(flow.constriction) + 0.5) / 64
    assert ring.get_xydata()[0] == pytest.approx(place * [1, 2])
    assert f"$u_h$ = {1e6 * flow.hydraulic_aperture:.3g} µm" in axes.get_title()
    gas = rl.flow(gap, (1e-3, 2e-3), mean_free_path=1e-6)
    assert "aperture with slip $u_s$ = " in rl.plot.flow(gas).get_title()
    with pytest.raises(rl.InputError, match="a unit of length is needed"):
        rl.plot.flow(flow, "Pa")
    bare = rl.plot.flow(flow)
    assert (bare.get_xlabel(), bare.figure.axes[1].get_ylabel()) == (
        "x",
        r"flux over its mean, $|j|\,/\,\bar j$",
    )


@pytest.mark.parametrize("along", ["x", "y"])
def test_an_arrow_leads_from_inlet_to_outlet(gap, along):
    axes = rl.plot.flow(rl.flow(gap, along=along, sides="closed"))
    (text,) = (each for each in axes.texts if each.get_text())
    assert text.get_text() == r"inlet  $\Longrightarrow$  outlet"
    assert text.get_rotation() == (0 if along == "x" else 270)
    repeated = rl.plot.flow(rl.flow(gap, along=along)).texts
    assert r"flow  $\Longrightarrow$" in [each.get_text() for each in repeated]


def test_a_sealed_gap_shows_how_far_the_fluid_comes():
    gap = np.ones((10, 10))
    gap[6], gap[3, 4] = 0, 0
    axes = rl.plot.flow(rl.flow(gap, (1.0, 1.0), sides="closed"))
    assert "sealed" in axes.get_title()
    reached = gap > 0
    reached[6:] = False
    assert np.array_equal(shown(axes.images[1]) == 1, reached)
    assert (len(axes.figure.axes), len(axes.lines)) == (1, 0)  # no scale, and no ring


def test_a_sealed_gap_that_repeats_has_no_ends():
    gap = np.ones((10, 10))
    gap[6] = 0
    axes = rl.plot.flow(rl.flow(gap, (1.0, 1.0)))
    assert "from one repetition" in axes.get_title()
    assert not any("inlet" in each.get_text() for each in axes.texts)


def test_a_channel_of_one_cell_is_seen_on_a_large_map():
    gap = np.zeros((1300, 8))
    gap[:, 3] = 1.0
    gap[:5], gap[-5:] = 1.0, 1.0
    closed, flux = rl.plot.flow(rl.flow(gap, (1.0, 1.0))).images
    assert flux.get_array().shape == (8, 650)
    assert (shown(flux)[:, 3] > 1).all()
    assert (shown(closed)[5:-5].sum(axis=1) == 1).all()


def test_apertures_are_drawn_over_the_pressure_in_their_units():
    forces = np.array([0.02, 0.04, 0.06])
    curve = pressed(forces * 1e9, unit="m", E_star=1e9)
    axes = rl.plot.hydraulic_aperture(curve)
    values = curve.measured["hydraulic_aperture_x"].values
    assert (values > 0).all()
    assert (axes.get_xlabel(), axes.get_ylabel()) == (
        "mean pressure $p$ [MPa]",
        "hydraulic aperture $u_h$ [mm]",
    )
    expected = np.column_stack([forces, values])
    assert marks(axes, "-") == pytest.approx(1e3 * expected)
    (leak,) = axes.child_axes
    assert leak.get_ylabel() == "leak, in proportion to $u_h^3$ [mm³]"
    axes.figure.canvas.draw()
    assert leak.get_ylim() == pytest.approx(np.power(axes.get_ylim(), 3))
    in_others = rl.plot.hydraulic_aperture(pressed(forces * 3, E_star=3.0))
    assert in_others.get_xlabel() == "mean pressure $p/E^*$"
    assert marks(in_others, "-") == pytest.approx(expected)


def test_sealed_loads_are_marked_at_the_foot(there_and_back):
    values = there_and_back.measured["hydraulic_aperture_x"].values
    assert (values[[2, 3, 4]] == 0).all()
    assert (values[[0, 1, 6]] > 0).all()
    axes = rl.plot.hydraulic_aperture(there_and_back)
    loading, after = at_the_foot(axes)
    assert loading == ([0.1, 0.2], False)
    assert after == (list(there_and_back.force[4:][values[4:] == 0]), True)
    drawn = marks(axes, "--")
    assert drawn[:, 1][-1] == pytest.approx(values[-1])
    assert "after a larger load" in [text.get_text() for text in axes.get_legend().get_texts()]
    lowest = axes.transAxes.inverted().transform(axes.transData.transform((1, np.nanmin(drawn))))
    rows = [line.get_ydata()[0] for line in axes.lines if line.get_transform() != axes.transData]
    assert lowest[1] > max(rows)


def test_theories_stand_beside_and_end_where_they_seal(there_and_back):
    loads = np.geomspace(0.02, 0.3, 30)
    theories = [
        rl.theory(name, SPECTRUM.lattice(64), 1.0, loads)
        for name in ("critical-junction", "bruggeman")
    ]
    axes = rl.plot.hydraulic_aperture(there_and_back, theories)
    legend = [text.get_text() for text in axes.get_legend().get_texts()]
    assert legend[:2] == ["critical-junction", "bruggeman"]
    values = there_and_back.measured["hydraulic_aperture_x"].values
    least = 0.9 * values[values > 0].min()  # as far down as the curves
    for theory, look in zip(theories, (":", "-."), strict=True):
        open_ones = theory.hydraulic_aperture > 0
        assert not open_ones.all()
        drawn = marks(axes, look)[:-1, 1]  # the last one is sealed
        assert drawn == pytest.approx(theory.hydraulic_aperture[: drawn.size])
        assert drawn[-1] > least > theory.hydraulic_aperture[drawn.size]
        assert ([loads[~open_ones][0]], False) in at_the_foot(axes)


def test_curves_of_one_label_look_alike(there_and_back):
    others = [pressed([0.02, 0.05], E_star=1.0, seed=seed) for seed in (1, 2)]
    names = ["elastic", "elastic", "yielding"]
    axes = rl.plot.hydraulic_aperture([*others, there_and_back], labels=names)
    solid = [line.get_color() for line in axes.lines if line.get_linestyle() == "-"]
    assert solid[0] == solid[1] != solid[2]
    legend = [text.get_text() for text in axes.get_legend().get_texts()]
    assert legend[:2] == ["elastic", "yielding"]
    bare = rl.plot.hydraulic_aperture(others)
    assert bare.get_legend() is None
    assert len({line.get_color() for line in bare.lines}) == 2


def test_what_has_no_aperture_is_refused(there_and_back):
    curve = rl.press(SPECTRUM.surface(32, 1), E_star=1.0, forces=[0.1])
    with pytest.raises(
        rl.InputError, match=r'no measure "hydraulic_aperture_x": press with measure'
    ):
        rl.plot.hydraulic_aperture([there_and_back, curve])
    metres = pressed([1e7], unit="m", E_star=1e9)
    with pytest.raises(rl.InputError, match="different units"):
        rl.plot.hydraulic_aperture([there_and_back, metres])
    persson = rl.theory("persson", SPECTRUM.lattice(64), 1.0, [0.1])
    for wrong in ([persson], persson, 3):
        with pytest.raises(rl.InputError, match=r'theories is .*"critical-junction" and "brugg'):
            rl.plot.hydraulic_aperture(there_and_back, wrong)
    for wrong in (["a", "b"], "a", [3]):
        with pytest.raises(rl.InputError, match="a list of 1 texts is needed"):
            rl.plot.hydraulic_aperture(there_and_back, labels=wrong)
