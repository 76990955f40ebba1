"""Dask schedulers and workers on loopback: as processes of their own, or all in this process."""

import logging
import subprocess
import sys
import time

from distributed import LocalCluster

from reference import patience


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
