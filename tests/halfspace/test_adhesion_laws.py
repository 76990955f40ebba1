"""What holds of all bodies that stick, whatever their surfaces."""

from __future__ import annotations

import numpy as np
import pytest

import roughline as rl
from random_cases import cases, seeds
from roughline.contact.loads import even_cycle, separation_depth
from roughline.halfspace.inverse.cache import inverse_on
from roughline.halfspace.laws.pulling_zone import RESOLVED_FROM, facts_of_pull, farthest_pulled
from roughline.halfspace.operators.cell import cell_compliance

FORCE = 1e-5  # over the largest: rounds end where gaps are right to the tolerance
LAWS = [rl.Dugdale, rl.Exponential]


def surface(seed=1, n=32, hurst=0.7, sizes=(1.0, 1.0)):
    made = rl.SelfAffine(hurst=hurst, rms_height=0.02).surface(n, seed)
    return rl.Surface(made.heights, sizes)


def law_for(body, law=rl.Dugdale, reach=0.3, zone=6.0, E_star=1.0):
    """A law whose range is a part of the rms height, and whose zone has so many cells."""
    h_0 = reach * body.rms_height
    return law(E_star * h_0**2 / (np.pi * zone * np.sqrt(body.area / body.heights.size)), h_0)


def there_and_back(body, law, count=12):
    """Depths from out of reach to a third of the mean separation, and the same ones back."""
    deepest = 0.35 * float((body.heights.max() - body.heights).mean())
    steps = np.linspace(-2.2 * law.range, deepest, count)
    return np.concatenate([steps, steps[-2::-1]])


@pytest.mark.parametrize("periodic", [False, True])
@pytest.mark.parametrize("law", LAWS)
@pytest.mark.parametrize("seed", range(3))
def test_a_cycle_never_gives_work(law, seed, periodic):
    """On the way apart bodies hold each other where they did not pull on the way nearer."""
    body = surface(seed)
    of_body = law_for(body, law)
    depths = there_and_back(body, of_body)
    curve = rl.press(body, E_star=1.0, periodic=periodic, law=of_body, depths=depths, fields=True)
    count = depths.size // 2 + 1
    nearer, apart = curve.force[:count], curve.force[count - 1 :][::-1]
    largest = np.abs(curve.force).max()
    assert (apart <= nearer + FORCE * largest).all()
    assert np.trapezoid(nearer - apart, depths[:count]) >= -FORCE * largest * of_body.range
    assert curve.on_approach.tolist() == [True] * count + [False] * (count - 1)
    assert (curve.stiffness >= 0).all()

    def reached(i):
        return curve.fields[i].pressure != 0 if law is rl.Dugdale else curve.fields[i].contact

    for i in range(1, count):  # the reach grows on the way nearer, and shrinks on the way apart
        assert (reached(i) >= reached(i - 1)).all()
    for i in range(count, depths.size):
        assert (reached(i) <= reached(i - 1)).all()
    for i in range(count):  # and is wider at each depth on the way apart
        assert (reached(depths.size - 1 - i) >= reached(i)).all()


@pytest.mark.parametrize("law", LAWS)
def test_a_cycle_from_out_of_reach_and_back_dissipates_what_it_encloses(law):
    spectrum = rl.SelfAffine(hurst=0.8, rms_height=4e-3, q_roll=25.0, q_high=50.0)
    body, of_body = spectrum.surface(64, rng=4), law(2.5e-4, 7e-3)
    deepest = 0.5 * float((body.heights.max() - body.heights).mean())
    apart = separation_depth(body, rl.Homogeneous(1.0), of_body, deepest)
    depths = even_cycle(-farthest_pulled(of_body), deepest, apart, 120).values
    curve = rl.press(body, E_star=1.0, law=of_body, depths=depths)
    assert curve.force[0] == pytest.approx(0, abs=FORCE * np.abs(curve.force).max())
    assert curve.force[-1] == pytest.approx(0, abs=FORCE * np.abs(curve.force).max())
    enclosed = np.trapezoid(curve.force, curve.depth)
    assert curve.dissipated_work[-1] == pytest.approx(enclosed, rel=0.05)
    assert enclosed > 0.005 * of_body.work_of_adhesion * body.area
    assert curve.pull_off_force == pytest.approx(curve.force.min(), rel=0.05)
    assert curve.pull_off_force < 0


def test_the_work_of_a_cycle_without_a_jump_comes_to_nothing():
    """As the loads come closer, faster than by the trapezoidal rule."""
    body = surface(4)
    of_body = law_for(body, reach=0.3, zone=8.0)
    deepest = 0.3 * float((body.heights.max() - body.heights).mean())
    left = []
    for count in (8, 16, 32):
        there = np.linspace(-2.2 * of_body.range, deepest, count)
        back = np.linspace(deepest, -2.2 * of_body.range, 3 * count)[1:]
        curve = rl.press(body, E_star=1.0, law=of_body, depths=[*there, *back])
        left.append(abs(curve.dissipated_work[-1]) / curve.work.max())
    assert left[2] < left[0] / 20
    assert left[2] < 3e-3


@pytest.mark.parametrize("law", LAWS)
@pytest.mark.parametrize("count", [100, 200])
def test_stored_work_is_what_force_does_where_nothing_jumps(law, count):
    """The energies of bodies and of the pull change by F dd, and nothing is dissipated."""
    body = surface(2, n=16)
    of_body = law_for(body, law, reach=1.0, zone=60.0)  # a wide, weak pull
    deepest = 0.3 * float((body.heights.max() - body.heights).mean())
    curve = rl.press(
        body, E_star=1.0, law=of_body, depths=np.linspace(0.0, deepest, count), rtol=1e-9
    )
    assert np.abs(curve.dissipated_work).max() < 2e-4 * curve.work.max()


@pytest.mark.parametrize("law", LAWS)
def test_units_do_not_matter(law):
    body, length, pressure = surface(5), 3e-7, 4e9
    of_body = law_for(body, law)
    other_body = rl.Surface(body.heights * length, (length, length))
    other_law = law(of_body.work_of_adhesion * length * pressure, of_body.range * length)
    depths = there_and_back(body, of_body, 6)
    one = rl.press(body, E_star=1.0, law=of_body, depths=depths)
    other = rl.press(other_body, E_star=pressure, law=other_law, depths=depths * length)
    unit = pressure * length**2
    largest = np.abs(one.force).max()
    assert other.force / unit == pytest.approx(one.force, abs=FORCE * largest)
    assert other.pulling_fraction == pytest.approx(one.pulling_fraction, abs=FORCE)


@pytest.mark.parametrize("law", LAWS)
def test_heights_work_and_range_scale_together(law):
    """Heights and range times s, work times s²: pressures and forces times s."""
    body, s = surface(6), 3.0
    of_body = law_for(body, law)
    higher = rl.Surface(body.heights * s, body.sizes)
    stronger = law(of_body.work_of_adhesion * s**2, of_body.range * s)
    depths = there_and_back(body, of_body, 6)
    one = rl.press(body, E_star=1.0, law=of_body, depths=depths)
    other = rl.press(higher, E_star=1.0, law=stronger, depths=depths * s)
    assert other.force / s == pytest.approx(one.force, abs=FORCE * np.abs(one.force).max())


@pytest.mark.parametrize("periodic", [False, True])
@pytest.mark.parametrize("law", LAWS)
def test_without_work_they_are_elastic_bodies_to_the_bit(law, periodic):
    body = surface(7)
    depths = np.linspace(0.1, 0.4, 3) * float((body.heights.max() - body.heights).mean())
    elastic = rl.press(body, E_star=1.0, periodic=periodic, depths=depths, fields=True)
    forces = elastic.force
    for loads in ({"depths": depths}, {"forces": forces}):
        plain = rl.press(body, E_star=1.0, periodic=periodic, fields=True, **loads)
        none = rl.press(
            body, E_star=1.0, periodic=periodic, law=law(1e-300, 0.01), fields=True, **loads
        )
        for name in ("force", "depth", "stiffness", "area_fraction", "residual"):
            assert (getattr(none, name) == getattr(plain, name)).all(), name
        for ours, theirs in zip(none.fields, plain.fields, strict=True):
            assert (ours.pressure == theirs.pressure).all()
    work = [1e-9, 1e-7]
    off = [
        np.abs(
            rl.press(body, E_star=1.0, periodic=periodic, law=law(w, 0.01), depths=depths).force
            / forces
            - 1
        ).max()
        for w in work
    ]
    assert off[0] < off[1] / 50  # it comes to nothing evenly


def test_forces_are_those_of_depths():
    body = surface(8)
    of_body = law_for(body, reach=0.4)
    forces = np.array([2.0, 0.5, 0.0, -0.5, 1.0]) * 1e-4
    by_force = rl.press(body, E_star=1.0, law=of_body, forces=forces, rtol=1e-8)
    by_depth = rl.press(body, E_star=1.0, law=of_body, depths=by_force.depth, rtol=1e-8)
    assert (by_force.force == forces).all()
    assert by_depth.force == pytest.approx(forces, abs=1e-7 * 2e-4)
    assert by_depth.stiffness == pytest.approx(by_force.stiffness, rel=1e-6)


def test_a_pull_beyond_the_largest_is_told():
    body = surface(8)
    of_body = law_for(body, reach=0.4)
    with pytest.raises(rl.ConvergenceError) as refused:
        rl.press(body, E_star=1.0, law=of_body, forces=[1e-4, -1.0, 2e-4])
    said, curve = str(refused.value), refused.value.curve
    assert "\n" not in said
    assert "pulled off" in said
    assert f"the largest is {-curve.pull_off_force:.4g}, at depth" in said
    assert curve.status.tolist() == [0, 6, 0]  # they touch again
    again = rl.press(body, E_star=1.0, law=of_body, forces=[2e-4])
    assert curve.depth[2] == pytest.approx(again.depth[0], rel=1e-6)
    near, beyond = curve.pull_off_force * np.array([0.999, 1.001])
    found = rl.press(body, E_star=1.0, law=of_body, forces=[1e-4, near, beyond], throw=False)
    assert found.status.tolist() == [0, 0, 6]
    depths = np.linspace(float(found.depth[1]), -4 * of_body.range, 30)
    apart = rl.press(body, E_star=1.0, law=of_body, depths=[float(curve.depth[0]), *depths])
    assert apart.force.min() >= curve.pull_off_force * (1 + 1e-4)


@pytest.mark.parametrize(
    ("law", "said"),
    [
        (lambda: rl.Dugdale(0.0, 1.0), "work_of_adhesion is 0.0; a positive, finite"),
        (lambda: rl.Dugdale(-1.0, 1.0), "work_of_adhesion is -1.0; a positive, finite"),
        (lambda: rl.Dugdale(np.nan, 1.0), "work_of_adhesion is nan; a positive, finite"),
        (lambda: rl.Exponential(1.0, np.inf), "range is inf; a positive, finite length"),
        (lambda: rl.Exponential(1.0, 0.0), "range is 0.0; a positive, finite length"),
    ],
)
def test_what_is_no_pull_is_refused(law, said):
    with pytest.raises(rl.InputError, match=said) as refused:
        law()
    assert "\n" not in str(refused.value)


def cell_alone(body, E_star, periodic):
    """Displacement of a cell by unit pressure on it, of square cells, and of the grid's waves.

    Under these the even pressure displaces as the longest wave does.
    """
    dx = body.spacing[0]
    if not periodic:
        return 4 * np.arcsinh(1) * dx / (np.pi * E_star)
    q = 2 * np.pi * np.fft.fftfreq(len(body.heights), dx)
    q = np.hypot(q[:, np.newaxis], q)
    q[0, 0] = q[0, 1]
    return np.mean(2 / (E_star * q))


@pytest.mark.parametrize("times", [1 - 1e-6, 1 + 1e-6])
@pytest.mark.parametrize("periodic", [False, True])
def test_a_law_refuses_the_grids_on_which_its_pull_would_end_within_a_cell(periodic, times):
    """At a range h_0 with 4 (w / h_0) c = h_0; unit pressure on a cell displaces it by c."""
    body, work, E_star = surface(n=32), 1e-5, 2.0
    half_space = rl.Homogeneous(E_star, periodic)
    law = rl.Dugdale(work, times * np.sqrt(4 * work * cell_alone(body, E_star, periodic)))
    if times > 1:
        rl.press(body, half_space=half_space, law=law, depths=[-3 * law.range])
    else:
        with pytest.raises(rl.InputError, match="range is too short for the grid"):
            rl.press(body, half_space=half_space, law=law, depths=[0.0])
    rl.Exponential(work, 1e-9).refuse_grid(compliance=1.0)  # it ends evenly


@pytest.mark.parametrize(
    "half_space",
    [
        *(rl.Homogeneous(2.0, periodic) for periodic in (False, True, "x", "y")),
        *(rl.Layered(2.0, 0.3, 0.1, np.inf, periodic=each) for each in (False, True, "x")),
        rl.Layered(2.0, 0.3, 0.1, 20.0) + rl.Homogeneous(1.0),
        (rl.Layered(2.0, 0.3, 0.1, 20.0) + rl.Homogeneous(1.0)).interface,
    ],
    ids=str,
)
def test_a_grid_is_refused_by_the_number_that_the_search_has(half_space):
    shape, spacing = (16, 21), (0.3, 0.2)
    asked = cell_compliance(half_space, shape, spacing)
    assert asked == pytest.approx(inverse_on(half_space, shape, spacing).diagonal, rel=1e-10)


def test_what_the_grid_does_not_resolve_is_refused_or_told():
    body = surface(9)
    with pytest.raises(rl.InputError, match="range is too short for the grid.*at least") as refused:
        rl.press(body, E_star=1.0, law=law_for(body, zone=0.5), depths=[0.01])
    assert "\n" not in str(refused.value)
    poorly = rl.press(
        body, E_star=1.0, law=law_for(body, zone=1.8), forces=[0.0, -1.0], throw=False
    )
    assert "1.8 cells" in poorly.warnings[-1]
    assert "no pull-off is given" in poorly.warnings[-1]
    assert np.isnan(poorly.pull_off_force)
    assert poorly.settings["pulling_zone_cells"] == pytest.approx(1.8)
    assert poorly.settings["law"] == "Dugdale"
    assert poorly.settings["range"] == law_for(body, zone=1.8).range
    fairly = rl.press(
        body, E_star=1.0, law=law_for(body, zone=3.0), forces=[0.0, -1.0], throw=False
    )
    assert "3 cells" in fairly.warnings[-1]
    assert fairly.pull_off_force < 0
    far = law_for(body, reach=20.0, zone=1e4)
    assert (
        "larger than all heights" in rl.press(body, E_star=1.0, law=far, depths=[0.0]).warnings[-1]
    )


def test_a_line_does_not_stick():
    line = rl.Line(np.arange(8.0) % 3, length=1.0)
    with pytest.raises(rl.InputError, match="law.*bodies of revolution") as refused:
        rl.press(line, E_star=1.0, law=rl.Dugdale(1.0, 1.0), depths=[0.1])
    assert "\n" not in str(refused.value)
    with pytest.raises(rl.InputError, match="law and hardness"):
        rl.press(surface(), E_star=1.0, law=rl.Dugdale(1.0, 1.0), hardness=1.0, depths=[0.1])


@seeds(5, cases(2000, share=50))
def test_random_problems_are_certified_or_refused(seeds):
    from random_problems import E_STAR, random_problem

    solved, loads, refused = 0, 0, []
    for seed in seeds:
        rng = np.random.default_rng(seed)
        problem = random_problem(rng, largest=60)
        body, ((control, values),) = problem.surface, problem.loads.items()
        values = np.asarray(values)
        height = body.rms_height or float(np.abs(values).max()) or 1.0
        reach = height * 10 ** rng.uniform(-2, 1)
        cell = np.sqrt(body.area / body.heights.size)
        work = E_STAR * reach**2 / (np.pi * 10 ** rng.uniform(0, 3) * cell)
        law = LAWS[int(rng.integers(2))](work, reach)
        if control == "depths":
            back = values[::-1] * rng.uniform(0, 1)
            values = np.concatenate([values, -reach * rng.uniform(0, 5, 3), back])
        else:
            pulls = -0.01 * work / reach * body.area * rng.uniform(0, 1, 2)
            values = np.concatenate([values, values[::-1] * rng.uniform(-1, 1), pulls])
        half_space = rl.Homogeneous(E_STAR, periodic=problem.periodic)
        try:
            curve = rl.press(body, half_space=half_space, law=law, throw=False, **{control: values})
        except rl.InputError as error:
            refused.append(str(error))
            continue
        good = curve.converged
        assert (curve.residual[good] <= 1e-6).all(), seed
        assert np.isfinite(curve.force[good]).all(), seed
        assert np.isnan(curve.force[~good]).all(), seed
        told = good | (curve.status == rl.Status.PULLED_OFF)
        solved, loads = solved + int(told.sum()), loads + told.size
    assert solved > 0.97 * loads
    assert all("too short for the grid" in said and "\n" not in said for said in refused)


@pytest.mark.parametrize("periodic", [False, True])
@pytest.mark.parametrize("law", LAWS)
def test_nearly_smooth_bodies_touch_everywhere_without_a_load(law, periodic):
    body = rl.Surface(0.02 * surface(n=32).heights, sizes=(1.0, 1.0))
    sticky = law(work_of_adhesion=0.01, range=0.2)
    forces = [1e-3, 0.0, -1e-3, 1e-3, 0.0]
    curve = rl.press(body, E_star=1.0, periodic=periodic, law=sticky, forces=forces)
    first = rl.press(body, E_star=1.0, periodic=periodic, law=sticky, forces=[0.0])
    assert (curve.area_fraction == 1).all()
    assert first.depth == pytest.approx(curve.depth[1], rel=1e-6)
    assert first.area_fraction == 1


def test_what_stalls_in_single_precision_is_found_in_double():
    """On heights so small beside the range of the pull that single precision tells few apart."""
    spectrum = rl.SelfAffine(hurst=0.8, rms_height=1e-4, q_roll=12, q_high=50)
    body, sticky = spectrum.surface(16, rng=1), rl.Exponential(work_of_adhesion=0.2, range=0.4)
    depths = [-0.2, 0.1, 0.3, 0.1, -0.1, -0.3]
    mixed, double = (
        rl.press(body, E_star=1.0, law=sticky, depths=depths, solver=rl.Solver(precision=precision))
        for precision in ("mixed", "float64")
    )
    assert mixed.force == pytest.approx(double.force, abs=FORCE * np.abs(double.force).max())
    assert (mixed.area_fraction == double.area_fraction).all()


@pytest.mark.parametrize("law", LAWS)
@pytest.mark.parametrize("periodic", [False, True])
@pytest.mark.parametrize("rms_height", [0.001, 0.1, 1.0])
def test_a_pull_after_any_load_finds_the_dip_of_the_branch_on_retreat(law, periodic, rms_height):
    """Weakly and strongly sticking surfaces, from full contact too."""
    spectrum = rl.SelfAffine(hurst=0.8, rms_height=rms_height, q_roll=12, q_high=50)
    body, sticky = spectrum.surface(32, rng=1), law(work_of_adhesion=0.2, range=0.4)
    pressed = {"E_star": 1.0, "periodic": periodic, "law": sticky}
    under = rl.press(body, **pressed, forces=[0.05, 0.5, -1.0], throw=False)
    assert under.status[-1] == rl.Status.PULLED_OFF
    apart = under.pull_off_depth + np.linspace(0.2, -0.2, 81)
    deepest = under.depth[1]
    if under.area_fraction[1] == 1 and periodic:
        deepest *= 1 - 1e-6
    apart = [each for each in apart if each < deepest]
    drawn = rl.press(body, **pressed, depths=[deepest, *apart])
    assert under.pull_off_force < 0
    assert drawn.force.min() >= under.pull_off_force * (1 + 1e-3)
    assert drawn.force.min() <= under.pull_off_force * (1 - 0.05)


def test_a_range_that_is_a_little_too_short_is_told_to_be_so():
    """Never that one times as much is needed, nor that four cells are fewer than four."""
    for zone in (3.999999, 3.9, 1.0, 0.5):
        law = rl.Dugdale(1.0, (np.pi * zone) ** 0.5)  # h_0² / (pi w) cells
        (remark,) = map(str, facts_of_pull(law, 1e3))
        wider = float(remark.split("range ")[1].split(" times")[0])
        cells = float(remark.split("is ")[1].split(" cells")[0])
        assert wider > 1
        assert wider**2 * zone >= RESOLVED_FROM
        assert cells < 4


def test_the_pull_off_is_the_same_however_far_beyond_it_a_pull_is():
    """Its dip is as wide as the pull reaches, and the pull that is asked for far beyond it."""
    surface = rl.SelfAffine(hurst=0.8, rms_height=1.0, length=1.0).surface(64, rng=7)
    asked = {"E_star": 1.0, "law": rl.Dugdale(1.0, 0.5), "throw": False}
    depths = np.linspace(2.3, -0.7, 61)
    least = rl.press(surface, depths=depths, **asked).force.min()
    for pulls in ([0, -0.2], [0, -2.02], [0.08, 0, -2.02]):
        found = rl.press(surface, forces=[0.16, *pulls], **asked).pull_off_force
        assert found == pytest.approx(-0.0301878, rel=1e-4)
        assert found <= least
