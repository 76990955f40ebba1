"""Resampled realisations: which are drawn, and the errors of what is made of them."""

import numpy as np
import pytest
from scipy.stats import ttest_ind

from roughline.statistics import bootstrap


def test_resampling_is_the_same_for_the_same_seed(ensemble):
    found = bootstrap.means(ensemble, 3)
    assert found.values.shape == (bootstrap.ROUNDS, 5)
    assert (found.values == bootstrap.means(ensemble, 3).values).all()
    draws = np.random.default_rng(3).integers(40, size=(bootstrap.ROUNDS, 40))
    assert found.values == pytest.approx(ensemble[draws].mean(axis=1))
    assert found.errors == pytest.approx(ensemble[draws].std(axis=1) / np.sqrt(39))


def test_errors_of_smooth_functions_are_those_of_their_scatter(ensemble):
    """The linearised error of log(mean) is that of the realisations over the mean."""
    weights = np.array([0.0, 1.0, 0.0, -2.0, 0.0])
    found = bootstrap.sum_of_log_means(ensemble, weights)
    assert found.value == pytest.approx(np.log(ensemble.mean(axis=0)) @ weights)
    each = (ensemble / ensemble.mean(axis=0)) @ weights
    assert found.error == pytest.approx(each.std(ddof=1) / np.sqrt(40))
    alone = bootstrap.sum_of_log_means(ensemble, np.array([0.0, 1.0, 0, 0, 0]))
    assert alone.interval() == pytest.approx(bootstrap.means(ensemble[:, 1]).log().interval())


def test_a_difference_of_two_ensembles_has_the_freedom_of_welch(ensemble):
    few = 3 * ensemble[:7]  # which scatter more than the others
    found = bootstrap.means(few) - bootstrap.means(ensemble, 1)
    welch = ttest_ind(few, ensemble, equal_var=False)
    assert found.freedom == pytest.approx(welch.df)
    assert found.value / found.error == pytest.approx(welch.statistic)
