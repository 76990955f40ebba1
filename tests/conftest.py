"""What several test folders share."""

from pathlib import Path

import pytest

_TOPOGRAPHIES = Path(__file__).parents[2] / "shared" / "topographies"


@pytest.fixture(scope="session")
def topographies() -> Path:
    """Folder of measured files, beside the repository; tests that want it are skipped elsewhere."""
    if not _TOPOGRAPHIES.is_dir():
        pytest.skip("no measured files beside the repository")
    return _TOPOGRAPHIES
