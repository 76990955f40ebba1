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


@pytest.mark.parametrize("thickness", [0.02, 0.2])
@pytest.mark.parametrize("poisson", [0.3, 0.49])
@pytest.mark.parametrize("share", [1e-2, 1e-1])
def test_contact_mechanics_finds_the_same_contact_on_a_layer(surface, thickness, poisson, share):
    """Of Young's modulus one, on a rigid base; even pressure displaces there as it does here."""
    cm = pytest.importorskip("ContactMechanics", minversion="1.8")
    from ContactMechanics.Factory import make_system
    from SurfaceTopography import Topography

    shape, sizes = (N, N), (1.0, 1.0)
    layer = {"thickness": thickness, "poisson": poisson}
    half_space = rl.Layered(1.0, base_young=np.inf, periodic=True, **layer)
    theirs = cm.PeriodicFFTElasticHalfSpace(shape, 1.0, sizes, **layer)
    system = make_system(
        substrate=theirs,
        surface=Topography(np.array(surface.heights), sizes, periodic=True),
    )
    full = rl.press(surface, half_space=half_space, n_loads=2, throw=False).force[-1]
    force = share * full
    curve = rl.press(surface, half_space=half_space, forces=[force], fields=True)
    result = system.minimize_proxy(external_force=force, pentol=1e-10, maxiter=20000)
    assert result.success
    pressure, fields = np.asarray(result.jac)[:N, :N] * N**2, curve.fields[0]
    assert np.count_nonzero(pressure > 0) / N**2 == curve.area_fraction[0]
    assert np.abs(fields.pressure - pressure).max() <= 1e-5 * pressure.max()
    assert curve.depth[0] == pytest.approx(surface.heights.max() + result.offset, rel=1e-5)


@pytest.mark.parametrize(
    "engine",
    [
        {"active_set": True},
        {"active_set": True, "precond_engine": "fft"},
        {"backend": "fft", "precond_engine": "fft"},
        {"backend": "fft", "precond_engine": "fft", "precision": "float_then_double"},
    ],
)
def test_aspher_finds_the_same_contact(surface, engine):
    aspher = pytest.importorskip("aspher")
    curve = rl.press(surface, E_star=1.0, forces=FORCES, fields=True)
    gap = (surface.heights.max() - surface.heights).ravel()
    for i, force in enumerate(FORCES):
        result = aspher.solve_nested(
            grid_size=N, gap=gap, p_nominal=force, tol=1e-9, coarsest=16, **engine
        )
        assert result.converged
        assert result.contact_area == curve.area_fraction[i]
        assert result.mean_pressure == pytest.approx(force, rel=1e-12)
        pressure = np.reshape(result.pressure, (N, N))
        fields = curve.fields[i]
        # interpolated interactions of distant points are off by some millionths
        assert np.abs(fields.pressure - pressure).max() <= 5e-5 * pressure.max()
        assert curve.depth[i] == pytest.approx(result.approach, rel=1e-5)


# hardness and mean pressure over the rms slope: a third of the contact is elastic, and a twelfth
YIELDING = [(0.3, 0.05), (0.1, 0.03)]


@pytest.mark.parametrize("state", YIELDING)
def test_tamaas_finds_the_same_contact_of_a_body_that_yields(surface, state):
    tm = pytest.importorskip("tamaas")
    hardness, force = (each * surface.rms_slope for each in state)
    model = tm.Model(tm.model_type.basic_2d, [1.0, 1.0], [N, N])
    model.E, model.nu = 1.0, 0.0
    solver = tm.KatoSaturated(model, np.array(surface.heights), 1e-12, hardness)
    solver.setMaxIterations(20000)
    solver.solve(force)
    pressure = np.array(model.traction)
    curve = assert_same_pressures(surface, hardness, force, pressure, 1e-5, periodic=True)
    model.solveNeumann()  # its own displacement of these pressures
    displacement = np.array(model.displacement) - np.mean(model.displacement)
    elastic = (pressure > 0) & (pressure < 0.999 * hardness)
    depth = surface.heights.max() + np.mean((displacement - surface.heights)[elastic])
    assert curve.depth[0] == pytest.approx(depth, rel=1e-6)


@pytest.mark.parametrize("periodic", [False, True])
@pytest.mark.parametrize("state", YIELDING)
def test_contact_mechanics_finds_the_same_contact_of_a_body_that_yields(surface, state, periodic):
    cm = pytest.importorskip("ContactMechanics")
    from ContactMechanics.Factory import make_plastic_system
    from SurfaceTopography import PlasticTopography, Topography

    hardness, force = (each * surface.rms_slope for each in state)
    topography = Topography(np.array(surface.heights), (1.0, 1.0), periodic=True)
    topography = PlasticTopography(topography, hardness)
    half_space = (cm.FreeFFTElasticHalfSpace, cm.PeriodicFFTElasticHalfSpace)[periodic]
    system = make_plastic_system(substrate=half_space((N, N), 1.0, (1.0, 1.0)), surface=topography)
    result = system.minimize_proxy(external_force=force, pentol=1e-10, maxiter=20000)
    assert result.success
    pressure = np.asarray(result.jac)[:N, :N] * N**2
    # there, forces are met to a millionth
    curve = assert_same_pressures(surface, hardness, force, pressure, 5e-5, periodic=periodic)
    depth = surface.heights.max() + result.offset
    if periodic:  # there, even pressure displaces as much as the longest wave does
        depth -= force / np.pi
    assert curve.depth[0] == pytest.approx(depth, rel=1e-5)
    dents = np.abs(topography.plastic_displ)
    assert np.abs(curve.fields[0].indentation - dents).max() < 1e-5 * dents.max()


def assert_same_pressures(surface, hardness, force, pressure, tolerance, *, periodic):
    """Compare area, plastic nodes and pressures; return our curve."""
    curve = rl.press(
        surface, E_star=1.0, hardness=hardness, forces=[force], periodic=periodic, fields=True
    )
    fields = curve.fields[0]
    assert ((pressure > 0) == fields.contact).all()
    assert ((pressure > (1 - 1e-9) * hardness) == fields.plastic).all()
    assert np.abs(fields.pressure - pressure).max() <= tolerance * hardness
    return curve


@pytest.mark.parametrize("work", [4e-6, 1e-6])
@pytest.mark.parametrize("law", [rl.Exponential, rl.Dugdale])
def test_tamaas_finds_the_same_contact_that_sticks(law, work):
    """By an exponential law to the tolerance; Dugdale's ends over a ramp here and not there."""
    tm = pytest.importorskip("tamaas")
    spectrum = rl.SelfAffine(hurst=0.8, rms_height=1e-3, q_roll=8 * np.pi, q_high=24 * np.pi)
    smooth, reach = spectrum.surface(N, 3), 5e-4
    functional = {
        rl.Exponential: tm.ExponentialAdhesionFunctional,
        rl.Dugdale: tm.MaugisAdhesionFunctional,
    }[law]
    for force in FORCES[1], 5 * FORCES[1]:
        if law is rl.Dugdale and work > 2e-6:
            continue  # its zone is not resolved here
        curve = rl.press(
            smooth, E_star=1.0, periodic=True, law=law(work, reach), forces=[force], fields=True
        )
        model = tm.Model(tm.model_type.basic_2d, [1.0, 1.0], [N, N])
        model.E, model.nu = 1.0, 0.0
        sides = tm.PolonskyKeerRey.gap, tm.PolonskyKeerRey.pressure
        solver = tm.PolonskyKeerRey(model, np.array(smooth.heights), 1e-12, *sides)
        pull = functional(np.array(smooth.heights))
        pull.setParameters({"rho": reach, "surface_energy": work})
        solver.addFunctionalTerm(pull)
        solver.setMaxIterations(20000)
        solver.solve(force)
        theirs, ours = np.array(model.traction), curve.fields[0].pressure
        assert np.array_equal(theirs > 0, ours > 0) or law is rl.Dugdale
        most = 1e-6 if law is rl.Exponential else 0.03
        assert np.abs(ours - theirs).max() <= most * theirs.max()


def test_adhesion_finds_the_same_contact_there_and_back():
    """Exponential law, deeper and back; their minimum of the energy at a depth, from the last."""
    pytest.importorskip("Adhesion")
    cm = pytest.importorskip("ContactMechanics")
    from Adhesion.Interactions import Exponential
    from Adhesion.System import BoundedSmoothContactSystem, make_system
    from SurfaceTopography import Topography

    spectrum = rl.SelfAffine(hurst=0.8, rms_height=1e-3, q_roll=8 * np.pi, q_high=24 * np.pi)
    smooth, work, reach = spectrum.surface(N, 3), 4e-6, 5e-4
    depths = np.array([0.3, 0.9, 1.5, 2.5, 1.5, 0.9, 0.3]) * smooth.rms_height
    law = rl.Exponential(work, reach)
    curve = rl.press(smooth, E_star=1.0, periodic=True, law=law, depths=depths, fields=True)
    system = make_system(
        interaction=Exponential(work, reach),
        surface=Topography(np.array(smooth.heights), (1.0, 1.0), periodic=True),
        substrate=cm.PeriodicFFTElasticHalfSpace((N, N), 1.0, (1.0, 1.0)),
        system_class=BoundedSmoothContactSystem,
    )
    strict = {"gtol": 1e-12, "ftol": 1e-18, "maxiter": 20000, "maxcor": 50}
    displacement = np.zeros((N, N))
    for depth, force, fields in zip(depths, curve.force, curve.fields, strict=True):
        # there, even pressure displaces as much as the longest wave does
        raised = np.array(smooth.heights) - smooth.heights.max() + depth + force / np.pi
        result = system.minimize_proxy(
            offset=raised.max() - smooth.heights.max(),
            initial_displacements=np.maximum(displacement, raised),
            lbounds="auto",
            options=strict,
        )
        assert result.success
        displacement = np.array(system.disp)
        pressure = -np.asarray(system.substrate.force) * N**2
        assert np.array_equal(pressure > 0, fields.pressure > 0)
        assert np.abs(fields.pressure - pressure).max() <= 1e-5 * pressure.max()
