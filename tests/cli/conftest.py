"""Files that several tests of the command line press."""

import numpy as np
import pytest

import roughline as rl


@pytest.fixture
def points():
    """Points a side of the files; a test may ask for others, as a parameter."""
    return 64


@pytest.fixture
def rough(tmp_path, points):
    """A surface of which all points are known."""
    surface = rl.SelfAffine(hurst=0.7, length=1e-3, rms_height=1e-6).surface(points, 3)
    path = tmp_path / "rough.nc"
    rl.write(rl.Surface(surface.heights, surface.sizes, "m"), path)
    return path


@pytest.fixture
def holed(tmp_path, points):
    """An array in which 3 x 5 points are missing."""
    surface = rl.SelfAffine(hurst=0.7, length=1e-3, rms_height=1e-6).surface(points, 3)
    heights = surface.heights.copy()
    heights[10:13, 20:25] = np.nan
    np.save(tmp_path / "holed.npy", heights)
    return tmp_path / "holed.npy", "--unit", "m", "--size", "1 mm"


@pytest.fixture(params=["its page", "all of it"])
def extent(request):
    """Let a report be its page alone, with few loads of a curve, or all that it is."""
    if request.param == "its page":
        request.getfixturevalue("few_loads")
        patch = request.getfixturevalue("monkeypatch")
        patch.setattr("roughline.report.document.write_pdf", lambda *_: None)
    return request.param
