"""Averages of ensembles: what is averaged, how sure, and what was left out."""

import numpy as np
import pytest
from scipy.stats import t

import roughline as rl
from roughline.statistics.averages import relative_difference
from roughline.statistics.bootstrap import ROUNDS


def test_the_mean_is_the_mean(ensemble):
    found = rl.average(ensemble)
    assert found.mean == pytest.approx(ensemble.mean(axis=0))
    assert found.scatter == pytest.approx(ensemble.std(axis=0, ddof=1))
    assert found.standard_error == pytest.approx(found.scatter / np.sqrt(40))
    assert (found.count == 40).all()
    # the interval is close to Student's, 2.02 errors on each side for 39 degrees of freedom
    assert found.high - found.low == pytest.approx(2 * 2.02 * found.standard_error, rel=0.15)
    geometric = rl.average(ensemble, "geometric")
    assert geometric.mean == pytest.approx(np.exp(np.log(ensemble).mean(axis=0)))
    assert geometric.scatter == pytest.approx(0.3, rel=0.4)
    assert (geometric.mean < found.mean).all()


def curves(realisations, seed):
    """Log-normal curves of two correlated loads, each of mean 1."""
    rng = np.random.default_rng(seed)
    common, own = rng.normal(0, 0.3, (2, realisations, 1))
    return np.exp(common + np.array([-0.3, 0.3]) * own - 0.3**2 * (1 + 0.3**2) / 2)


def resampled_means(values, seed):
    """Logarithm of a mean with its error: of the ensemble first, then of each resample."""
    count = len(values)
    draws = np.random.default_rng(seed).integers(count, size=(ROUNDS, count))
    drawn = np.concatenate([values[np.newaxis], values[draws]])
    means = drawn.mean(axis=1)
    return means, drawn.std(axis=1, ddof=1) / np.sqrt(count)


def studentised(values, errors, freedom):
    """Ends of the interval: on each side the farther of Student's and the resamples'."""
    steps = np.sort((values[1:] - values[0]) / errors[1:], axis=0)
    low, high = steps[round(0.025 * (ROUNDS - 1))], steps[round(0.975 * (ROUNDS - 1))]
    width = t.ppf(0.975, freedom)
    return values[0] - np.maximum(high, width) * errors[0], values[0] - (
        np.minimum(low, -width) * errors[0]
    )


@pytest.mark.parametrize("realisations", [10, 20, 60])
def test_intervals_are_studentised_and_hold_the_truth(realisations):
    """Of means and differences of log-normal curves of two correlated loads."""
    few, many = curves(realisations, 3), curves(200, 4)
    means, errors = resampled_means(few, 0)
    found = rl.average(few)
    assert [found.low, found.high] == pytest.approx(
        np.array(studentised(means, errors, realisations - 1))
    )
    assert ((found.low < 1) & (found.high > 1)).all()
    others, of_others = resampled_means(many, 1)
    own, other = errors / means, of_others / others
    share = own[0] ** 2 / (own[0] ** 2 + other[0] ** 2)
    welch = 1 / (share**2 / (realisations - 1) + (1 - share) ** 2 / 199)
    ends = studentised(np.log(means / others), np.hypot(own, other), welch)
    _, low, high = relative_difference(few, many, paired=False)
    assert [low, high] == pytest.approx(np.expm1(ends))
    assert ((low < 0) & (high > 0)).all()


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


def test_realisations_that_are_all_alike_have_no_width():
    found = rl.average(np.full((20, 2), 1 / 3))
    assert (found.low == found.mean).all()
    assert (found.high == found.mean).all()


def test_few_realisations_are_judged_by_student():
    """With two values, 12.7 standard errors on each side."""
    found = rl.average(np.array([[1.0], [3.0]]))
    assert [found.low[0], found.high[0]] == pytest.approx([2 - 12.7062, 2 + 12.7062], abs=1e-3)


@pytest.mark.parametrize(
    ("values", "options", "message"),
    [
        (np.ones(3), {}, r"shape \(3,\)"),
        (np.ones((0, 3)), {}, "realisations, loads"),
        (np.ones((3, 3)), {"averaging": "median"}, 'averaging is "median"'),
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
    with pytest.raises(rl.InputError, match="a relative difference needs positive values"):
        relative_difference(np.zeros((3, 2)), np.ones((3, 2)), paired=True)
