"""A half-space from outside, made by the handbook alone: a plate on Winkler's springs.

No line of the package knows it. Contacts are held to linear complementarity solved densely.
"""

from dataclasses import dataclass

import numpy as np
import pytest
from scipy.optimize import nnls

import roughline as rl


@dataclass(frozen=True)
class PlateOnSprings(rl.HalfSpace):
    """A thin plate of the rigidity D on springs k: waves are displaced by 1 / (k + D q⁴) [1]_.

    References
    ----------
    .. [1] Timoshenko and Woinowsky-Krieger, Theory of Plates and Shells, 1959, ch. 8.
    """

    springs: float  # k [pressure / length]
    rigidity: float  # D [pressure * length³]
    periodic = True

    @property
    def E_star(self):
        """Unit of pressures: the springs under a wave as long as the plate spreads a load."""
        return self.springs * (self.rigidity / self.springs) ** 0.25

    def spectrum(self, q):
        return 1 / (self.springs + self.rigidity * q**4)

    def in_units(self, pressure, length):
        return PlateOnSprings(
            self.springs / pressure * length, self.rigidity / (pressure * length**3)
        )


def dense(shape, sizes, half_space):
    """Displacements by unit pressures, from the waves of the grid."""
    waves = [2 * np.pi * np.fft.fftfreq(n, size / n) for n, size in zip(shape, sizes, strict=True)]
    of_wave = half_space.spectrum(np.hypot(waves[0][:, np.newaxis], waves[1]))
    of_one = np.fft.ifft2(of_wave).real
    return np.array(
        [np.roll(of_one, (i, j), (0, 1)).ravel() for i in range(shape[0]) for j in range(shape[1])]
    )


@pytest.mark.parametrize("spread", [0.02, 0.06])
def test_contacts_are_those_of_the_dense_solution(spread):
    body = rl.SelfAffine(hurst=0.7, rms_height=0.02, q_roll=12).surface(16, rng=3)
    half_space = PlateOnSprings(2.0, 2.0 * spread**4)
    curve = rl.press(body, half_space=half_space, depths=[0.02, 0.05], fields=True, rtol=1e-8)
    assert curve.converged.all()
    K = dense(body.heights.shape, body.sizes, half_space)
    root = np.linalg.cholesky(K)
    for depth, fields in zip(curve.depth, curve.fields, strict=True):
        overlap = (depth - (body.heights.max() - body.heights)).ravel()
        pressure, _ = nnls(root.T, np.linalg.solve(root, overlap))
        np.testing.assert_allclose(fields.pressure.ravel(), pressure, atol=1e-6 * pressure.max())


def test_the_plate_gives_way_to_an_even_load_as_its_springs_do():
    body = rl.SelfAffine(hurst=0.7, rms_height=0.02, q_roll=12).surface(32, rng=3)
    half_space = PlateOnSprings(2.0, 1e-8)
    curve = rl.press(body, half_space=half_space, depths=[1.0])
    full = 2.0 * (1.0 - (body.heights.max() - body.heights.mean()))
    assert curve.force == pytest.approx([full * body.area], rel=1e-9)
    assert curve.stiffness == pytest.approx([2.0 * body.area], rel=1e-9)


def test_the_same_contact_in_other_units():
    body = rl.SelfAffine(hurst=0.7, rms_height=0.02, q_roll=12).surface(32, rng=3)
    curve = rl.press(body, half_space=PlateOnSprings(2.0, 1e-5), depths=[0.05])
    longer = rl.Surface(1e3 * body.heights, [1e3 * size for size in body.sizes])
    other = rl.press(longer, half_space=PlateOnSprings(2e-3, 1e4), depths=[50.0])
    assert other.force == pytest.approx(1e6 * curve.force, rel=1e-9)


@pytest.mark.parametrize("times", [1 - 1e-6, 1 + 1e-6])
def test_a_pull_may_be_as_short_as_one_cell_of_the_plate_allows(times):
    """At a range h_0 with 4 (w / h_0) c = h_0; unit pressure on a cell displaces it by c."""
    body = rl.SelfAffine(hurst=0.7, rms_height=0.02, q_roll=12).surface(16, rng=3)
    half_space, work = PlateOnSprings(2.0, 1e-6), 1e-4
    of_cell = dense(body.heights.shape, body.sizes, half_space)[0, 0]
    law = rl.Dugdale(work, times * np.sqrt(4 * work * of_cell))
    if times > 1:
        rl.press(body, half_space=half_space, law=law, depths=[-3 * law.range])
    else:
        with pytest.raises(rl.InputError, match="range is too short for the grid"):
            rl.press(body, half_space=half_space, law=law, depths=[0.0])
