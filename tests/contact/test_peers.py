"""The same surface in other programs; skipped where they are not installed."""

import numpy as np
import pytest

import roughline as rl

# what other packages warn of while they load is theirs
pytestmark = pytest.mark.filterwarnings("ignore")

N = 64
FORCES = [1e-4, 1e-3]


@pytest.fixture(scope="module")
def surface():
    spectrum = rl.SelfAffine(hurst=0.8, rms_height=1e-3, q_roll=2 * np.pi * 4)
    return spectrum.surface(N, 3)


def test_tamaas_finds_the_same_periodic_contact(surface):
    tm = pytest.importorskip("tamaas")
    curve = rl.press(surface, E_star=1.0, forces=FORCES, periodic=True, fields=True)
    for force, fields, area in zip(FORCES, curve.fields, curve.area_fraction, strict=True):
        model = tm.Model(tm.model_type.basic_2d, [1.0, 1.0], [N, N])
        model.E, model.nu = 1.0, 0.0
        solver = tm.PolonskyKeerRey(model, np.array(surface.heights), 1e-12)
        solver.setMaxIterations(20000)
        solver.solve(force)
        pressure = np.array(model.traction)
        assert np.count_nonzero(pressure) / N**2 == area
        assert np.abs(fields.pressure - pressure).max() <= 1e-6 * pressure.max()


@pytest.mark.parametrize("periodic", [False, True])
def test_contact_mechanics_finds_the_same_contact(surface, periodic):
    cm = pytest.importorskip("ContactMechanics")
    from ContactMechanics.Factory import make_system
    from SurfaceTopography import Topography

    half_space = (cm.FreeFFTElasticHalfSpace, cm.PeriodicFFTElasticHalfSpace)[periodic]
    system = make_system(
        substrate=half_space((N, N), 1.0, (1.0, 1.0)),
        surface=Topography(np.array(surface.heights), (1.0, 1.0), periodic=True),
    )
    curve = rl.press(surface, E_star=1.0, forces=FORCES, periodic=periodic, fields=True)
    for i, force in enumerate(FORCES):
        result = system.minimize_proxy(external_force=force, pentol=1e-10, maxiter=10000)
        assert result.success
        pressure = np.asarray(result.jac)[:N, :N] * N**2
        fields = curve.fields[i]
        assert np.count_nonzero(pressure > 0) / N**2 == curve.area_fraction[i]
        assert np.abs(fields.pressure - pressure).max() <= 1e-5 * pressure.max()
        depth = surface.heights.max() + result.offset
        if periodic:  # there, even pressure displaces as much as the longest wave does
            depth -= force / np.pi
        assert curve.depth[i] == pytest.approx(depth, rel=1e-5)
