"""The paper's study: its data are those of its plan, and of the library."""

import math
import re
from dataclasses import replace

import numpy as np
import pytest

import roughline as rl
from roughline import campaign
from roughline.paper.laws import exponent_estimate
from roughline.paper.results import published_results
from roughline.paper.windows import Windows
from studies.area.measure import REDUCED as AREA
from studies.correlations.measure import version as version_of_correlations
from studies.finite_size.samples import REDUCED as FINITE_SIZE
from studies.paper import study
from studies.paper.data import dataset
from studies.paper.study import ENSEMBLES, PLAN, computing_of, refuse_another_plan
from studies.sealing.study import data as of_sealing


def test_the_data_are_those_of_the_plan():
    refuse_another_plan()
    plan = campaign.read_plan(PLAN)
    for file_name, name in ENSEMBLES.items():
        data, ensemble = dataset(file_name), plan.ensemble(name)
        assert data.sizes["realisation"] == ensemble.realisations
        assert set(data.fractal_dimension.values) <= set(ensemble.fractal_dimensions)
        assert not data.status.values.any()  # no load is left out


def computed():
    return published_results().version


@pytest.mark.parametrize(
    ("page", "said", "version"),
    [
        ("docs/paper.md", "recomputed with roughline {} ", computed),
        ("studies/paper/README.md", "roughline {} from the plan", computed),
        ("docs/area.md", "computed with roughline {}.", lambda: AREA.version),
        ("docs/finite_size.md", "computed with roughline {}.", lambda: FINITE_SIZE.version),
        ("docs/sealing.md", "computed with roughline {}.", lambda: of_sealing().version),
        ("docs/averaging.md", "computed with roughline {}.", computed),
        ("docs/correlations.md", "(these data: version {})", version_of_correlations),
    ],
)
def test_pages_name_the_version_of_the_data_and_not_that_of_the_program(page, said, version):
    """Whatever the program's own version is by now."""
    text = " ".join((PLAN.parents[2] / page).read_text(encoding="utf-8").split())
    assert said.format(version()) in text
    assert len(set(re.findall(r"roughline (\d+\.\d+\.\d+)", text))) <= 1


def test_the_page_of_the_science_quotes_the_areas():
    root = PLAN.parents[2]
    science = " ".join((root / "docs" / "science.md").read_text("utf-8").split())
    laws = published_results().laws
    counted, corrected = (
        [f"{getattr(each, area).kappa.value:.2f}" for each in laws]
        for area in ("cells", "corrected")
    )
    assert f"rises from {counted[0]} to {counted[-1]} as $D_f$ goes from 2 to 3" in science
    assert f"with the corrected area it is {min(corrected)} to {max(corrected)} (" in science


def test_ensembles_of_several_versions_are_named_with_all_of_them():
    results = published_results()
    newer = replace(results, full=results.full.assign_attrs(roughline_version="9.8.7"))
    assert newer.version == f"{results.version} and 9.8.7"


def test_a_plan_that_was_changed_is_refused_with_the_difference(tmp_path, monkeypatch):
    changed = PLAN.read_text(encoding="utf-8").replace("points = 2048", "points = 4096")
    (tmp_path / "plan.toml").write_text(changed, encoding="utf-8")
    monkeypatch.setattr(study, "PLAN", tmp_path / "plan.toml")
    with pytest.raises(rl.StoreError, match="'surfaces' has n = 2048, the plan has 4096"):
        refuse_another_plan()


def test_half_of_the_surfaces_widen_an_interval_by_the_square_root_of_two():
    ratios = []
    for dimension in published_results().full.fractal_dimension.values:
        full = published_results().full.sel(fractal_dimension=dimension)
        force, stiffness = full.force_bar.values, full.stiffness.values
        whole, half = (
            exponent_estimate(rl.fit_power_law(force, stiffness[:count], Windows().full))
            for count in (60, 30)
        )
        ratios.append((half.high - half.low) / (whole.high - whole.low))
    assert np.mean(ratios) == pytest.approx(math.sqrt(2), rel=0.15)


@pytest.mark.parametrize("file_name", ["coarse", "grid_128", "matched"])
def test_a_body_of_the_data_is_what_the_library_gives(file_name):
    """Surfaces to what they are certified to, lines exactly."""
    ensemble = campaign.read_plan(PLAN).ensemble(ENSEMBLES[file_name])
    realisation = min(3, ensemble.realisations - 1)
    spectrum, seed = ensemble.spectrum(2.4), ensemble.body_seed(realisation)
    body = getattr(spectrum, "line" if ensemble.model == "reduced" else "surface")(ensemble.n, seed)
    curve = rl.press(body, E_star=1.0, forces=ensemble.force_bars[::4])
    one = dataset(file_name).sel(fractal_dimension=2.4).isel(realisation=realisation)
    assert one.stiffness.values[::4] == pytest.approx(curve.stiffness, rel=1e-4)


def test_what_computing_took_is_read_off_the_log(tmp_path):
    log = (
        '{"processor": "a processor", "cores": 2, "seconds": 3600.0, "done": {"lines": 10}, '
        '"core_seconds": {"lines": 3.0}}\n'
        '{"processor": "a processor", "cores": 2, "seconds": 1800.0, "done": {"lines": 5, '
        '"surfaces": 4}, "core_seconds": {"lines": 1.5, "surfaces": 100.0}}\n'
    )
    (tmp_path / "study.zarr.log").write_text(log, encoding="utf-8")
    assert computing_of(tmp_path / "study.zarr") == {
        "processor": "a processor",
        "cores": 2,
        "hours": 1.5,
        "core_seconds": {"lines": 0.3, "surfaces": 25.0},
    }
