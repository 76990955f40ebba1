"""What several test folders share."""

import sys
from functools import cache, partial
from pathlib import Path

import numpy as np
import pytest
import typer

import roughline as rl
from blank_figures import blank_but
from lab_in_browser import WANTED, Chromium
from roughline import cli
from tiers import pytest_addoption, pytest_configure, pytest_xdist_make_scheduler  # noqa: F401
from validation import hold

_TOPOGRAPHIES = Path(__file__).parents[2] / "shared" / "topographies"
_CHROMIUM = Chromium()


def pytest_collection_modifyitems(items):
    """Mark what needs a browser."""
    for item in items:
        if "browser" in getattr(item, "fixturenames", ()):
            item.add_marker(pytest.mark.browser)


@pytest.fixture(scope="session")
def topographies() -> Path:
    """Folder of measured files, beside the repository; tests that want it are skipped elsewhere."""
    if not _TOPOGRAPHIES.is_dir():
        pytest.skip("no measured files beside the repository")
    return _TOPOGRAPHIES


@pytest.fixture(scope="module")
def browser():
    """Return the headless Chromium of this process."""
    pytest.importorskip("playwright.sync_api", reason="playwright is not installed")
    started = _CHROMIUM.started()
    if started is None:
        pytest.skip(WANTED)
    return started


@pytest.hookimpl(wrapper=True)
def pytest_runtest_teardown(item, nextitem):
    """Close the Chromium before the tests of another file, if the first needs none."""
    __tracebackhide__ = True
    try:
        return (yield)
    finally:
        if nextitem and nextitem.path != item.path and "browser" not in nextitem.fixturenames:
            _CHROMIUM.close()


def pytest_unconfigure():
    """Close the Chromium at the end."""
    _CHROMIUM.close()


@pytest.fixture
def few_loads(monkeypatch):
    """Let a whole curve have few loads, each of which takes as long as the others."""
    monkeypatch.setattr("roughline.question.loading.CURVE_LOADS", 3)


@pytest.fixture(params=["few loads", "all loads"])
def loads_of_curve(request):
    """Let a whole curve have few loads, or all; returns which."""
    if request.param == "few loads":
        request.getfixturevalue("few_loads")
    return request.param


@pytest.fixture
def judged(request):
    """Hold the errors of a test against an exact solution to those that the handbook tells."""
    file = request.path.relative_to(request.config.rootpath).as_posix()
    test = f"{file}::{request.function.__name__}"

    def held(solution, quantity, grid, error):
        hold(test, solution, quantity, grid, float(error))

    return held


@pytest.fixture
def nothing_kept():
    """Press without what presses before have kept, and keep nothing for those that follow."""
    from roughline.halfspace.inverse import cache  # compiled loops load slowly, so only here

    cache._cache.clear()
    yield
    cache._cache.clear()


@pytest.fixture
def by_regions(monkeypatch, nothing_kept):
    """Solve small grids as large ones are: by regions, and by transforms of rows and columns."""
    from roughline.halfspace.operators import convolution

    monkeypatch.setattr(convolution, "FEW_MODES", 0)


@pytest.fixture(params=["at once", "by regions"])
def either_search(request):
    """Solve small grids by whole fields, and as large ones are."""
    if request.param == "by regions":
        request.getfixturevalue("by_regions")


@pytest.fixture
def rough(tmp_path):
    """A surface of 64 x 64 points of which all are known."""
    surface = rl.SelfAffine(hurst=0.7, length=1e-3, rms_height=1e-6).surface(64, 3)
    path = tmp_path / "rough.nc"
    rl.write(rl.Surface(surface.heights, surface.sizes, "m"), path)
    return path


@pytest.fixture
def holed(tmp_path):
    """An array of 64 x 64 points, 3 x 5 of which are missing."""
    heights = rl.SelfAffine(hurst=0.7, length=1e-3, rms_height=1e-6).surface(64, 3).heights.copy()
    heights[10:13, 20:25] = np.nan
    np.save(tmp_path / "holed.npy", heights)
    return tmp_path / "holed.npy", "--unit", "m", "--size", "1 mm"


_command_of = cache(typer.main.get_command)  # which takes most of the time of a short command


def _option_words(name, given):
    """The words of an option in a command."""
    flag = f"-{name}" if len(name) == 1 else f"--{name.replace('_', '-')}"
    if given is True:
        return [flag]
    return [word for one in (given if isinstance(given, list) else [given]) for word in (flag, one)]


@pytest.fixture
def invoke(monkeypatch, capsys):
    """Run the command line in this process; returns exit code, output and errors.

    Options may be given as keywords: a list for one that is given several times, True for a flag.
    """
    monkeypatch.setattr(typer.main, "get_command", _command_of)

    def run(*arguments, **options):
        words = [*arguments, *(word for each in options.items() for word in _option_words(*each))]
        monkeypatch.setattr(sys, "argv", ["roughline", *map(str, words)])
        with pytest.raises(SystemExit) as caught:
            cli.main()
        captured = capsys.readouterr()
        return caught.value.code, captured.out, captured.err

    return run


@pytest.fixture(scope="session")
def published_results():
    """Return the results of the paper's study that come with the package."""
    from roughline.paper import results

    return results.published_results()


@pytest.fixture
def only_drawn(monkeypatch):
    """Give what leaves figures blank, but for those of some names: where their page is judged."""
    return partial(blank_but, monkeypatch)
