"""Answers of whole problems whose solution is known: discs, spheres, flat squares."""

import math

import numpy as np
import pytest
from scipy import special

import roughline as rl
from roughline.engineering.formulas import (
    electrical_resistance,
    interface_stiffness,
    reflection,
    thermal_conductance,
)
from roughline.engineering.intervals import Intervals
from roughline.engineering.pair import MaterialPair
from roughline.engineering.pressed import Pressed
from roughline.engineering.rules import rules
from roughline.margins.larger_surface import flat_punch, stiffness_of_the_piece

PAIR = MaterialPair(rl.material("steel"), rl.material("copper"))


def answers(curve, area, pair, **others):
    """The answers by their symbols, for which nothing that was solved is left out as not finite."""
    found, left_out = rules.answers(Pressed(curve, area, pair, **others))
    assert not [each for each in left_out if "not finite" in str(each)]
    return {each.symbol: each for each in found.values()}


def sphere(n, size=1e-3, radius=5e-3):
    x = (np.arange(n) + 0.5) / n * size - size / 2
    return rl.Surface(-(x[:, np.newaxis] ** 2 + x**2) / (2 * radius), (size, size), unit="m")


def disc(n, size=1e-3, radius=3e-4):
    x = (np.arange(n) + 0.5) / n * size - size / 2
    inside = x[:, np.newaxis] ** 2 + x**2 <= radius**2
    return rl.Surface(np.where(inside, 0.0, -1e-4), (size, size), unit="m")


def test_a_sphere():
    surface, force, radius = sphere(256), 30.0, 5e-3
    E_star = PAIR.E_star
    curve = rl.press(surface, E_star=E_star, forces=[force])
    found = answers(curve, surface.area, PAIR)
    a = (3 * force * radius / (4 * E_star)) ** (1 / 3)
    resistivities = 1.6e-7 + 1.68e-8
    kappa = 2 * 50 * 401 / (50 + 401)
    expected = {
        "F": force,
        "d": a**2 / radius,
        "k": 2 * E_star * a,
        "A": math.pi * a**2,
        "p_c": force / (math.pi * a**2),
        "R": resistivities / (4 * a),
        "G": 2 * kappa * a,
        "k_t": 2 * PAIR.G_star * a,
        "p": force / 1e-6,
    }
    for symbol, value in expected.items():
        assert found[symbol].values[0] == pytest.approx(value, rel=3e-3), symbol


def saturated_stiffness(surface, E_star=PAIR.E_star):
    flat, depth = flat_punch(surface)
    return rl.press(flat, E_star=E_star, depths=[depth]).stiffness[0]


def test_a_disc():
    surface = disc(256)
    curve = rl.press(surface, E_star=PAIR.E_star, forces=[1.0])
    found = answers(curve, surface.area, PAIR)
    resistance = (1.6e-7 + 1.68e-8) / (4 * 3e-4)
    assert found["R"].values[0] == pytest.approx(resistance, rel=5e-3)  # the staircase of the grid
    kappa = 2 * 50 * 401 / (50 + 401)
    assert found["G"].values[0] == pytest.approx(2 * kappa * 3e-4, rel=5e-3)


def test_a_flat_square_has_no_interface_of_its_own():
    flat = rl.Surface(np.zeros((64, 64)), (1e-3, 1e-3), "m")
    saturated = saturated_stiffness(flat)
    assert saturated / (PAIR.E_star * 1e-3) == pytest.approx(1.14617, rel=1e-5)  # on 64 x 64
    long = rl.Surface(np.zeros((32, 64)), (1e-3, 2e-3), "m")
    assert saturated_stiffness(long) > 1.4 * saturated


def test_in_full_contact_the_interface_is_infinitely_stiff():
    flat = rl.Surface(np.zeros((32, 32)), (1e-3, 1e-3), "m")
    curve = rl.press(flat, E_star=PAIR.E_star, forces=[10.0])
    saturated = saturated_stiffness(flat)
    interval = (0.99 * curve.stiffness, 1.01 * curve.stiffness)
    given = answers(
        curve,
        flat.area,
        PAIR,
        interface=stiffness_of_the_piece(flat, curve, saturated, interval),
        frequency=5e6,
        intervals=Intervals(interval, interval),
    )
    found = given
    assert np.isinf(found["k_i"].values).all()
    assert np.isinf(found["h_c"].values).all()
    steel, copper = PAIR.first.impedance, PAIR.second.impedance
    bonded = abs(steel - copper) / (steel + copper)
    assert found["|r|"].values[0] == pytest.approx(bonded)
    assert found["R"].values[0] == pytest.approx(
        PAIR.E_star * (1.6e-7 + 1.68e-8) / (2 * saturated), rel=1e-6
    )


def test_in_periodic_mode_the_stiffness_is_the_interfaces():
    surface = rl.SelfAffine(hurst=0.7, length=1e-3, rms_height=1e-6, q_high=1e5).surface(64, 1)
    surface = rl.Surface(surface.heights, surface.sizes, "m")
    curve = rl.press(surface, E_star=PAIR.E_star, forces=[5.0], periodic=True)
    found = answers(curve, surface.area, PAIR)
    assert "k_i" not in found
    kappa = 2 * 50 * 401 / (50 + 401)
    per_area = kappa * curve.stiffness[0] / surface.area / PAIR.E_star
    assert found["h_c"].values[0] == pytest.approx(per_area, rel=1e-12)


def test_intervals_are_carried_on():
    surface = sphere(64)
    curve = rl.press(surface, E_star=PAIR.E_star, forces=[10.0, 30.0])
    saturated = saturated_stiffness(surface)
    low, high = 0.9 * curve.stiffness, 1.3 * curve.stiffness
    share = curve.area_fraction_corrected
    found = answers(
        curve,
        surface.area,
        PAIR,
        interface=stiffness_of_the_piece(surface, curve, saturated, (low, high)),
        frequency=5e6,
        intervals=Intervals((low, high), (low, high), (0.5 * share, 1.5 * share)),
    )

    def ends(symbol):
        each = found[symbol]
        return np.array([each.low / each.values, each.high / each.values])

    def given(low, high):
        return pytest.approx(np.array([[low, low], [high, high]]), rel=1e-9)

    for symbol in ("k", "k/A_0", "G", "k_t"):
        assert ends(symbol) == given(0.9, 1.3), symbol
    assert ends("R") == given(1 / 1.3, 1 / 0.9)
    for symbol in ("A", "A/A_0"):
        assert ends(symbol) == given(0.5, 1.5), symbol
    for symbol in ("p_c", "p_c/H"):
        assert ends(symbol) == given(1 / 1.5, 1 / 0.5), symbol
    own = found["k_i"]
    assert own.low == pytest.approx(interface_stiffness(low, saturated))
    assert own.high == pytest.approx(interface_stiffness(high, saturated))
    assert ends("h_c") == pytest.approx(ends("k_i"))
    reflection = found["|r|"]
    assert (reflection.low < reflection.values).all()
    assert (reflection.values < reflection.high).all()
    assert found["F"].low is None
    assert found["R_Holm"].high is None


SMALL = (144, 36, 0.7, 4, 91)  # points of a parent, of its pieces, H, roll-offs of these, seed
PARENTS = [
    (256, 64, 0.7, 4, 91),
    (256, 64, 0.3, 8, 92),
    (288, 72, 0.9, 6, 93),
]
WANTED = np.array([0.02, 0.1, 0.35, 0.6, 0.93])  # contact area fractions, about


def pieces_of(parents):
    """Of each piece: k_i of its parent, and its periodic curve."""
    found = []
    for n, m, hurst, waves, seed in parents:
        waves_and_cells = {"q_roll": math.tau * waves * n / m, "q_high": math.tau * n / 4}
        spectrum = rl.SelfAffine(hurst=hurst, rms_height=0.01, **waves_and_cells)
        parent = spectrum.surface(n, seed)
        pressures = parent.rms_slope * special.erfinv(WANTED) / math.sqrt(2)
        truth = rl.press(parent, E_star=1.0, forces=pressures * parent.area, periodic=True)
        for i in range(0, n, m):
            piece = parent.cropped((i, i + m), (i, i + m)).detrended()
            forces = pressures * piece.area
            curve = rl.press(piece, E_star=1.0, forces=forces, periodic=True)
            found.append((truth.stiffness * piece.area / parent.area, piece, curve))
    return found


@pytest.mark.parametrize("parents", [[SMALL], PARENTS], ids=["one", "three"])
def test_the_periodic_half_space_is_nearer_to_the_parent_than_the_punch(parents):
    """With roll-offs inside, from a third of contact on, 1 / k - 1 / k_s is off by a fifth."""
    free, periodic = [], []
    for truth, piece, curve in pieces_of(parents):
        punch = rl.press(piece, E_star=1.0, forces=curve.force)
        free.append(
            stiffness_of_the_piece(piece, punch, saturated_stiffness(piece, 1.0)).values / truth
        )
        periodic.append(curve.stiffness / truth)
    free, periodic = np.median(free, axis=0), np.median(periodic, axis=0)
    assert free[2] > 1.12
    assert free[4] < 0.85
    assert periodic[1:3] == pytest.approx(1, abs=0.06)  # the pieces' own scatter
    assert (np.abs(np.log(periodic[2:])) < np.abs(np.log(free[2:]))).all()


LIGHT, HEAVY = 1e-4, 0.03  # mean pressures over E* and the rms slope


@pytest.mark.parametrize("seed", [3, 5])
def test_which_surface_k_i_is_of_is_told_where_the_bodies_give_way_beside_the_interface(seed):
    """Up to 5 % of that, the piece is as stiff as it is repeated, and its validity is enough."""
    spectrum = rl.SelfAffine(hurst=0.8, rms_height=0.01, length=1.0, q_roll=6 * math.tau)
    surface = spectrum.surface(64, seed)
    for load, is_told in ((LIGHT, False), (HEAVY, True)):
        forces = np.array([load * surface.rms_slope])
        curve = rl.press(surface, E_star=1.0, forces=forces)
        repeated = rl.press(surface, E_star=1.0, forces=forces, periodic=True)
        interface = stiffness_of_the_piece(surface, curve, saturated_stiffness(surface, 1.0))
        k_i = answers(curve, surface.area, PAIR, interface=interface)["k_i"]
        assert (1 - curve.stiffness / k_i.values > 0.05) == is_told
        assert is_told or k_i.values == pytest.approx(repeated.stiffness, rel=0.02)
        assert bool(k_i.facts) == is_told
        assert k_i.validity.startswith("of this piece alone")


def test_near_full_contact_the_interval_has_no_upper_end():
    """Where k_s - k is smaller than what the grid knows of the punch."""
    spectrum = rl.SelfAffine(hurst=0.8, rms_height=1e-3, q_roll=12 * math.tau, q_high=16 * math.tau)
    surface = spectrum.surface(64, 5)
    forces = surface.rms_slope * np.array([0.1, 1.5])
    curve = rl.press(surface, E_star=1.0, forces=forces)
    assert 0.9 < curve.area_fraction[1] < 1
    saturated = saturated_stiffness(surface, 1.0)
    given = stiffness_of_the_piece(surface, curve, saturated)
    assert np.isfinite(given.values).all()
    assert np.isnan(given.ends[1][0])
    assert np.isinf(given.ends[1][1])
    assert given.ends[0][1] < given.values[1]
    assert "of this piece alone" in str(given.place)
    known = stiffness_of_the_piece(surface, curve, saturated, (curve.stiffness, curve.stiffness))
    assert known.ends[1][0] == pytest.approx(given.values[0])
    assert np.isinf(known.ends[1][1])


def yielding(surface, pair, forces, periodic=False):
    """Press up to the hardness of the softer body."""
    return rl.press(
        surface, E_star=pair.E_star, hardness=pair.hardness, forces=forces, periodic=periodic
    )


def test_what_currents_heat_waves_and_shear_meet_is_the_unloading_stiffness():
    """All of the contact springs back there, whatever made it; on loading points yield on."""
    surface = sphere(64)
    curve = yielding(surface, PAIR, [3.0, 30.0])
    k_u = curve.unloading_stiffness
    assert (curve.stiffness < 0.95 * k_u).all()
    found = answers(curve, surface.area, PAIR, frequency=5e6)
    assert found["k"].values == pytest.approx(curve.stiffness, rel=1e-12)
    assert found["k_u"].values == pytest.approx(k_u, rel=1e-12)
    resistivities = PAIR.both("resistivity")
    assert found["R"].values == pytest.approx(
        electrical_resistance(k_u, PAIR.E_star, resistivities), rel=1e-12
    )
    G = thermal_conductance(k_u, PAIR.E_star, PAIR.both("conductivity"))
    assert found["G"].values == pytest.approx(G, rel=1e-12)
    assert found["h_c"].values == pytest.approx(G / surface.area, rel=1e-12)
    assert found["k_t"].values == pytest.approx(PAIR.G_star / PAIR.E_star * k_u, rel=1e-12)
    waves = reflection(k_u / surface.area, 5e6, PAIR.both("impedance"))
    assert found["|r|"].values == pytest.approx(waves, rel=1e-12)
    saturated = saturated_stiffness(surface)
    assert stiffness_of_the_piece(surface, curve, saturated).values == pytest.approx(
        interface_stiffness(k_u, saturated), rel=1e-12
    )


def test_a_fully_plastic_sphere_bears_its_hardness():
    """F = H A where all yields; the disc as large, springing back, has k_u = 2 E* a."""
    surface, soft = sphere(128), rl.material("copper hardness=10 MPa")
    pair = MaterialPair(rl.material("steel"), soft)
    force = 1.0  # by F / H, a disc of 0.18 mm
    curve = yielding(surface, pair, [force])
    found = answers(curve, surface.area, pair)
    radius = math.sqrt(force / (math.pi * 10e6))
    assert found["p_c/H"].values == pytest.approx([1.0], abs=5e-3)
    assert found["A_p/A"].values > 0.9
    assert found["A"].values == pytest.approx([math.pi * radius**2], rel=5e-3)
    assert found["k_u"].values == pytest.approx([2 * PAIR.E_star * radius], rel=1e-2)
    assert found["R"].values == pytest.approx([(1.6e-7 + 1.68e-8) / (4 * radius)], rel=1e-2)
    assert found["R"].values == pytest.approx(found["R_Holm"].values, rel=1e-2)
    # a spherical cap pressed flat, with no pile-up: its height over the disc
    assert found["w"].values == pytest.approx([radius**2 / (2 * 5e-3)], rel=5e-2)


def test_bodies_just_apart_have_answers_that_can_be_written():
    """After unloading: no stiffness, no area, no pressure; nothing conducts, all is reflected."""
    surface = sphere(32)
    curve = yielding(surface, PAIR, [30.0, 0.0])
    found = answers(
        curve,
        surface.area,
        PAIR,
        interface=stiffness_of_the_piece(surface, curve, saturated_stiffness(surface)),
        rms_height=1e-6,
        rms_slope=0.1,
        frequency=5e6,
    )
    last = {symbol: float(each.values[1]) for symbol, each in found.items()}
    assert not np.isnan(list(last.values())).any()
    for symbol in ("F", "k", "k_u", "k_i", "A", "p_c", "p_c/H", "A_p/A", "G", "h_c", "k_t"):
        assert last[symbol] == 0, symbol
    assert math.isinf(last["R"])
    assert last["|r|"] == 1
    assert last["d"] > 0
    assert last["w"] == found["w"].values[0]  # for good


def test_what_is_not_known_of_a_material_is_left_out():
    surface = sphere(32)
    glass = MaterialPair(rl.material("glass"), rl.material("rigid"))
    curve = rl.press(surface, E_star=glass.E_star, forces=[1.0])
    found = answers(curve, surface.area, glass, frequency=1e6)
    assert not {"R", "R_Holm", "G", "h_c", "|r|"} & found.keys()
    assert found["p_c/H"].values[0] == pytest.approx(found["p_c"].values[0] / 5.5e9)
    assert all(each.formula for each in found.values())


def test_the_elastic_assumption_is_watched():
    surface = sphere(64)
    soft, hard = (
        MaterialPair(rl.material(f"steel hardness={hardness} GPa"), rl.material("rigid"))
        for hardness in (1, 1000)
    )
    curve = rl.press(surface, E_star=soft.E_star, forces=[100.0])
    told = str(*answers(curve, surface.area, soft)["p_c/H"].facts)
    assert "times the softer body's hardness" in told
    assert "leave out elastic=True" in told
    assert answers(curve, surface.area, hard)["p_c/H"].facts == ()
