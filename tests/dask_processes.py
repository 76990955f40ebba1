"""Dask schedulers and workers on loopback: as processes of their own, or all in this process."""

import contextlib
import importlib
import logging
import subprocess
import sys
import time

import dask
import pytest
from distributed import LocalCluster

from reference import patience
from roughline.campaign import cluster


def start_scheduler(folder):
    """Start a scheduler; the process and its address."""
    note = folder / "scheduler.json"
    process = subprocess.Popen(
        [
            *(sys.executable, "-m", "dask", "scheduler", "--host", "127.0.0.1", "--port", "0"),
            *("--no-dashboard", "--scheduler-file", str(note)),
        ],
        stderr=subprocess.DEVNULL,
    )
    deadline = time.monotonic() + patience()
    while time.monotonic() < deadline:
        if note.exists() and '"address"' in (text := note.read_text()):
            return process, text.split('"address": "')[1].split('"')[0]
        time.sleep(0.05)
    process.kill()
    raise TimeoutError("the scheduler does not start")


def start_worker(address, *arguments, **options):
    """Start a worker of a scheduler."""
    command = [sys.executable, "-m", "dask", "worker", address, "--no-dashboard", "--no-nanny"]
    return subprocess.Popen(
        [*command, *arguments], stderr=subprocess.DEVNULL, stdout=subprocess.DEVNULL, **options
    )


def cluster_here(**size):
    """Return a cluster in this process, for what does not ask where cases are computed."""
    return LocalCluster(
        **size,
        processes=False,
        protocol="tcp",
        host="127.0.0.1",
        dashboard_address="127.0.0.1:0",
        silence_logs=logging.CRITICAL,
    )


@contextlib.contextmanager
def unhurried():
    """Wait for schedulers and workers as long as they take where others compute, too.

    Workers of campaigns in this process are forked from one that has loaded Dask, which saves
    seconds; those of campaigns in processes of their own are started afresh.
    """
    forked = dask.config.set({"distributed.worker.multiprocessing-method": "forkserver"})
    with pytest.MonkeyPatch.context() as patch, forked:
        for name in ("_ANSWER_WITHIN", "_READY_WITHIN"):
            patch.setattr(cluster, name, patience())
        runs = importlib.import_module("roughline.campaign.run")
        patch.setattr(runs, "_LONGEST_WAIT_FOR_WORKERS", patience())
        yield
