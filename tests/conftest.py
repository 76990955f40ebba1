"""What several test folders share."""

from pathlib import Path

import pytest

_STUDY = Path(__file__).parents[1] / "studies" / "paper" / "data"
_TOPOGRAPHIES = Path(__file__).parents[2] / "shared" / "topographies"


@pytest.fixture(scope="session")
def topographies() -> Path:
    """Folder of measured files, beside the repository; tests that want it are skipped elsewhere."""
    if not _TOPOGRAPHIES.is_dir():
        pytest.skip("no measured files beside the repository")
    return _TOPOGRAPHIES


@pytest.fixture(scope="session")
def published_results():
    """Return the results of the paper's study that come with the sources."""
    from roughline.paper.results import results_of_folder

    return results_of_folder(_STUDY, name="", command="")
