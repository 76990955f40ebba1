"""What the lab shows of the paper and was made once: it is what the data say."""

import json

import numpy as np
import pytest

import roughline as rl
from roughline.report.json_output import plain
from studies.paper.lab_figures import AVERAGES, PUNCHES, lab_figures
from studies.paper.study import FIGURES

AGAIN = "what the lab shows is not what the study found any more: run make published"


@pytest.fixture(scope="module")
def kept():
    return json.loads(FIGURES.read_text(encoding="utf-8"))


@pytest.fixture(scope="module")
def found(published_results):
    return lab_figures(published_results)


def unlike(one, other, where=""):
    """Return the places where numbers differ by more than their five digits, or words at all."""
    if isinstance(one, dict):
        if not isinstance(other, dict) or [*one] != [*other]:
            return [where]
        return [at for key in one for at in unlike(one[key], other[key], f"{where}/{key}")]
    if isinstance(one, list):
        if not isinstance(other, list) or len(one) != len(other):
            return [where]
        pairs = enumerate(zip(one, other, strict=True))
        return [at for i, (a, b) in pairs for at in unlike(a, b, f"{where}/{i}")]
    if isinstance(one, int | float) and isinstance(other, int | float):
        return [] if one == pytest.approx(other, rel=1e-4, abs=1e-9) else [where]
    return [] if one == other else [where]


def test_the_figures_are_those_of_the_data(kept, found):
    assert unlike(kept, json.loads(json.dumps(plain(found)))) == [], AGAIN


@pytest.mark.parametrize("averaging", AVERAGES)
@pytest.mark.parametrize("punch", PUNCHES)
def test_curves_are_means_with_their_standard_error(found, averaging, punch, published_results):
    series = found["curves"][f"3D {averaging} {punch}"]["panels"]["stiffness-3D"]["series"]
    for dimension in published_results.full.fractal_dimension.values:
        one = published_results.full.sel(fractal_dimension=dimension)
        mean = rl.average(one.stiffness.values / PUNCHES[punch], averaging)
        drawn = series[f"{dimension:g} mean"]
        assert drawn["y"] == pytest.approx(mean.mean)
        high = drawn["high"]
        if averaging == "geometric":
            assert np.log(high / mean.mean) == pytest.approx(mean.standard_error)
        else:
            assert high - mean.mean == pytest.approx(mean.standard_error)
    limit = 1.1523 / PUNCHES[punch]
    assert series["saturated"]["y"] == pytest.approx([limit, limit], rel=1e-4)


def test_the_trust_map_is_that_of_the_package(kept):
    whole = rl.trust_map()
    assert len(kept["legend"]) == 10
    for i, roll_off in enumerate(whole.roll_off_ratios):
        cells = kept["sources"][f"trust {roll_off:g}"]
        middles = np.sqrt(np.multiply(cells["left"], cells["right"])).reshape(11, 15)
        assert np.allclose(middles, whole.force_bars, rtol=1e-4)
        unsure = kept["sources"][f"trust {roll_off:g} unsure"]
        assert len(unsure["left"]) == np.count_nonzero(~whole.resolved[i])
    strongest = cells["colour"][int(np.argmax(whole.difference[-1]))]
    assert strongest == kept["legend"][-1][0]
