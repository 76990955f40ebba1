"""What tests of the server share."""

from contextlib import contextmanager

import pytest

from lab.server.serving import lab_here, running_lab
from roughline.lab.server import files


@contextmanager
def small_lab(temporary):
    """Run a lab in a process of its own that takes small files; see that it leaves nothing."""
    small = "from roughline.lab.server import files", "files.MOST_UPLOAD = 1_000_000"
    with running_lab(temporary=temporary, statements=small) as running:
        yield running
    assert running.process.returncode == 0
    assert not list(temporary.glob("roughline-lab-*"))


@pytest.fixture(scope="module")
def lab(tmp_path_factory):
    """A lab that takes small files."""
    with small_lab(tmp_path_factory.mktemp("open")) as running:
        yield running


@pytest.fixture(scope="module", params=["here", "in a process"])
def any_lab(request, tmp_path_factory):
    """A lab in a thread of this process or in a process of its own."""
    temporary = tmp_path_factory.mktemp("open")
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(files, "MOST_UPLOAD", 1_000_000)
        with lab_here(temporary) if request.param == "here" else small_lab(temporary) as running:
            yield running
