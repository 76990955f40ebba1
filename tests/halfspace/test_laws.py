"""Laws that the full model obeys whatever the surface."""

import numpy as np
import pytest
from hypothesis import strategies as st

import roughline as rl
from random_surfaces import laws, surfaces
from roughline.exact.punch import square_stiffness
from roughline.halfspace.elasticity.homogeneous import Homogeneous
from roughline.halfspace.operators.convolution import displacement_field
from roughline.halfspace.operators.discretisation import on_grid

RTOL = 1e-6  # the certified tolerance
NEUTRAL = 1e-9  # the problem is solved without units: only their rounding is left

boundaries = st.booleans()


def reachable_depths(surface, count=5, upto=0.95):
    deepest = float(np.mean(surface.heights.max() - surface.heights))
    return np.linspace(0.1, upto, count) * deepest


@laws(surfaces(), boundaries, st.floats(-9, 9), st.floats(-9, 9), st.floats(-9, 9))
def test_units_do_not_matter(surface, periodic, height, length, modulus):
    height, length, modulus = 10.0 ** np.array([height, length, modulus])
    depths = reachable_depths(surface, 3)
    one = rl.press(surface, E_star=1.0, depths=depths, periodic=periodic)
    sizes = (surface.sizes[0] * length, surface.sizes[1] * length)
    scaled = rl.Surface(surface.heights * height, sizes)
    other = rl.press(scaled, E_star=modulus, depths=depths * height, periodic=periodic)
    assert other.force == pytest.approx(one.force * modulus * height * length, rel=10 * RTOL)
    assert other.stiffness == pytest.approx(one.stiffness * modulus * length, rel=NEUTRAL)
    assert (other.area_fraction == one.area_fraction).all()


@laws(surfaces(square=True), boundaries)
def test_mirrors_turns_and_shifts_of_the_datum_do_not_matter(surface, periodic):
    depths = reachable_depths(surface, 3)
    one = rl.press(surface, E_star=1.0, depths=depths, periodic=periodic)
    h = surface.heights
    for same in (h[::-1], h[:, ::-1], h.T, np.rot90(h), h + 5.0):
        other = rl.press(
            rl.Surface(same, surface.sizes), E_star=1.0, depths=depths, periodic=periodic
        )
        assert other.force == pytest.approx(one.force, rel=10 * RTOL)
        assert other.stiffness == pytest.approx(one.stiffness, rel=1e-7)
        assert (other.area_fraction == one.area_fraction).all()


@laws(surfaces(), boundaries)
def test_contact_sets_are_nested_force_is_convex_and_stiffness_rises(surface, periodic):
    curve = rl.press(
        surface, E_star=1.0, depths=reachable_depths(surface, 6), periodic=periodic, fields=True
    )
    for lighter, heavier in zip(curve.fields, curve.fields[1:], strict=False):
        assert (heavier.contact | ~lighter.contact).all()
    assert (np.diff(curve.stiffness) >= -1e-8 * curve.stiffness[1:]).all()
    chords = np.diff(curve.force) / np.diff(curve.depth)
    slack = 10 * RTOL * curve.stiffness[1:]
    assert (chords >= curve.stiffness[:-1] - slack).all()
    assert (chords <= curve.stiffness[1:] + slack).all()


@laws(surfaces(square=True))
def test_stiffness_lies_between_the_secant_and_the_punch(surface):
    curve = rl.press(surface, E_star=1.0, n_loads=6)
    flat = rl.Surface(np.zeros(surface.shape), surface.sizes)
    punch = rl.press(flat, E_star=1.0, depths=[1.0]).stiffness[0]
    assert (curve.force / curve.depth <= curve.stiffness * (1 + 10 * RTOL)).all()
    assert (curve.stiffness <= punch * (1 + 1e-8)).all()
    assert punch < square_stiffness(1.0, surface.sizes[0])


@laws(surfaces(), boundaries)
def test_the_tangent_is_the_centred_difference(surface, periodic):
    depths = reachable_depths(surface, 4)
    tangent = rl.press(
        surface, E_star=1.0, depths=depths, periodic=periodic, fields=True, rtol=1e-9
    )
    for i, depth in enumerate(depths):
        near = rl.press(
            surface,
            E_star=1.0,
            depths=depth * np.array([1 - 1e-4, 1 + 1e-4]),
            periodic=periodic,
            fields=True,
            rtol=1e-9,
        )
        if all((fields.contact == tangent.fields[i].contact).all() for fields in near.fields):
            slope = np.diff(near.force)[0] / np.diff(near.depth)[0]
            assert tangent.stiffness[i] == pytest.approx(slope, rel=1e-4)


@laws(surfaces(), boundaries)
def test_force_and_depth_control_are_one_problem(surface, periodic):
    by_depth = rl.press(surface, E_star=1.0, depths=reachable_depths(surface, 4), periodic=periodic)
    by_force = rl.press(surface, E_star=1.0, forces=by_depth.force, periodic=periodic)
    assert by_force.depth == pytest.approx(by_depth.depth, rel=10 * RTOL)
    assert by_force.stiffness == pytest.approx(by_depth.stiffness, rel=1e-7)
    assert (by_force.area_fraction == by_depth.area_fraction).all()


@laws(surfaces(), boundaries, st.booleans())
def test_what_is_returned_obeys_the_contact_conditions(surface, periodic, by_force):
    """Residuals recomputed from the fields alone, with an operator made anew."""
    loads = {"forces": [1e-3, 0.1, 2.0]} if by_force else {"depths": reachable_depths(surface, 3)}
    curve = rl.press(surface, E_star=1.0, periodic=periodic, fields=True, **loads)
    operator = on_grid(Homogeneous(1.0, periodic), surface.shape, surface.spacing)
    scale = surface.rms_height
    for i, found in enumerate(curve.fields):
        u = displacement_field(operator, found.pressure)
        gap = u - (curve.depth[i] - (surface.heights.max() - surface.heights))
        assert np.abs(u - found.displacement).max() < 1e-9 * np.abs(u).max()
        assert np.abs(gap - found.gap).max() < 1e-9 * (np.abs(u).max() + scale)
        assert np.abs(gap[found.contact]).max() <= 1.01 * RTOL * scale
        assert gap.min() >= -1.01 * RTOL * scale
        assert found.pressure.min() >= -RTOL * found.pressure[found.contact].mean()
        assert (found.contact == (found.pressure > 0)).all()
        area = surface.area / surface.heights.size
        assert curve.force[i] == pytest.approx(area * found.pressure.sum(), rel=1e-12)
        assert curve.area_fraction[i] == found.contact.mean()
    if by_force:
        assert curve.force == pytest.approx(loads["forces"], rel=RTOL)
    else:
        assert curve.depth == pytest.approx(loads["depths"], rel=1e-14)


@laws(surfaces(), st.integers(0, 10**6))
def test_any_trial_pressure_bounds_the_stiffness_from_below(surface, seed):
    """On the contact set (1 q)² / (q K q) <= k, for every q."""
    curve = rl.press(surface, E_star=1.0, n_loads=3, fields=True)
    operator = on_grid(Homogeneous(1.0), surface.shape, surface.spacing)
    rng = np.random.default_rng(seed)
    area = surface.area / surface.heights.size
    for i, found in enumerate(curve.fields):
        for noise in (0.0, 0.2):
            trial = found.pressure * (1 + noise * rng.normal(size=surface.shape))
            bound = area * trial.sum() ** 2 / (trial * displacement_field(operator, trial)).sum()
            assert bound <= curve.stiffness[i] * (1 + 1e-9)


def test_force_is_the_integral_of_the_stiffness():
    surface = rl.SelfAffine(hurst=0.8, rms_height=1.0).surface(48, 3)
    first = 0.02
    errors = []
    for count in (50, 200):
        curve = rl.press(surface, E_star=1.0, depths=np.linspace(first, 3.0, count))
        integral = curve.force[0] + np.trapezoid(curve.stiffness, curve.depth)
        errors.append(abs(integral / curve.force[-1] - 1))
    assert errors[1] < 2e-3  # k jumps wherever a node switches: first order at best
    assert errors[1] < errors[0]


def test_the_same_contact_whatever_the_tolerance():
    surface = rl.SelfAffine(hurst=0.5, rms_height=1.0).surface(48, 3)
    loose, tight = (rl.press(surface, E_star=1.0, n_loads=8, rtol=r) for r in (1e-4, 1e-10))
    assert (tight.residual <= 1e-10).all()
    assert loose.depth == pytest.approx(tight.depth, rel=1e-3)
    assert loose.stiffness == pytest.approx(tight.stiffness, rel=2e-2)
