"""What tests of the server share."""

import asyncio
import inspect

import pytest

from lab.server.serving import lab_here, running_lab
from roughline.lab.server import files


@pytest.hookimpl(tryfirst=True)
def pytest_pyfunc_call(pyfuncitem):
    """Run a test that is a coroutine, in a loop of its own, in which nothing goes wrong unheard."""
    if not inspect.iscoroutinefunction(pyfuncitem.obj):
        return None
    errors = []

    async def tested():
        asyncio.get_running_loop().set_exception_handler(lambda _, said: errors.append(said))
        names = pyfuncitem._fixtureinfo.argnames
        await pyfuncitem.obj(**{name: pyfuncitem.funcargs[name] for name in names})

    asyncio.run(tested())
    assert not errors
    return True


@pytest.fixture(scope="module")
def lab(tmp_path_factory):
    """A lab in a process of its own that takes small files; it leaves nothing."""
    temporary = tmp_path_factory.mktemp("open")
    small = "from roughline.lab.server import files", "files.MOST_UPLOAD = 1_000_000"
    with running_lab(temporary=temporary, statements=small) as running:
        yield running
    assert running.process.returncode == 0
    assert not list(temporary.glob("roughline-lab-*"))


@pytest.fixture(scope="module")
def here(tmp_path_factory):
    """The same in a thread of this process."""
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(files, "MOST_UPLOAD", 1_000_000)
        with lab_here(tmp_path_factory.mktemp("open")) as running:
            yield running
