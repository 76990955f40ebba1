"""What tests of the server share."""

import pytest

from lab.server.serving import running_lab


@pytest.fixture(scope="module")
def lab(tmp_path_factory):
    """A lab for this machine alone, with small limits."""
    temporary = tmp_path_factory.mktemp("open")
    with running_lab("--max-upload", "1", "--max-points", "256", temporary=temporary) as running:
        yield running
    assert running.process.returncode == 0
    assert not list(temporary.glob("roughline-lab-*"))
