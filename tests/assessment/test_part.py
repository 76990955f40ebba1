"""Several maps of one part: each pressed alone, and what they say together."""

import math
import re
from dataclasses import replace

import numpy as np
import pytest

import roughline as rl
from roughline.margins import variant as variants

# harder than any contact pressure here, so that nothing yields
FIRST = "E=210 GPa nu=0.3 hardness=1000 GPa resistivity=1e-7 ohm m conductivity=50 W/m/K"
SECOND = "E=120 GPa nu=0.3 hardness=1000 GPa resistivity=2e-8 ohm m conductivity=400 W/m/K"
ASKED = {"materials": f"{FIRST}, {SECOND}", "grid_error": False, "fields": False}
SURFACE = rl.SelfAffine(hurst=0.7, length=4e-4, rms_height=1e-6, q_roll=math.tau / 25e-6)


@pytest.fixture(scope="module", params=[16, 32])
def maps(request):
    """Four maps of 0.1 mm of one part."""
    n = request.param
    part = SURFACE.surface(4 * n, 3).scaled({16: 0.1, 32: 1.0}[n])  # so that several points touch
    return [part.cropped((i, i + n), (0, n)).detrended() for i in range(0, 4 * n, n)]


def pressed(bodies, **asked):
    return rl.assess(rl.Question(bodies, **{"loads": "5 MPa", **ASKED, **asked}))


@pytest.fixture(scope="module")
def part(maps):
    """What the four say together."""
    return pressed(maps)


def test_mean_scatter_and_interval_are_those_of_the_maps(maps, part):
    assert part.names == ["map 1", "map 2", "map 3", "map 4"]
    alone = [rl.assess(rl.Question(each, loads="5 MPa", **ASKED)) for each in maps]
    for key, answer in part.answers.items():
        values = np.array([each.answers[key].values[0] for each in alone])
        assert [each.values[0] for each in answer.of_maps] == values.tolist(), key
        expected = np.exp(np.log(values).mean()) if values.any() else 0.0
        assert answer.mean == pytest.approx([expected], rel=1e-12), key
    k = part.answers["contact_stiffness"]
    logs = np.log([each.values[0] for each in k.of_maps])
    assert k.scatter == pytest.approx([np.exp(logs.std(ddof=1))], rel=1e-12)
    student = 3.182446  # of three degrees of freedom, 97.5 %
    half = student * logs.std(ddof=1) / 2
    assert [k.low, k.high] == [
        pytest.approx(k.mean * np.exp(-half), rel=1e-6),
        pytest.approx(k.mean * np.exp(half), rel=1e-6),
    ]
    assert part.answers["mean_pressure"].scatter == 1.0
    assert np.isnan(part.answers["mean_pressure"].low)


def test_resistance_and_conductance_say_the_same(part):
    answers = part.answers
    resistance, conductance = (
        answers[key] for key in ("constriction_resistance", "thermal_conductance")
    )
    product = resistance.mean * conductance.mean
    assert resistance.low * conductance.high == pytest.approx(product, rel=1e-12)
    assert resistance.scatter == pytest.approx(conductance.scatter, rel=1e-12)


def test_the_interval_of_a_part_holds_what_its_maps_miss_alike(maps, part):
    """Here the error of the grid; the part's ends are no nearer than the nearest of any map's."""
    without, known = part.answers, pressed(maps, grid_error=True).answers
    for key in ("contact_stiffness", "constriction_resistance"):
        assert known[key].low < without[key].low < without[key].mean
        assert known[key].high > without[key].high > without[key].mean
    own = known["contact_stiffness"]
    for i, end in enumerate((own.low, own.high)):
        nearest = min(abs(np.log(each.rows[1 + i] / each.values)) for each in own.of_maps)
        assert abs(np.log(end / own.mean)) >= nearest


def test_a_refused_map_is_named_and_the_others_go_on(maps, tmp_path):
    files = [tmp_path / f"{i}.nc" for i in range(3)]
    for file, each in zip(files[:2], maps, strict=False):
        rl.write(replace(each, unit="m"), file)
    (tmp_path / "bad.txt").write_text("no heights")
    (tmp_path / "copy.nc").write_bytes(files[0].read_bytes())
    part = pressed([files[0], tmp_path / "bad.txt", files[1], tmp_path / "copy.nc", files[2]])
    assert part.names == ["0.nc", "1.nc"]
    assert list(part.refused) == ["bad.txt", "copy.nc", "2.nc"]
    assert "heights are those of 0.nc" in part.refused["copy.nc"]
    assert part.refused["2.nc"].startswith("this file does not exist; give a file")
    assert [text.startswith("refused: ") for text in part.warnings[:4]] == [True] * 3 + [False]
    assert part.answers["contact_stiffness"].count == 2
    with pytest.raises(
        rl.InputError,
        match=r"none of the 2 maps can be pressed: bad\.txt: this file .*; 2\.nc: this",
    ):
        pressed([tmp_path / "bad.txt", files[2]])
    softer = ASKED | {"materials": ", ".join([FIRST, SECOND.replace("1000 GPa", "1 MPa")])}
    with pytest.raises(rl.InputError, match="2 maps can be pressed: 0.nc, 1.nc: load 5 MPa is"):
        pressed(files[:2], **softer)


def test_a_single_map_gives_no_interval_of_the_part(maps):
    part = pressed(maps[:1], grid_error=True)
    answer = part.answers["contact_stiffness"]
    assert answer.mean == pytest.approx(answer.of_maps[0].values, rel=1e-12)
    assert answer.of_maps[0].low is not None
    assert np.isnan([answer.low, answer.high, answer.scatter]).all()
    assert any("a single map shows no scatter between places" in note for note in part.notes)


def test_interrupted_the_maps_that_were_done_are_kept(maps, monkeypatch):
    stop_at = maps[2]
    original = variants.press

    def press(body, **named):
        if np.array_equal(body.heights, stop_at.heights):
            raise KeyboardInterrupt
        return original(body, **named)

    monkeypatch.setattr(variants, "press", press)
    part = pressed(maps)
    assert part.interrupted
    assert (part.names, part.left) == (["map 1", "map 2"], ["map 3", "map 4"])
    assert part.answers["contact_stiffness"].count == 2
    assert "not pressed, because of Ctrl-C: map 3, map 4" in part.warnings
    stop_at = maps[0]
    with pytest.raises(KeyboardInterrupt):
        pressed(maps)


def test_maps_of_another_kind_are_pointed_out(maps, part):
    assert "not of one kind" not in " ".join(part.warnings)
    rough, fine = maps[0].scaled(5.0), rl.Surface(maps[1].heights, (5e-5, 5e-5))
    warnings = pressed([*maps[2:], rough, fine]).warnings
    told = [text for text in warnings if text.startswith("not of one kind")]
    for what, name in (("rms heights", "map 3"), ("pixels", "map 4"), ("sides", "map 4")):
        (text,) = (text for text in told if what in text)
        assert f"({name})" in text
        assert "more than a factor of" in text


def test_maps_of_different_size_share_what_is_per_area(maps):
    n = 3 * len(maps[0].heights) // 4
    small = maps[0].cropped((0, n), (0, n)).detrended()
    by_pressure, by_force = (pressed([small, maps[1]], loads=load) for load in ("5 MPa", "1 N"))
    assert "thermal_conductance_per_area" in by_pressure.answers
    assert "contact_stiffness" not in by_pressure.answers
    assert by_force.answers == {}
    assert any("give mean pressures" in text for text in by_force.warnings)
    joint = pressed([small, maps[1]], loads="1 N", ask=rl.Joint("2 cm^2")).answers
    assert joint["normal_force"].mean == pytest.approx([1.0])
    assert "constriction_resistance" in joint


def test_remarks_stand_once_with_the_maps_that_they_are_of(maps):
    part = pressed([maps[0], maps[1].scaled(0.5)], loads="1 N", periodic=True)
    (jump,) = (text for text in part.remarks if "jumps by" in text)
    assert jump.endswith(" (so for map 1; the numbers of the other maps differ)")
    (load,) = (text for text in part.notes if "in all" in text)
    assert load.startswith("load 1 N: ")  # the same for all
    wide = rl.Surface(maps[3].heights, (1e-4, 2e-4), is_cut_out=True)
    part = pressed([maps[0], wide], loads="1 N")
    (load,) = (text for text in part.notes if "in all" in text)
    assert load.startswith("load 1 N: ")
    assert load.endswith(" (so for map 1; the numbers of the other maps differ)")
    slope = 32e-6 * np.linspace(0, 1, len(maps[0].heights), endpoint=False)
    tilted = rl.Surface(maps[0].heights + slope, (1e-4, 1e-4), is_cut_out=True)
    (tilt,) = (text for text in pressed([maps[1], tilted]).warnings if "surface is tilted" in text)
    assert tilt.startswith("of map 2: ")


def test_every_load_is_told_once(maps):
    """Though what is said of them differs in its numbers alone."""
    part = pressed(maps[:2], loads=["5 MPa", "2 MPa"])
    told = [note for note in part.notes if "over the nominal area" in note]
    assert [note[:11] for note in told] == ["load 5 MPa:", "load 2 MPa:"]


def test_progress_is_told_map_by_map(maps):
    told = []
    question = rl.Question(maps[:2], loads="5 MPa", **ASKED)
    rl.assess(question, map_progress=lambda done, total: told.append((done, total)))
    assert told == [(0, 2), (1, 2), (2, 2)]


@pytest.mark.parametrize(
    ("asked", "message"),
    [
        ({"body": []}, "body holds no map"),
        ({"materials": None, "E_star": 1e9}, "need two materials"),
        ({"loads": ()}, "pressed under the same loads: give them (loads=)"),
        ({"reading": rl.Reading(name="x")}, "the name in reading= is that of one file"),
        ({"body": ["a.x3p", "b.x3p", "./a.x3p"]}, "a.x3p is given twice"),
        ({"body": ["a.x3p", 3]}, "body is 3; give a Surface"),
        ({"against": "c.x3p"}, "the one second topography (against=)"),
    ],
)
def test_questions_of_several_maps_that_cannot_be(asked, message):
    asked = {"body": ["a.x3p", "b.x3p"], "materials": "steel,copper", "loads": "1 N", **asked}
    with pytest.raises(rl.InputError, match=re.escape(message)):
        rl.Question(**asked)


def test_the_maps_of_a_part_are_asked_the_same(maps):
    questions = [rl.Question(each, loads="5 MPa", **ASKED) for each in maps[:2]]
    other = rl.Question(maps[2], loads="6 MPa", **ASKED)
    with pytest.raises(rl.InputError, match="asked the same question, but loads differs"):
        rl.assess_part([*questions, other])
    named = rl.assess_part(questions, names=["left", "right"])
    assert named.names == ["left", "right"]


def test_files_of_one_name_are_told_apart_by_their_folders(maps, tmp_path):
    files = []
    for folder, each in zip(("left", "right"), maps, strict=False):
        (tmp_path / folder).mkdir()
        files.append(tmp_path / folder / "scan.nc")
        rl.write(replace(each, unit="m"), files[-1])
    assert pressed(files).names == ["left/scan.nc", "right/scan.nc"]
