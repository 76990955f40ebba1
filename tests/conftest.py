"""What several test folders share."""

import sys
from pathlib import Path

import pytest

from dask_processes import start_scheduler, start_worker
from roughline import cli

_TOPOGRAPHIES = Path(__file__).parents[2] / "shared" / "topographies"


@pytest.fixture(scope="session")
def topographies() -> Path:
    """Folder of measured files, beside the repository; tests that want it are skipped elsewhere."""
    if not _TOPOGRAPHIES.is_dir():
        pytest.skip("no measured files beside the repository")
    return _TOPOGRAPHIES


@pytest.fixture(scope="session")
def two_workers(tmp_path_factory):
    """Address of a scheduler with two workers, for campaigns whose own processes do not matter."""
    scheduler, address = start_scheduler(tmp_path_factory.mktemp("two_workers"))
    workers = [start_worker(address, "--nthreads", "1") for _ in range(2)]
    yield address
    for process in (*workers, scheduler):
        process.kill()
        process.wait()


@pytest.fixture
def invoke(monkeypatch, capsys):
    """Run the command in this process; returns exit code, output and errors."""

    def run(*arguments):
        monkeypatch.setattr(sys, "argv", ["roughline", *map(str, arguments)])
        with pytest.raises(SystemExit) as caught:
            cli.main()
        captured = capsys.readouterr()
        return caught.value.code, captured.out, captured.err

    return run
