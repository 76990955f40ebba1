"""What a run will cost, what is refused before it starts, and what a result warns of."""

import json
import math
import multiprocessing
import os
import subprocess
import sys
import threading
import tracemalloc
from dataclasses import replace
from functools import partial

import numpy as np
import pytest

import roughline as rl
from reference import patience
from roughline.computing import fft, memory
from roughline.computing.cores import available_cores
from roughline.contact.curve import Curve
from roughline.contact.estimates import (
    bytes_of_layers,
    bytes_of_pull,
    bytes_of_shear,
    expected_area_fraction,
    memory_for,
)
from roughline.contact.loads import Loads

FRACTAL = rl.SelfAffine(hurst=0.8, rms_height=1.0).surface(64, 1)


def cut_out(surface: rl.Surface) -> rl.Surface:
    nx, ny = surface.shape
    return surface.cropped(x=(0, nx // 2), y=(0, ny)).detrended()


def test_an_estimate_grows_with_points_loads_and_fields():
    nothing = rl.estimate((1, 1), 20).memory  # the interpreter and its libraries
    small, large = rl.estimate((2048, 2048), 20), rl.estimate((8192, 8192), 20)
    pressing = small.memory - nothing
    assert 12 * pressing < large.memory - nothing <= 16.01 * pressing
    assert large.seconds > 8 * small.seconds
    assert rl.estimate((2048, 2048), 20, fields=True).memory > 3 * small.memory
    assert rl.estimate((2048, 2048), 20, yielding=True).memory - nothing > 1.3 * pressing
    assert str(large).startswith("about 6.9 GB and ")


PRESS = """
import json, pathlib, sys
import roughline as rl
n, periodic, hardness, fields, forces = json.loads(sys.argv[1])
surface = rl.SelfAffine(hurst=0.8, rms_height=1.0).surface(n, 7)
options = {"periodic": periodic, "hardness": hardness, "fields": fields}
curve = rl.press(surface, E_star=1.0, forces=forces, **options)
status = dict(line.split(":", 1) for line in pathlib.Path("/proc/self/status").open())
peak = 1024 * int(status["VmHWM"].split()[0])
print(json.dumps([peak, curve.area_fraction.max()]))
"""


@pytest.mark.skipif(sys.platform != "linux", reason="the system tells the peak")
@pytest.mark.parametrize(
    ("n", "periodic", "hardness", "fields", "forces"),
    [(256, False, None, False, [0.3]), (512, True, 20.0, [2], [0.1, 1.0, 0.1])],
)
def test_an_estimate_covers_the_memory_of_the_whole_process(n, periodic, hardness, fields, forces):
    """Loops that were not compiled before take some 100 MB more, once on a machine."""
    kinds = {"periodic": periodic, "hardness": hardness}
    rl.press(FRACTAL, E_star=1.0, forces=forces, **kinds)
    case = json.dumps([n, periodic, hardness, fields, forces])
    call = [sys.executable, "-c", PRESS, case]
    ran = subprocess.run(call, check=True, stdout=subprocess.PIPE, text=True)
    peak, share = json.loads(ran.stdout)
    told = rl.estimate(
        (n, n),
        len(forces),
        periodic=periodic,
        fields=fields,
        yielding=hardness is not None,
        area_fraction=share,
    )
    assert peak < told.memory < 1.35 * peak


LAYERS = {
    "soft": rl.Layered(1.0, 0.49, 0.3, 1e3, 0.3),
    "thin": rl.Layered(1.0, 0.49, 0.02, math.inf),
    "hard": rl.Layered(1.0, 0.3, 0.02, 0.1, 0.3),
    "plate": rl.Layered(1.0, 0.3, 0.02, 1e-2, 0.3),
}


LARGE = dict.fromkeys(LAYERS, (512, (1e-3, 0.1, 1.0))) | {"plate": (192, (0.1,))}


@pytest.mark.parametrize(
    ("kind", "periodic", "n", "shares"),
    [
        ("thin", False, 256, (1e-3,)),
        *((kind, periodic, *large) for kind, large in LARGE.items() for periodic in (False, True)),
    ],
)
def test_what_layers_take_in_addition_is_known_before(kind, periodic, n, shares):
    """By all arrays that are held at once, under light loads and heavy ones."""
    half_space = replace(LAYERS[kind], periodic=periodic)
    surface = rl.SelfAffine(hurst=0.8, rms_height=0.01, q_roll=12.0).surface(n, 7)
    most = rl.press(surface, half_space=half_space, n_loads=2, throw=False).force[-1]
    beside = bytes_of_layers(half_space, surface.shape, surface.spacing)
    assert (beside > 0) == (not periodic or kind == "plate")
    for force in most * np.array(shares):
        curves, loads = [], {"half_space": half_space, "forces": [force]}
        tracemalloc.start()
        # a thread keeps memory of its own for the next press
        alone = threading.Thread(target=lambda: curves.append(rl.press(surface, **loads)))  # noqa: B023
        alone.start()
        alone.join()
        held = tracemalloc.get_traced_memory()[1]
        tracemalloc.stop()
        told = memory_for(
            surface.shape,
            periodic,
            0,
            several=False,
            area_fraction=curves[0].area_fraction[0],
            besides=beside,
        )
        assert 0.4 * told < held < 1.1 * told
        if not periodic and force == most * 1e-3:
            # two threads at most hold a block of half a field each, at the same time or not
            block = surface.heights.nbytes / 2
            assert held + block > told - 1.15 * beside * surface.heights.size


def held_by(press):
    """Bytes of all arrays that a press holds at once; it starts with no memory of earlier ones."""
    tracemalloc.start()
    alone = threading.Thread(target=press)
    alone.start()
    alone.join()
    held = tracemalloc.get_traced_memory()[1]
    tracemalloc.stop()
    return held


@pytest.mark.parametrize(
    ("law", "deepest", "most"), [(rl.Dugdale, 0.6, 80), (rl.Exponential, 0.4, 80)]
)
def test_a_pull_takes_what_nodes_within_reach_do(law, deepest, most):
    """Beside the plain press under the same depths, per point."""
    n = 256
    spectrum = rl.SelfAffine(hurst=0.8, rms_height=0.01, q_roll=25.0, q_high=2 * np.pi * n / 8)
    surface = spectrum.surface(n, 3)
    reach = 0.1 * surface.rms_height
    sticking = law(reach**2 * n / (8 * np.pi), reach)
    depths = np.array([0.9, 1.0, 0.8]) * deepest * float(surface.heights.max())
    held = {}
    for each in (rl.Unilateral(), sticking):
        press = partial(rl.press, surface, E_star=1.0, periodic=True, law=each, depths=depths)
        press()  # compiles
        held[each] = held_by(press) / n**2
    more = held[sticking] - held[rl.Unilateral()]
    loads, half_space = Loads("depths", depths), rl.Homogeneous(1.0, periodic=True)
    share = expected_area_fraction(surface, half_space, loads, sticking)
    assert 0 < more < most
    assert more < 1.1 * bytes_of_pull(sticking, share)
    plain = rl.estimate((n, n), 3, periodic=True)
    told = rl.estimate((n, n), 3, periodic=True, law=sticking)
    assert told.memory - plain.memory >= more * n**2


def test_an_estimate_counts_the_loads_whose_fields_are_kept():
    none, one, every = (
        rl.estimate((1024, 1024), 20, fields=fields).memory for fields in (False, [3], True)
    )
    assert one - none == pytest.approx((every - none) / 20)


def test_an_estimate_counts_what_friction_takes_and_adds_to_fields():
    shape, points = (1024, 1024), 1024**2
    # bytes of a point, the way that it has slipped, and of each load with fields; with the margin
    plain, rubbing, coupled = (
        rl.estimate(shape, 4, friction=each, area_fraction=0.0).memory
        for each in (False, True, "coupled")
    )
    assert rubbing - plain == pytest.approx(1.15 * (45 + 8) * points, rel=0.01)
    assert coupled - plain == pytest.approx(1.15 * (185 + 8) * points, rel=0.01)
    plain, rubbing = (
        rl.estimate(shape, 4, fields=[1, 3], friction=each, area_fraction=0.0).memory
        for each in (False, True)
    )
    assert rubbing - plain == pytest.approx(1.15 * (45 + 8 + 2 * 41) * points, rel=0.01)


@pytest.mark.parametrize(("beta", "most"), [(0.0, 1.5), (2 / 7, 1.5)])
@pytest.mark.parametrize("force", [3e-3, 0.1])
def test_what_friction_takes_is_known_before(beta, most, force):
    """By all arrays that are held at once, under light loads and heavy ones."""
    n, found = 256, []
    surface = rl.SelfAffine(hurst=0.8, rms_height=0.01, q_roll=25.0).surface(n, 7)
    body = rl.Homogeneous(1.0, poisson=0.3, beta=beta)
    loads = {"forces": [force, force], "shear_forces": [0.0, 0.2 * force]}

    def press():
        found.append(rl.press(surface, half_space=body, friction=rl.Friction(0.3), **loads))

    press()  # compiles
    held, share = held_by(press), found[0].area_fraction.max()
    besides = bytes_of_shear(0, share, coupled=beta != 0)
    told = memory_for(surface.shape, False, 0, area_fraction=share, besides=besides)
    assert held < told < most * held


@pytest.mark.parametrize(
    ("name", "wrong"),
    [
        *(("shape", each) for each in (64, (0, 5), (-1, 5), (64,), (8, 8, 8), "ab", (2.5, 3))),
        *(("n_loads", each) for each in (0, 2.5, "3", True, None)),
        *(("fields", each) for each in (3, [2], "0", None)),
        *(("area_fraction", each) for each in (7, -0.1, math.nan, "0.2", True, np.ones(2))),
        *(("periodic", each) for each in ("no", 1, None)),
        *(("yielding", each) for each in ("no", 1, None)),
        *(("friction", each) for each in ("much", 0.3, None)),
    ],
)
def test_what_is_estimated_is_checked(name, wrong):
    asked = {"shape": (64, 64), "n_loads": 2} | {name: wrong}
    with pytest.raises(rl.InputError, match=f"{name} is ") as refusal:
        rl.estimate(asked.pop("shape"), asked.pop("n_loads"), **asked)
    assert "\n" not in str(refusal.value)


@pytest.mark.parametrize("periodic", [False, True])
def test_an_estimate_grows_with_the_contact(periodic):
    told = [
        rl.estimate((2048, 2048), 1, periodic=periodic, area_fraction=share).memory
        for share in (0.0, 0.01, 0.2, 0.5, 0.9, 1.0)
    ]
    assert (np.diff(told) > 0).all()
    nothing = rl.estimate((1, 1), 1).memory
    assert told[-1] - nothing > 2.5 * (told[0] - nothing)


@pytest.mark.parametrize("periodic", [False, True])
@pytest.mark.parametrize("force_bar", [0.03, 1.0, 10.0, 100.0])
def test_the_contact_that_loads_bring_about_is_foreseen(periodic, force_bar):
    surface = rl.SelfAffine(hurst=0.8, rms_height=1.0).surface(256, 1)
    curve = rl.press(surface, E_star=1.0, forces=[force_bar], periodic=periodic)
    loads = Loads("forces", np.array([force_bar]))
    share = partial(expected_area_fraction, surface, rl.Homogeneous(1.0, periodic))
    expected = share(loads, rl.Unilateral())
    assert abs(expected - curve.area_fraction[0]) < 0.12
    by_depth = Loads("depths", curve.depth)
    assert share(by_depth, rl.Unilateral()) > 0.8 * curve.area_fraction[0]
    assert share(loads, rl.Yielding(force_bar)) == 1.0


def test_light_loads_are_pressed_where_heavy_ones_have_no_memory(monkeypatch):
    surface, loads = FRACTAL, {"light": [0.01], "heavy": [300.0]}
    points = surface.heights.size
    available = 345 * points
    monkeypatch.setattr(
        memory.psutil, "virtual_memory", lambda: type("M", (), {"available": available})
    )
    assert rl.press(surface, E_star=1.0, forces=loads["light"]).converged.all()
    with pytest.raises(rl.InputError, match="pressing 64 x 64 points needs about"):
        rl.press(surface, E_star=1.0, forces=loads["heavy"])


def test_a_grid_too_large_for_memory_is_refused_before_the_work(monkeypatch):
    monkeypatch.setattr(memory.psutil, "virtual_memory", lambda: type("M", (), {"available": 5e5}))
    surface = rl.Surface(np.random.default_rng(0).normal(size=(128, 128)), (1.0, 1.0))
    message = (
        "pressing 128 x 128 points needs about 0.00415 GB of memory, and 0.0005 GB is free: "
        "take a smaller piece"
    )
    with pytest.raises(rl.InputError, match=message):
        rl.press(surface, E_star=1.0, forces=[1.0])
    with pytest.raises(rl.InputError, match="keeping the fields of 2 loads .* or keep fewer"):
        rl.press(FRACTAL, E_star=1.0, forces=[1.0, 2.0], fields=True)
    with pytest.raises(rl.InputError, match="a surface of 30000 x 30000 points needs about"):
        rl.SelfAffine(hurst=0.8, rms_height=1.0).surface(30000, 1)


@pytest.mark.parametrize("count", [0, -1, 10**6])
def test_impossible_thread_counts_are_refused(count):
    with pytest.raises(rl.InputError, match=f"threads is {count}; this machine allows 1 to"):
        rl.set_threads(count)


def test_the_number_of_threads_does_not_change_a_bit():
    before = fft.threads()
    curves = []
    try:
        for count in sorted({1, available_cores()}):
            rl.set_threads(count)
            curves.append(rl.press(FRACTAL, E_star=1.0, n_loads=5))
    finally:
        rl.set_threads(before)
    for curve in curves:
        assert (curve.stiffness == curves[0].stiffness).all()
        assert (curve.depth == curves[0].depth).all()


def stiffness_of(seed: int) -> float:
    surface = rl.SelfAffine(hurst=0.8, rms_height=1.0).surface(64, seed)
    return float(rl.press(surface, E_star=1.0, forces=[0.1]).stiffness[0])


@pytest.mark.skipif(not hasattr(os, "fork"), reason="processes are not forked here")
@pytest.mark.filterwarnings("ignore:.*fork.*:DeprecationWarning")
def test_forked_processes_have_threads_of_their_own():
    here = [stiffness_of(seed) for seed in range(2)]  # starts this process's threads
    with multiprocessing.get_context("fork").Pool(2) as pool:
        assert pool.map_async(stiffness_of, range(2)).get(timeout=patience()) == here


def test_precisions_agree_to_their_tolerance():
    surface, forces = rl.SelfAffine(hurst=0.5, rms_height=1.0).surface(96, 4), [0.01, 0.3, 3.0]
    double = rl.press(surface, E_star=1.0, forces=forces, solver=rl.Solver(precision="float64"))
    mixed = rl.press(surface, E_star=1.0, forces=forces)
    single = rl.press(
        surface, E_star=1.0, forces=forces, solver=rl.Solver(precision="float32"), rtol=1e-4
    )
    assert mixed.depth == pytest.approx(double.depth, rel=1e-6)
    assert mixed.stiffness == pytest.approx(double.stiffness, rel=1e-5)
    assert single.depth == pytest.approx(double.depth, rel=1e-4)
    assert single.stiffness == pytest.approx(double.stiffness, rel=1e-2)
    assert {curve.settings["precision"] for curve in (double, mixed, single)} == {
        "float64",
        "mixed",
        "float32",
    }


@pytest.mark.parametrize("rtol", [1e-6, 1e-9, 1e-11])
def test_mixed_precision_reaches_what_double_does(rtol):
    curve = rl.press(FRACTAL, E_star=1.0, forces=[0.01, 0.3, 3.0], rtol=rtol)
    assert (curve.residual <= rtol).all()


def test_single_precision_refuses_tolerances_beyond_it():
    with pytest.raises(
        rl.InputError, match='single precision resolves gaps to 3e-06 at best: .*"float32"'
    ):
        rl.press(FRACTAL, E_star=1.0, forces=[1.0], solver=rl.Solver(precision="float32"))
    with pytest.raises(
        rl.InputError, match="single precision cannot resolve gaps to rtol = 0.0001"
    ):
        rl.press(
            FRACTAL, E_star=1.0, depths=[1e3], solver=rl.Solver(precision="float32"), rtol=1e-4
        )
    with pytest.raises(rl.InputError, match='precision is "half"; allowed are'):
        rl.Solver(precision="half")


def edge_warnings(surface: rl.Surface, **options) -> tuple[str, ...]:
    return tuple(rl.press(surface, E_star=1.0, n_loads=6, **options).warnings)


def test_contact_at_the_border_of_a_piece_is_warned_of():
    piece = cut_out(FRACTAL)
    (warning,) = edge_warnings(piece)
    assert "of the force is carried within 5% of the border" in warning
    assert "Take a larger piece" in warning
    (repeated,) = edge_warnings(piece, periodic=True)
    assert "repeated periodically, the map jumps by" in repeated
    curve = rl.press(piece, E_star=1.0, n_loads=6)
    assert curve.to_dataset().attrs["warnings"] == warning


def test_a_fractal_punch_is_meant_to_end_at_its_border():
    assert edge_warnings(FRACTAL) == ()


def test_contact_in_the_middle_of_a_measured_surface_is_not_warned_of(tmp_path):
    x = np.linspace(-1, 1, 64)
    cap = rl.Surface(-(x[:, np.newaxis] ** 2 + x**2), (1.0, 1.0), is_cut_out=True)
    assert rl.press(cap, E_star=1.0, depths=[0.01, 0.1]).warnings == ()
    assert len(rl.press(cap, E_star=1.0, depths=[2.5]).warnings) == 1


def test_a_piece_and_a_coarser_grid_keep_their_sizes():
    piece = FRACTAL.cropped(x=(8, 40), y=(0, 16))
    assert piece.shape == (32, 16)
    assert piece.sizes == pytest.approx((0.5, 0.25))
    assert (piece.heights == FRACTAL.heights[8:40, :16]).all()
    coarse = piece.coarsened()
    assert coarse.shape == (16, 8)
    assert coarse.sizes == piece.sizes
    assert coarse.heights[0, 0] == pytest.approx(piece.heights[:2, :2].mean())
    with pytest.raises(
        rl.InputError, match=r"x is \(0, 65\); give \(first, end\) with 0 <= first < end <= 64"
    ):
        FRACTAL.cropped(x=(0, 65), y=(0, 64))
    with pytest.raises(rl.InputError, match="the surface has 3 x 64 points; give even numbers"):
        FRACTAL.cropped(x=(0, 3), y=(0, 64)).coarsened()


def test_fields_of_some_loads_only():
    curve = rl.press(FRACTAL, E_star=1.0, forces=[0.1, 1.0, 2.0], fields=[1])
    assert [fields is not None for fields in curve.fields] == [False, True, False]
    with pytest.raises(rl.InputError, match=r"fields is \[3\]; give True, False, or numbers"):
        rl.press(FRACTAL, E_star=1.0, forces=[0.1, 1.0, 2.0], fields=[3])


def test_the_outline_of_cells_is_counted_and_taken_from_summits_alone():
    heights = np.zeros((16, 16))
    heights[4:8, 4:12] = 1.0  # 32 cells, 24 sides
    share = (np.pi - 1 + np.log(2)) / 24
    curve: Curve = rl.press(rl.Surface(heights, (1.0, 1.0)), E_star=1.0, depths=[1e-3])
    assert curve.area_fraction[0] == 32 / 256
    room = curve.area_fraction_most - curve.area_fraction_corrected
    assert room == pytest.approx([24 * share / 256])
    assert curve.area_fraction_corrected[0] == pytest.approx(32 / 256, rel=1e-3)  # a punch
