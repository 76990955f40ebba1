"""Averages of ensembles: what is averaged, how sure, and what was left out."""

import numpy as np
import pytest

import roughline as rl
from roughline import bootstrap
from roughline.averages import at_levels, relative_difference


@pytest.fixture
def ensemble():
    return np.exp(np.random.default_rng(1).normal(0, 0.3, (40, 5)) + np.arange(5))


def test_the_mean_is_the_mean(ensemble):
    found = rl.average(ensemble)
    assert found.mean == pytest.approx(ensemble.mean(axis=0))
    assert found.scatter == pytest.approx(ensemble.std(axis=0, ddof=1))
    assert found.standard_error == pytest.approx(found.scatter / np.sqrt(40))
    assert (found.count == 40).all()
    # the percentile interval is close to the normal one
    assert found.high - found.low == pytest.approx(2 * 1.96 * found.standard_error, rel=0.15)
    geometric = rl.average(ensemble, "geometric")
    assert geometric.mean == pytest.approx(np.exp(np.log(ensemble).mean(axis=0)))
    assert geometric.scatter == pytest.approx(0.3, rel=0.4)
    assert (geometric.mean < found.mean).all()


def test_intervals_hold_the_truth_as_often_as_they_say():
    """95 % intervals of the mean of 60 log-normal values, in 200 ensembles."""
    rng = np.random.default_rng(7)
    truth = np.exp(0.3**2 / 2)
    held = 0
    for _ in range(200):
        found = rl.average(np.exp(rng.normal(0, 0.3, (60, 1))))
        held += bool(found.low[0] <= truth <= found.high[0])
    assert 180 <= held <= 199


def test_what_is_not_finite_is_left_out_and_counted(ensemble):
    hurt = ensemble.copy()
    hurt[3, 1], hurt[4, 1], hurt[:, 4] = np.nan, np.nan, np.nan
    found = rl.average(hurt)
    assert list(found.count) == [40, 38, 40, 40, 0]
    assert found.mean[1] == pytest.approx(np.nanmean(hurt[:, 1]))
    assert np.isnan([found.mean[4], found.low[4], found.standard_error[4]]).all()
    one = rl.average(ensemble[:1])
    assert one.mean == pytest.approx(ensemble[0])
    assert np.isnan(one.low).all()


def test_pairs_share_their_scatter(ensemble):
    """Where realisations belong together, their common scatter drops out of the difference."""
    other = 1.1 * ensemble * np.random.default_rng(2).normal(1, 0.01, ensemble.shape)
    pairs = relative_difference(other, ensemble, paired=True)
    apart = relative_difference(other, ensemble, paired=False)
    assert pairs[0] == pytest.approx(apart[0])
    assert pairs[0] == pytest.approx(0.1, abs=0.01)
    assert ((pairs[1] <= pairs[0]) & (pairs[0] <= pairs[2])).all()
    assert (pairs[2] - pairs[1] < 0.1 * (apart[2] - apart[1])).all()
    hurt = other.copy()
    hurt[0, 0] = np.nan
    again = relative_difference(hurt, ensemble, paired=True)[0]
    assert again[0] == pytest.approx(hurt[1:, 0].mean() / ensemble[1:, 0].mean() - 1)


def test_resampling_is_the_same_for_the_same_seed(ensemble):
    means = bootstrap.resampled_means(ensemble, 3)
    assert means.shape == (1000, 5)
    assert (means == bootstrap.resampled_means(ensemble, 3)).all()
    draws = np.random.default_rng(3).integers(40, size=(1000, 40))
    assert means == pytest.approx(ensemble[draws].mean(axis=1))


def test_levels_are_those_of_the_plane():
    """Lines of springs at a fixed level, found from curves at fixed force."""
    spectrum = rl.SelfAffine(hurst=0.8, rms_height=1.0)
    forces = np.geomspace(1e-5, 3, 111)
    lines = [spectrum.line(2**14, i) for i in range(8)]
    curves = [rl.press(line, E_star=1.0, forces=forces) for line in lines]
    highest = [line.heights.max() - line.heights.mean() for line in lines]
    depth, stiffness = ([getattr(c, name) for c in curves] for name in ("depth", "stiffness"))
    force, found = at_levels(forces, depth, stiffness, highest, 50)
    assert force.shape == found.shape == (8, 50)
    planes = np.array(highest)[:, np.newaxis] - np.array(depth)
    levels = np.linspace(planes[:, 0].max(), planes[:, -1].max(), 50)
    for i, line in enumerate(lines):
        above = np.maximum(line.heights - line.heights.mean() - levels[:, np.newaxis], 0)
        exact = above.sum(axis=1) / line.heights.size
        sure = exact > 2e-5
        assert force[i][sure] == pytest.approx(exact[sure], rel=0.02)
        share = np.count_nonzero(above, axis=1) / line.heights.size
        assert found[i][sure] == pytest.approx(share[sure], rel=0.05)
    assert (force[:, 0] == 0).sum() == 7


@pytest.mark.parametrize(
    ("values", "options", "message"),
    [
        (np.ones(3), {}, r"shape \(3,\)"),
        (np.ones((0, 3)), {}, "realisations, loads"),
        (np.ones((3, 3)), {"averaging": "median"}, "averaging is 'median'"),
        (np.ones((3, 3)), {"confidence": 95}, "confidence is 95"),
        (np.zeros((3, 3)), {"averaging": "geometric"}, "needs positive values"),
    ],
)
def test_bad_input(values, options, message):
    with pytest.raises(rl.InputError, match=message):
        rl.average(values, **options)
    with pytest.raises(rl.InputError, match="the same loads are needed"):
        relative_difference(np.ones((3, 2)), np.ones((3, 3)), paired=False)
    with pytest.raises(rl.InputError, match="for pairs the same realisations"):
        relative_difference(np.ones((3, 2)), np.ones((4, 2)), paired=True)
