"""Half-spaces that the package does not know are defined here and pressed into.

Both have a length of their own. Small contacts are held against dense solutions, large ones against
their own residuals, recomputed here by plain transforms.
"""

from dataclasses import dataclass, replace

import numpy as np
import pytest

import roughline as rl
from halfspace.dense_contact import BodyOn, DenseContact, assert_history_is_dense, eigenvalues
from halfspace.dense_hardness import History
from halfspace.test_adhesion_oracle import DenseSticking, assert_sticking_is_dense


@dataclass(frozen=True)
class Coating(rl.HalfSpace):
    """Waves are displaced by 2 / (E* q) (1 - share exp(-2 q thickness)), as if by a coating.

    The term of the coating is the displacement by a force at the depth of twice the thickness. The
    base is stiffer than the coating where the share is positive, and softer where it is negative.
    """

    E_star: float
    share: float
    thickness: float
    periodic: bool = False

    def spectrum(self, q):
        return 2 / (self.E_star * q) * (1 - self.share * np.exp(-2 * q * self.thickness))

    def kernel(self, first, spacing, rows):
        rl.Homogeneous(self.E_star).kernel(first, spacing, rows)
        x = spacing[0] * (first + np.arange(rows.shape[0]))[:, np.newaxis]
        y = spacing[1] * np.arange(rows.shape[1])
        rows -= self.share * self._deep(x, y, *spacing)

    def in_units(self, pressure, length):
        return replace(self, E_star=self.E_star / pressure, thickness=self.thickness / length)

    def _deep(self, x, y, dx, dy):
        """Integral of 1 / (pi E* distance) over a cell, seen from below its plane."""
        z = 2 * self.thickness

        def corner(x, y):
            r = np.sqrt(x**2 + y**2 + z**2)
            along_x = x * np.arcsinh(y / np.hypot(x, z)) + y * np.arcsinh(x / np.hypot(y, z))
            return along_x - z * np.arctan(x * y / (z * r))

        right, left, high, low = x + dx / 2, x - dx / 2, y + dy / 2, y - dy / 2
        total = corner(right, high) - corner(left, high) - corner(right, low) + corner(left, low)
        return total / (np.pi * self.E_star)


@dataclass(frozen=True)
class OnRigidBase(rl.HalfSpace):
    """Waves are displaced by 2 / (E* q) tanh(q thickness): an even pressure, too, by a length."""

    E_star: float
    thickness: float
    periodic = True

    def spectrum(self, q):
        q = np.maximum(q, 1e-9 / self.thickness)
        return 2 / (self.E_star * q) * np.tanh(q * self.thickness)

    def in_units(self, pressure, length):
        return OnRigidBase(self.E_star / pressure, self.thickness / length)


def surface(shape, seed, sizes=(1.0, 0.7)):
    heights = rl.SelfAffine(hurst=0.7, rms_height=0.02).surface(256, seed).heights
    part = heights[: shape[0], : shape[1]]
    return rl.Surface(part - part.mean(), sizes)


RTOL = 1e-9  # so that pressures hold to 1e-6

COATED = [Coating(2.0, share, thickness) for share in (0.7, -1.5) for thickness in (0.02, 0.2)]
PERIODIC = [*(replace(each, periodic=True) for each in COATED), OnRigidBase(2.0, 0.1)]
ALL = [*COATED, *PERIODIC]


@pytest.mark.parametrize("half_space", ALL, ids=str)
@pytest.mark.parametrize("control", ["forces", "depths"])
def test_contacts_are_those_of_the_dense_solution(half_space, control):
    body = surface((24, 17), seed=3)
    dense = DenseContact(BodyOn.of(body, half_space))
    separation = dense.body.separation
    height = float(separation.mean())
    values = height * np.array([0.1, 0.4, 0.9] if control == "depths" else [0.01, 0.1, 0.5])
    curve = rl.press(body, half_space=half_space, fields=True, rtol=RTOL, **{control: values})
    for i, value in enumerate(values):
        solve = dense.at_depth if control == "depths" else dense.under_force
        depth, pressure = solve(separation, value, 0.0, np.inf)
        found, contact = curve.fields[i], pressure > 0
        assert np.abs(found.pressure.ravel() - pressure).max() <= 1e-6 * pressure.max()
        np.testing.assert_array_equal(found.contact.ravel(), contact)
        assert curve.depth[i] == pytest.approx(depth, rel=1e-6)
        assert curve.stiffness[i] == pytest.approx(dense.stiffness(contact), rel=1e-6)
        moved = dense.K @ pressure
        assert np.abs(found.displacement.ravel() - moved).max() <= 1e-6 * np.abs(moved).max()


@pytest.mark.parametrize("half_space", ALL, ids=str)
def test_histories_with_a_hardness_are_those_of_the_dense_solution(half_space):
    body, hardness = surface((20, 24), seed=5), 0.15
    history = History(BodyOn.of(body, half_space), hardness)
    forces = [0.002, 0.03, 0.01, 0.045, 0.0, 0.02]
    given = {"forces": forces, "hardness": hardness, "rtol": RTOL}
    curve = rl.press(body, half_space=half_space, fields=True, **given)
    assert_history_is_dense(curve, history, forces)


@pytest.mark.parametrize("half_space", ALL[::2], ids=str)
def test_histories_of_bodies_that_stick_are_those_of_the_dense_solution(half_space):
    body = surface((12, 11), seed=7)
    height = float(np.ptp(body.heights))
    law = rl.Exponential(0.02 * half_space.E_star * height, 0.2 * height)
    dense = DenseSticking(BodyOn.of(body, half_space), law)
    # in small steps, as repeated bodies on a soft base have several contacts at one depth
    depths = height * np.array([*np.arange(-0.2, 0.4, 0.1), *np.arange(0.4, -0.5, -0.1)])
    curve = rl.press(body, half_space=half_space, law=law, depths=depths, fields=True, rtol=RTOL)
    assert_sticking_is_dense(curve, dense, depths)


def displaced(half_space, pressure, spacing):
    """Displacements by a plain transform."""
    shape = pressure.shape
    if half_space.periodic:
        response = eigenvalues(half_space, shape, spacing)
        return np.fft.ifft2(response * np.fft.fft2(pressure)).real
    rows = np.empty(shape)
    half_space.kernel(0, spacing, rows)
    turned = np.zeros([2 * n for n in shape])
    for i, j in np.ndindex(2, 2):  # the kernel is even
        part = rows[1:][::-1] if i else rows
        part = part[:, 1:][:, ::-1] if j else part
        along = [slice(n + 1, None) if k else slice(n) for n, k in zip(shape, (i, j), strict=True)]
        turned[tuple(along)] = part
    padded = np.fft.fft2(turned) * np.fft.fft2(pressure, turned.shape)
    return np.fft.ifft2(padded).real[: shape[0], : shape[1]]


LARGE = [
    each
    for thickness in (0.003, 0.03, 0.3)
    for share in (0.7, -1.5)
    for each in (Coating(2.0, share, thickness), Coating(2.0, share, thickness, periodic=True))
]


@pytest.mark.parametrize("half_space", [*LARGE, OnRigidBase(2.0, 0.1)], ids=str)
def test_large_contacts_are_found_in_few_turns(half_space):
    body = surface((192, 160), seed=7)
    forces = [1e-4, 2e-3, 0.01]
    curve = rl.press(body, half_space=half_space, forces=forces, fields=True)
    usual = rl.press(body, E_star=2.0, periodic=half_space.periodic, forces=forces)
    assert curve.convolutions.sum() <= 2 * usual.convolutions.sum()
    separation = body.heights.max() - body.heights
    for depth, found in zip(curve.depth, curve.fields, strict=True):
        gap = displaced(half_space, found.pressure, body.spacing) + separation - depth
        length = min(body.rms_height, float(found.displacement[found.contact].max()))
        assert found.pressure.min() >= 0
        assert np.abs(gap[found.contact]).max() <= 1.01e-6 * length
        assert gap.min() >= -1.01e-6 * length


def test_where_an_even_pressure_displaces_full_contact_yields_further():
    half_space, body = OnRigidBase(2.0, 0.1), surface((16, 22), seed=2)
    dense = DenseContact(BodyOn.of(body, half_space))
    separation = dense.body.separation
    depth = 5 * float(separation.max())
    _, pressure = dense.at_depth(separation, depth, 0.0, np.inf)
    curve = rl.press(body, half_space=half_space, depths=[depth], rtol=RTOL)
    assert curve.area_fraction[0] == 1.0
    assert curve.force[0] == pytest.approx(dense.body.cell * pressure.sum(), rel=1e-6)
    even = half_space.E_star / (2 * half_space.thickness)  # pressure over displacement
    assert curve.stiffness[0] == pytest.approx(even * body.area, rel=1e-6)


@pytest.mark.parametrize("half_space", [COATED[1], PERIODIC[1], PERIODIC[-1]], ids=str)
def test_units_do_not_matter(half_space):
    body, forces = surface((70, 80), seed=4), np.array([1e-3, 1e-2])
    curve = rl.press(body, half_space=half_space, forces=forces)
    pressure, length = 1e-9, 1e6  # the new units
    scaled = rl.Surface(body.heights / length, [side / length for side in body.sizes])
    there = rl.press(
        scaled,
        half_space=half_space.in_units(pressure, length),
        forces=forces / pressure / length**2,
    )
    assert there.depth * length == pytest.approx(curve.depth, rel=1e-9)
    assert there.stiffness * pressure * length == pytest.approx(curve.stiffness, rel=1e-9)
    assert there.stiffness_bar == pytest.approx(curve.stiffness_bar, rel=1e-9)


def test_a_half_space_that_is_none_is_refused_in_one_line():
    body = surface((16, 16), seed=1)
    free = replace(PERIODIC[0], periodic=False)

    class WithoutKernel(Coating):
        kernel = rl.HalfSpace.kernel

    class Negative(Coating):
        def spectrum(self, q):
            return -super().spectrum(q)

    class AsThickInAllUnits(Coating):
        def in_units(self, pressure, length):
            return replace(self, E_star=self.E_star / pressure)

    class Unknown(Coating):
        def kernel(self, first, spacing, rows):
            rows[:] = np.nan

    for kind, periodic, message in (
        (WithoutKernel, False, "WithoutKernel has no kernel, which a free half-space needs: make"),
        (Negative, True, "Negative.spectrum gives -.* at q = .*; a positive, finite displacement"),
        (AsThickInAllUnits, True, r"AsThickInAllUnits.in_units\(2, .*\) displaces a wave by"),
        (Unknown, False, "Unknown.kernel gives numbers that are not finite; a finite"),
    ):
        half_space = kind(free.E_star, free.share, free.thickness, periodic)
        with pytest.raises(rl.InputError, match=message):
            rl.press(body, half_space=half_space, forces=[0.01])
