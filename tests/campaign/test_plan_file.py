"""Plans in TOML: what they may say, and one line for what they may not."""

import pytest

import roughline as rl
from roughline import campaign
from roughline.campaign.plan import decades, evenly
from roughline.campaign.plan_file import plan_from

ENSEMBLE = {
    "name": "lines",
    "model": "reduced",
    "fractal_dimensions": [2.0, 2.5],
    "points": 4096,
    "realisations": 3,
    "force_bars": [0.1, 1.0],
}


def plan(**changes):
    table = {key: value for key, value in (ENSEMBLE | changes).items() if value is not None}
    return plan_from({"name": "test", "seed": 1, "ensemble": [table]})


def test_a_plan_file_is_read(tmp_path):
    path = tmp_path / "study.toml"
    path.write_text(
        """
        seed = 3
        [[ensemble]]
        name = "map"
        model = "full"
        fractal_dimensions = { from = 2, to = 3, count = 11 }
        points = [32, 64]
        roll_off_ratios = [1, 2]
        cutoff_ratio = 16
        boundary = "periodic"
        realisations = 4
        force_bars = { from = 1e-3, to = 1, per_decade = 2 }
        """
    )
    found = campaign.read_plan(path)
    assert found.name == "study"
    assert [ensemble.name for ensemble in found.ensembles] == [
        "map-n32-roll1",
        "map-n32-roll2",
        "map-n64-roll1",
        "map-n64-roll2",
    ]
    last = found.ensembles[-1]
    assert (last.n, last.roll_off_ratio, last.cutoff_ratio, last.seed) == (64, 2.0, 16.0, 3)
    assert (last.boundary, last.realisations, found.cases) == ("periodic", 4, 4 * 44)
    assert last.fractal_dimensions == (2.0, 2.1, 2.2, 2.3, 2.4, 2.5, 2.6, 2.7, 2.8, 2.9, 3.0)
    assert last.force_bars[::2] == (1e-3, 1e-2, 1e-1, 1.0)


def test_ranges_hit_what_a_person_would_type():
    assert evenly(2, 3, 101)[20] == 2.2
    assert decades(1e-5, 10, 10)[::10] == (1e-5, 1e-4, 1e-3, 1e-2, 1e-1, 1.0, 10.0)
    assert decades(1e-3, 3, 6)[-1] == pytest.approx(10 ** (2 / 6), rel=1e-12)


def test_a_spectrum_has_the_cutoffs_of_its_plan():
    ensemble = plan(roll_off_ratios=4, cutoff_ratio=64).ensembles[0]
    spectrum = ensemble.spectrum(2.5)
    assert spectrum.q_roll / spectrum.q_low == pytest.approx(4)
    assert spectrum.q_high / spectrum.q_low == pytest.approx(64)
    assert (spectrum.hurst, spectrum.rms_height) == (0.5, 1.0)


@pytest.mark.parametrize(
    ("changes", "message"),
    [
        ({"realizations": 3}, "'realizations' is not known; did you mean 'realisations'?"),
        (
            {"realizations": 3, "realisations": None},
            "'realizations' is not known; did you mean 'realisations'?",
        ),
        ({"xyzzy": 3}, "'xyzzy' is not known; known are name, model,"),
        ({"points": None}, "has no 'points'"),
        ({"points": "many"}, 'points is "many"; a whole number is needed'),
        ({"points": []}, "points is []; at least one whole number is needed"),
        ({"points": True}, "a whole number is needed"),
        ({"points": 2}, "2 points; allowed are 3 to"),
        ({"points": 2**40}, "points; allowed are 3 to"),
        ({"realisations": 0}, "0 realisations; at least one"),
        ({"realisations": 2.5}, "realisations is 2.5; a whole number"),
        ({"fractal_dimensions": []}, "fractal_dimensions is []; at least one number"),
        ({"fractal_dimensions": [1.9]}, "fractal dimension 1.9; allowed is 2 to 3"),
        ({"fractal_dimensions": [2.5, 2.5]}, "given twice"),
        ({"fractal_dimensions": {"from": 2, "to": 3}}, "{from, to, count}"),
        ({"fractal_dimensions": {"from": 3, "to": 2, "count": 5}}, "from < to and a count"),
        ({"force_bars": {"from": 0, "to": 2, "per_decade": 5}}, "0 < from < to"),
        ({"force_bars": [1.0, 0.5]}, "must be positive, finite and rising"),
        ({"force_bars": [float("nan")]}, "must be positive, finite and rising"),
        ({"force_bars": [-1.0]}, "must be positive, finite and rising"),
        ({"model": "both"}, 'model is \'both\'; allowed are "full" and "reduced"'),
        ({"boundary": "free"}, "boundary is 'free'; the reduced model has 'none'"),
        ({"model": "full", "boundary": "none"}, "boundary is 'none'; the full model has"),
        ({"roll_off_ratios": 0.5}, "roll_off_ratio is 0.5; q_roll / q_low is 1 or more"),
        ({"cutoff_ratio": 4096}, "roll_off_ratio < cutoff_ratio <= points / 2"),
        ({"cutoff_ratio": 2, "roll_off_ratios": 4}, "roll_off_ratio < cutoff_ratio"),
        ({"name": "../lines"}, "a name has letters"),
    ],
)
def test_what_cannot_be_is_said_in_one_line(changes, message):
    with pytest.raises(rl.InputError) as caught:
        plan(**changes)
    assert message in str(caught.value)
    assert "\n" not in str(caught.value)


@pytest.mark.parametrize(
    ("content", "message"),
    [
        ({"ensemble": []}, "the plan has no ensemble"),
        ({}, "the plan has no 'ensemble'"),
        ({"ensembles": [ENSEMBLE]}, "'ensembles' is not known; did you mean 'ensemble'?"),
        ({"ensemble": [ENSEMBLE, ENSEMBLE]}, "two ensembles are named 'lines'"),
        ({"ensemble": ENSEMBLE}, "a list of tables [[ensemble]] is needed"),
        ({"seed": -1, "ensemble": [ENSEMBLE]}, "seed is -1"),
        ({"sede": 1, "ensemble": [ENSEMBLE]}, "'sede' is not known; did you mean 'seed'?"),
    ],
)
def test_whole_plans_are_checked_too(content, message):
    with pytest.raises(rl.InputError) as caught:
        plan_from(content)
    assert message in str(caught.value)


@pytest.mark.parametrize(
    ("text", "message"),
    [
        ("not toml at all", "is not valid TOML"),
        ("", "the plan has no 'ensemble'"),
        ("\xff\xfe", "is not valid TOML"),
    ],
)
def test_files_that_are_no_plans(tmp_path, text, message):
    path = tmp_path / "plan.toml"
    path.write_text(text, encoding="utf-8")
    with pytest.raises(rl.InputError, match=message):
        campaign.read_plan(path)


def test_files_that_cannot_be_read(tmp_path):
    with pytest.raises(rl.InputError, match="does not exist; a plan in TOML"):
        campaign.read_plan(tmp_path / "none.toml")
    with pytest.raises(rl.InputError, match="cannot be read"):
        campaign.read_plan(tmp_path)
    (tmp_path / "binary.toml").write_bytes(b"\x89PNG\xff\x00")
    with pytest.raises(rl.InputError, match="cannot be read"):
        campaign.read_plan(tmp_path / "binary.toml")
