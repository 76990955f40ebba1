"""Random bodies that yield, under random histories: each is certified, or refused in one line."""

import numpy as np
import pytest

import roughline as rl
from random_cases import cases, seeds
from random_problems import E_STAR, random_history
from roughline.halfspace.elasticity.homogeneous import Homogeneous
from roughline.halfspace.operators.convolution import displacement_field
from roughline.halfspace.operators.discretisation import on_grid

RTOL = {"mixed": 1e-6, "float64": 1e-6, "float32": 1e-3}
ROUNDING = {"mixed": 1e-14, "float64": 1e-14, "float32": 1e-6}


@seeds(15, cases(2000, share=20))
def test_random_histories_are_certified_or_refused(seeds):
    tried = [pressed(np.random.default_rng([5, i])) for i in seeds]
    said = [each for each in tried if isinstance(each, str)]
    assert not [each for each in said if "\n" in each]
    assert len(said) < 0.1 * len(seeds)
    yielded = [each for each in tried if each is True]
    assert len(yielded) > 0.3 * len(seeds)  # the others are harder than their steepest pressures


def pressed(rng):
    """Press a random problem and check all of it; say whether it yields, or how it is refused."""
    problem = random_history(rng)
    precision = str(rng.choice(list(RTOL)))
    settings = {"rtol": RTOL[precision], "fields": True}
    settings["solver"] = rl.Solver(precision=precision)
    try:
        curve = rl.press(
            problem.surface,
            E_star=E_STAR,
            hardness=problem.hardness,
            periodic=problem.periodic,
            **problem.loads,
            **settings,
        )
    except rl.InputError as error:
        return str(error)
    assert curve.converged.all()
    assert (curve.residual <= RTOL[precision]).all()
    assert np.isfinite([curve.depth, curve.force, curve.area_fraction, curve.work]).all()
    assert (curve.stiffness >= 0).all()
    assert (curve.stiffness <= curve.unloading_stiffness * (1 + 1e-6)).all()
    assert (np.diff(curve.dissipated_work) >= 0).all()
    assert_conditions(problem, curve, precision)
    return bool(curve.plastic_fraction.any())


def assert_conditions(problem, curve, precision):
    """Recompute what is certified from the fields."""
    surface, hardness, rtol = problem.surface, problem.hardness, RTOL[precision]
    operator = on_grid(Homogeneous(E_STAR, problem.periodic), surface.shape, surface.spacing)
    separation = surface.heights.max() - surface.heights
    # gaps of flat bodies are compared with what the largest load springs
    largest = max(fields.pressure.max() for fields in curve.fields)
    sprung = largest * max(surface.sizes) / E_STAR
    for i, found in enumerate(curve.fields):
        p = found.pressure
        if not found.contact.any():
            assert not p.any()
            continue
        u = displacement_field(operator, p)
        gap = u + separation + found.indentation - curve.depth[i]
        size = max(sprung, curve.depth[i], found.indentation.max())
        tolerance = rtol * (surface.rms_height or sprung) + ROUNDING[precision] * size
        assert np.abs(gap[found.contact]).max() <= tolerance
        assert gap.min() >= -tolerance
        assert p.min() >= 0
        assert p.max() <= hardness * (1 + 1e-12)
        assert (p[found.plastic] >= hardness * (1 - 1e-12)).all()


@pytest.mark.parametrize("periodic", [False, True])
@pytest.mark.parametrize("softness", [0.3, 3e-3])
def test_a_second_level_that_bears_what_the_first_one_cannot(softness, periodic):
    """Thousands of nodes begin to bear, and to yield, at all but one depth."""
    heights = np.where(np.random.default_rng(3).random((32, 32)) < 0.25, 1.0, 0.0)
    surface = rl.Surface(heights, (32.0, 32.0))
    force = 0.6 * softness * surface.area
    curve = rl.press(
        surface, E_star=1.0, hardness=softness, forces=[force], periodic=periodic, fields=True
    )
    assert curve.fields[0].plastic[heights == 1].all()
    assert curve.fields[0].contact[heights == 0].mean() > 0.9
    by_depth = rl.press(
        surface, E_star=1.0, hardness=softness, depths=curve.depth, periodic=periodic
    )
    assert by_depth.force[0] == pytest.approx(force, rel=1e-4)
    assert by_depth.stiffness == pytest.approx(curve.stiffness, rel=1e-6)


@pytest.mark.parametrize("seed", [0, 146, 1179, 1408, 1965, 2355, 2973, 3594])
def test_forces_that_whole_nodes_at_the_hardness_bear(seed):
    """Under these, no node need be elastic, and many depths would do."""
    rng = np.random.default_rng([9, seed])
    nx, ny = (int(n) for n in rng.integers(3, 31, 2))
    spectrum = rl.SelfAffine(hurst=float(rng.choice([0.0, 0.3, 0.7, 1.0])), rms_height=1.0)
    heights = spectrum.surface(30, int(rng.integers(5))).heights[:nx, :ny]
    surface = rl.Surface(heights, (nx / 40, rng.choice([0.1, 0.5, 1.0, 3.0]) * ny / 40))
    hardness = surface.rms_slope * 10 ** rng.choice([-2, -1.5, -1, -0.5])
    hardness *= 10.0 ** rng.integers(0, 2)
    nodes = int(rng.integers(1, nx * ny))
    force = nodes * hardness * (surface.area / heights.size)
    periodic = bool(rng.random() < 0.3)
    for rounding in (-4e-16, -2e-16, 0, 2e-16, 4e-16):
        forces = [force * (1 + rounding)]
        curve = rl.press(surface, E_star=1.0, hardness=hardness, forces=forces, periodic=periodic)
        assert curve.area_fraction[0] * heights.size >= nodes
