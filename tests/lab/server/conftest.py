"""What tests of the server share."""

from contextlib import contextmanager

import pytest

from lab.server.serving import lab_here, running_lab


@contextmanager
def small_lab(temporary):
    """Run a lab with small limits in a process of its own, and see that it leaves nothing."""
    with running_lab("--max-upload", "1", "--max-points", "256", temporary=temporary) as running:
        yield running
    assert running.process.returncode == 0
    assert not list(temporary.glob("roughline-lab-*"))


@pytest.fixture(scope="module")
def lab(tmp_path_factory):
    """A lab for this machine alone, with small limits."""
    with small_lab(tmp_path_factory.mktemp("open")) as running:
        yield running


@pytest.fixture(scope="module", params=["here", "in a process"])
def any_lab(request, tmp_path_factory):
    """Such a lab, in a thread of this process or in a process of its own."""
    temporary = tmp_path_factory.mktemp("open")
    here = lab_here(temporary, max_upload=1e6, max_points=256)
    with here if request.param == "here" else small_lab(temporary) as running:
        yield running
