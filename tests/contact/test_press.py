"""The front door: loads, messages, honesty about convergence."""

import math
import re

import numpy as np
import pytest

import roughline as rl

SPECTRUM = rl.SelfAffine(hurst=0.8, rms_height=1.0)


@pytest.fixture(scope="module")
def surface():
    return SPECTRUM.surface(32, 7)


@pytest.fixture(scope="module")
def line():
    return SPECTRUM.line(1024, 7)


def test_the_contract_runs_line_by_line(tmp_path):
    spectrum = rl.SelfAffine(fractal_dimension=2.2, length=1.0, rms_height=1.0)
    surface = spectrum.surface(n=64, rng=7)
    line = spectrum.line(n=2**12, rng=7)
    surface = rl.Surface(surface.heights, sizes=(1.0, 1.0))
    curve = rl.press(surface, E_star=1.0, depths=[0.1, 0.5])
    curve = rl.press(surface, E_star=1.0, n_loads=30)
    assert curve.force.size == 30
    curve = rl.press(surface, E_star=1.0, forces=[0.01, 0.1], periodic=True, fields=True)
    for name in ("pressure", "displacement", "gap", "contact"):
        assert getattr(curve.fields[1], name).shape == (64, 64)
    for name in ("depth", "force", "stiffness", "area_fraction", "status"):
        assert getattr(curve, name).shape == (2,)
    curve.to_dataset()
    curve.write(tmp_path / "curve.nc")
    curve = rl.press(line, E_star=1.0, forces=np.geomspace(1e-5, 1, 40))
    assert curve.area_fraction is None
    law = rl.fit_power_law(curve.force_bar, curve.stiffness_bar, window=(1e-4, 1e-2))
    assert law.exponent_interval[0] < law.exponent < law.exponent_interval[1]
    assert law.prefactor > 0


def test_n_loads_span_first_touch_to_saturation(surface, line):
    curve = rl.press(surface, E_star=2.0, n_loads=12)
    assert np.diff(np.log(curve.force)) == pytest.approx(np.log(curve.force[1] / curve.force[0]))
    assert curve.area_fraction[0] * 32**2 <= 20
    assert curve.stiffness[-1] > 0.85 * 1.1523 * 2.0
    curve = rl.press(line, E_star=2.0, n_loads=12)
    assert curve.stiffness[0] == pytest.approx(2.0 * 10 / 1024)
    assert curve.stiffness[-1] == pytest.approx(2.0 * 1023 / 1024)
    assert curve.resolved.all()


def test_what_is_prescribed_comes_back_as_it_was_given(surface, line):
    loads = [0.1 / 3, 0.3, 10 / 3]  # in other units and back they would be off in the last digit
    scaled = rl.Surface(surface.heights / 7, (1 / 3, 1 / 3))
    for body in (surface, scaled, line):
        assert rl.press(body, E_star=0.7, forces=loads).force.tolist() == loads
        assert rl.press(body, E_star=0.7, depths=loads).depth.tolist() == loads


@pytest.mark.parametrize(
    ("loads", "message"),
    [
        ({}, "no loads given; give one of"),
        ({"depths": [0.1], "forces": [0.1]}, "both depths and forces given"),
        ({"depths": [0.1], "n_loads": 3}, "n_loads given together with depths"),
        ({"depths": []}, "depths have shape (0,)"),
        ({"forces": [[0.1]]}, "forces have shape (1, 1)"),
        ({"forces": ["a"]}, "forces are not numbers"),
        ({"depths": [0.1, -0.2]}, "depths[1] is -0.2, negative"),
        ({"forces": [0.0, 1.0]}, "forces[0] is 0.0, zero, at which nothing touches"),
        ({"forces": [1.0, np.nan]}, "forces[1] is nan, not finite"),
        ({"depths": [np.inf]}, "depths[0] is inf, not finite"),
        ({"depths": [0.0, 0.0]}, "depths[0] is 0.0, zero, at which nothing touches; give positive"),
        ({"n_loads": 1}, "n_loads is 1; a whole number of at least 2"),
        ({"n_loads": 2.5}, "n_loads is 2.5"),
    ],
)
def test_impossible_loads_are_refused_by_both_models(surface, line, loads, message):
    for body in (surface, line):
        with pytest.raises(rl.InputError, match=re.escape(message)):
            rl.press(body, E_star=1.0, **loads)


WRONG_ARGUMENTS = {
    "E_star": ["110 GPa", None, True, [1.0, 2.0], 1e200, 10**400, 1j],
    "half_space": [1.0, "free", rl.HalfSpace, rl.Homogeneous, {"E_star": 1.0}],
    "hardness": ["1 GPa", -1.0, math.nan, True, np.ones(2)],
    "depths": ["1", [None], [[1], [1, 2]], [True], [1j], {}, np.ma.masked_equal([1.0, 2.0], 2.0)],
    "forces": [None, -1.0, [math.inf], [], "10 N", 1e308],
    "n_loads": ["3", 2.5, 1, True, 10**12, math.nan, [3]],
    "periodic": ["no", 1, [True]],
    "fields": [3, "0", [True], [2], [-1], [0.5], None],
    "grid_error": ["yes", 1],
    "rtol": ["1e-6", 0.0, 1.0, math.nan, None],
    "solver": [8, "mixed", None],
    "throw": ["no", 0],
    "progress": [True, "bar"],
}


@pytest.mark.parametrize("name", WRONG_ARGUMENTS)
def test_every_argument_is_checked_and_named_in_one_line(surface, name):
    for wrong in WRONG_ARGUMENTS[name]:
        loads = {} if name in ("depths", "n_loads") else {"forces": [0.1]}
        modulus = {} if name == "half_space" else {"E_star": 1.0}
        with pytest.raises(rl.InputError) as refusal:
            rl.press(surface, **modulus | loads | {name: wrong})
        message = str(refusal.value)
        assert name in message or "no loads given" in message
        assert "\n" not in message
        assert len(message) < 250


@pytest.mark.parametrize(
    ("name", "wrong"),
    [
        ("max_iterations", [0, -3, 0.5, math.inf, "9"]),
        ("precision", ["half", None, ["mixed"], np.ones(2)]),
    ],
)
def test_every_setting_of_the_solver_is_checked_and_named_in_one_line(name, wrong):
    for given in wrong:
        with pytest.raises(rl.InputError, match=f"^{name} is .*[^\n]*$"):
            rl.Solver(**{name: given})


def test_whole_numbers_and_flags_may_come_from_numpy(surface):
    curve = rl.press(
        surface,
        E_star=np.float64(1),
        n_loads=np.int64(2),
        periodic=np.True_,
        fields=iter([np.int32(1)]),
        solver=rl.Solver(max_iterations=1e3),
    )
    assert [fields is not None for fields in curve.fields] == [False, True]
    assert curve.settings["boundary"] == "periodic"


@pytest.mark.parametrize("load", ["0", 0.5, None, True, [0], 2, -3])
def test_a_load_that_is_no_number_of_a_load_has_no_surface(surface, load):
    curve = rl.press(surface, E_star=1.0, forces=[0.1, 0.3], hardness=5.0)
    with pytest.raises(rl.InputError, match="load is "):
        curve.surface_after(load)


@pytest.mark.parametrize("E_star", [0.0, -1.0, math.nan, math.inf, "stiff"])
def test_an_impossible_modulus_is_refused(surface, line, E_star):
    for body in (surface, line):
        with pytest.raises(rl.InputError, match="E_star is .*; a positive, finite contact mod"):
            rl.press(body, E_star=E_star, depths=[0.1])


@pytest.mark.parametrize(
    ("given", "message"),
    [
        (
            {},
            "pressing needs E_star=, the contact modulus, which rl.contact_modulus(first, second)",
        ),
        ({"periodic": True}, "pressing needs E_star=, the contact modulus"),
        ({"half_space": rl.Homogeneous(1.0), "E_star": 1.0}, "leave E_star out"),
        ({"half_space": rl.Homogeneous(1.0), "periodic": False}, "leave periodic out"),
        ({"half_space": 1.0}, "half_space is 1.0; an rl.HalfSpace is needed, such as"),
        ({"half_space": rl.Homogeneous(1e160)}, "half_space.E_star is 1e+160; a positive, finite"),
    ],
)
def test_a_half_space_is_given_once(surface, line, given, message):
    for body in (surface, line):
        with pytest.raises(rl.InputError, match=re.escape(message)):
            rl.press(body, forces=[0.1], **given)


def test_the_short_forms_mean_the_homogeneous_half_space(surface, line):
    for body, periodic in ((surface, False), (surface, True), (line, False)):
        half_space = rl.Homogeneous(2.0, periodic)
        short = rl.press(body, E_star=2.0, periodic=periodic, forces=[0.1])
        curve = rl.press(body, half_space=half_space, forces=[0.1])
        assert short.half_space == curve.half_space == half_space
        assert curve.E_star == 2.0
        assert curve.depth.tolist() == short.depth.tolist()
        assert curve.settings == short.settings


def test_a_line_has_the_modulus_of_a_free_half_space_and_no_more(line):
    with pytest.raises(rl.InputError, match="periodic, fields and grid_error belong to the full"):
        rl.press(line, half_space=rl.Homogeneous(1.0, periodic=True), forces=[0.1])

    class Other(rl.HalfSpace):
        E_star, periodic = 1.0, False
        spectrum = in_units = None

    with pytest.raises(rl.InputError, match="half_space is an Other; the springs of a Line have"):
        rl.press(line, half_space=Other(), forces=[0.1])


def test_impossible_settings_are_refused(surface, line):
    with pytest.raises(rl.InputError, match="rtol is 0"):
        rl.press(surface, E_star=1.0, depths=[0.1], rtol=0)
    with pytest.raises(rl.InputError, match="max_iterations is -3"):
        rl.Solver(max_iterations=-3)
    with pytest.raises(rl.InputError, match="body is a ndarray; a Surface or a Line"):
        rl.press(surface.heights, E_star=1.0, depths=[0.1])
    with pytest.raises(
        rl.InputError, match="periodic, fields and grid_error belong to the full model"
    ):
        rl.press(line, E_star=1.0, depths=[0.1], periodic=True)


def test_a_periodic_depth_beyond_full_contact_is_refused(surface):
    full_contact = float(np.mean(surface.heights.max() - surface.heights))
    with pytest.raises(rl.InputError, match="beyond reach: .* full contact at"):
        rl.press(surface, E_star=1.0, depths=[0.1, 1.01 * full_contact], periodic=True)
    curve = rl.press(surface, E_star=1.0, depths=[0.99 * full_contact], periodic=True)
    assert curve.area_fraction[0] > 0.8


def test_constant_heights_are_a_punch_and_have_no_roughness():
    punch = rl.Surface(np.full((8, 8), 3.0), sizes=(1, 1))
    curve = rl.press(punch, E_star=1.0, depths=[1e-3])
    assert curve.area_fraction[0] == 1
    assert curve.stiffness[0] == pytest.approx(curve.force[0] / 1e-3, rel=1e-6)
    assert rl.press(punch, E_star=1.0, forces=curve.force).depth[0] == pytest.approx(1e-3)
    with pytest.raises(rl.InputError, match="all heights are 3: a flat punch has no range"):
        rl.press(punch, E_star=1.0, n_loads=5)
    with pytest.raises(
        rl.InputError, match=r"forces\[0\] is 1e-150 of the largest load, too small"
    ):
        rl.press(punch, E_star=1.0, forces=[1e-150, 1.0])
    with pytest.raises(rl.InputError, match="heights are constant, so their rms h is 0"):
        _ = curve.force_bar
    with pytest.raises(rl.InputError, match="all heights are 0"):
        rl.press(rl.Line(np.zeros(8), 1.0), E_star=1.0, n_loads=5)


def test_a_measured_profile_is_not_pressed_as_a_reduced_line(line):
    profile = rl.Line(line.heights, 1.0, kind="profile")
    with pytest.raises(rl.InputError, match="a straight cut, and not the reduced line"):
        rl.press(profile, E_star=1.0, n_loads=5)


def test_what_does_not_converge_is_said(surface):
    with pytest.raises(rl.ConvergenceError, match="max_iterations reached") as caught:
        rl.press(surface, E_star=1.0, forces=[0.01, 0.5], solver=rl.Solver(max_iterations=2))
    partial = caught.value.curve
    curve = rl.press(
        surface, E_star=1.0, forces=[0.01, 0.5], solver=rl.Solver(max_iterations=2), throw=False
    )
    assert partial.status.tolist() == curve.status.tolist()
    failed = curve.status != rl.Status.CONVERGED
    assert failed[-1]
    assert curve.status[-1] == rl.Status.MAX_ITERATIONS
    assert np.isnan(curve.stiffness[failed]).all()
    assert np.isnan(curve.force[failed]).all()
    assert (curve.residual[failed] > 1e-6).all()


def test_a_tolerance_beyond_double_precision_is_not_claimed(surface, monkeypatch):
    monkeypatch.setattr(
        "roughline.contact.loads._GAP_ROUNDING", 0.0
    )  # let it through to the solver
    curve = rl.press(surface, E_star=1.0, forces=[1e7], rtol=1e-12, throw=False)
    assert curve.status[0] in (rl.Status.STALLED, rl.Status.MAX_ITERATIONS)
    with pytest.raises(rl.ConvergenceError, match="stalled|max_iterations"):
        rl.press(surface, E_star=1.0, forces=[1e7], rtol=1e-12)


@pytest.mark.parametrize(
    ("loads", "message"),
    [
        ({"forces": [1e300]}, "forces[0] is 1e+300 E* h L: so deep, double precision cannot"),
        ({"forces": [1.0, 1e10]}, "forces[1] is 1e+10 E* h L: so deep"),
        ({"depths": [1e10]}, "depths[0] is 1e+10 rms heights: so deep"),
        (
            {"forces": [1e-300]},
            "forces[0] is 1e-300 E* h L, too small to differ from zero",
        ),
        ({"depths": [1e-200, 1.0]}, "depths[0] is 1e-200 rms heights, too small"),
    ],
)
def test_loads_beyond_double_precision_are_refused(surface, loads, message):
    with pytest.raises(rl.InputError, match=re.escape(message)):
        rl.press(surface, E_star=1.0, **loads)
    assert rl.press(surface, E_star=1.0, forces=[1e-30, 1e8]).converged.all()


@pytest.mark.parametrize("loads", [{"depths": [1.0, 2.0]}, {"forces": [0.1, 2.0]}])
def test_a_single_iteration_is_too_few_and_harmless(surface, loads):
    curve = rl.press(
        surface, E_star=1.0, solver=rl.Solver(max_iterations=1), throw=False, fields=True, **loads
    )
    assert (curve.status == rl.Status.MAX_ITERATIONS).all()
    assert np.isnan(curve.stiffness).all()
    assert curve.fields == (None, None)
    assert "pressure" not in curve.to_dataset()


def test_progress_is_told_after_each_load(surface):
    told = []
    rl.press(surface, E_star=1.0, n_loads=4, progress=lambda *args: told.append(args))
    assert told == [(1, 4), (2, 4), (3, 4), (4, 4)]


@pytest.mark.parametrize("periodic", [False, True])
def test_a_failed_load_does_not_poison_the_next(surface, periodic):
    forces = np.geomspace(1e-3, 3, 6)
    whole = rl.press(surface, E_star=1.0, forces=forces, periodic=periodic)
    starved = rl.press(
        surface,
        E_star=1.0,
        forces=forces,
        periodic=periodic,
        solver=rl.Solver(max_iterations=25),
        throw=False,
    )
    solved = starved.converged
    assert starved.stiffness[solved] == pytest.approx(whole.stiffness[solved], rel=1e-6)


def test_dimensionless_numbers_are_the_papers(surface, line):
    curve = rl.press(surface.scaled(2.0), E_star=5.0, forces=[0.3])
    assert curve.force_bar[0] == pytest.approx(0.3 / (5 * 2 * 1))
    large = rl.Surface(surface.heights, (2.0, 8.0))  # of the length 4
    wide = rl.press(large, E_star=5.0, forces=[0.3])
    assert wide.force_bar[0] == pytest.approx(0.3 / (5 * surface.rms_height * 4))
    assert wide.stiffness_bar[0] == pytest.approx(wide.stiffness[0] / (1.1419 * 5 * 4))
    assert curve.stiffness_bar[0] == pytest.approx(curve.stiffness[0] / (1.1419 * 5))
    curve = rl.press(line, E_star=5.0, forces=[0.3])
    assert curve.stiffness_bar[0] == pytest.approx(curve.stiffness[0] / 5)


def test_a_written_curve_carries_units_and_settings(surface, tmp_path):
    import xarray

    curve = rl.press(surface, E_star=1.0, n_loads=4, fields=True)
    curve.write(tmp_path / "curve.nc")
    with xarray.open_dataset(tmp_path / "curve.nc", engine="h5netcdf") as data:
        assert data.stiffness.values == pytest.approx(curve.stiffness)
        assert data.pressure.dims == ("force", "x", "y")
        assert data.stiffness.attrs["units"] == "force/length"
        assert data.attrs["roughline_version"] == rl.__version__
        assert data.attrs["body_seed"] == "entropy 7, spawn key ()"
        assert data.attrs["rtol"] == 1e-6
    with pytest.raises(rl.StoreError, match="cannot write"):
        curve.write(tmp_path / "no" / "such" / "folder.nc")


def test_files_hold_fields_of_the_loads_alone_of_which_they_were_kept(surface, tmp_path):
    import xarray

    forces = np.geomspace(0.01, 1.0, 20)
    curve = rl.press(surface, E_star=1.0, forces=forces, fields=[3, 17])
    curve.write(tmp_path / "curve.nc")
    with xarray.open_dataset(tmp_path / "curve.nc", engine="h5netcdf") as data:
        assert data.pressure.dims == ("field_load", "x", "y")
        assert data.field_load.values.tolist() == [3, 17]
        assert data.force[data.field_load].values.tolist() == forces[[3, 17]].tolist()
        shown = data.pressure.sel(field_load=17)
        assert (shown.values == curve.fields[17].pressure).all()
        assert data.nbytes < 2.1 * 4 * 8 * 32**2 + 20 * 200
    curve.write(tmp_path / "curve.csv")
    assert len((tmp_path / "curve.csv").read_text(encoding="utf-8").splitlines()) == 21


@pytest.mark.parametrize("control", ["force", "depth"])
def test_a_curve_is_drawn_over_what_was_prescribed(surface, line, control):
    from matplotlib.figure import Figure

    for body in (surface, line):
        curve = rl.press(body, E_star=1.0, **{f"{control}s": [0.1, 0.3, 1.0]})
        (drawn,) = curve.to_dataset().stiffness.plot(ax=(axes := Figure().subplots()))
        assert drawn.get_xdata() == pytest.approx(getattr(curve, control))
        assert drawn.get_ydata() == pytest.approx(curve.stiffness)
        assert control in axes.get_xlabel()


def test_a_curve_is_written_as_its_name_says(surface, tmp_path):
    curve = rl.press(surface, E_star=1.0, forces=[0.1, 0.3], fields=True)
    curve.write(str(tmp_path / "curve.csv"))
    header, *rows = (tmp_path / "curve.csv").read_text(encoding="utf-8").splitlines()
    assert header.startswith("force [force],depth [length],stiffness [force/length],status,")
    assert "pressure" not in header
    assert [float(row.split(",")[2]) for row in rows] == curve.stiffness.tolist()
    for path in (3, None, b"curve.nc"):
        with pytest.raises(rl.InputError, match="path is "):
            curve.write(path)
    for name in ("curve.h5", "curve", "curve.txt"):
        with pytest.raises(rl.InputError, match=f'{name} ends in neither ".nc"'):
            curve.write(tmp_path / name)
        assert not (tmp_path / name).exists()
