"""Clusters: by address, with schedulers and workers of several kinds, and of this machine."""

import contextlib
import multiprocessing.util
import os
import socket
import subprocess
import sys
import threading
import time

import dask
import pytest
from distributed import Client, LocalCluster, Status

import roughline as rl
from dask_processes import cluster_here, start_scheduler, start_worker
from reference import patience
from roughline import campaign
from roughline.campaign import cluster
from small_campaign import tree


@pytest.fixture
def plan(few_plan_file):
    return few_plan_file


@pytest.fixture(params=["in this process", "processes"])
def cluster_of(request, tmp_path):
    """Start a cluster of some workers with some threads; returns its address."""
    with contextlib.ExitStack() as stack:

        def started(workers, threads):
            if request.param == "in this process":
                here = cluster_here(n_workers=workers, threads_per_worker=threads)
                return stack.enter_context(here).scheduler_address
            scheduler, address = start_scheduler(tmp_path)
            count = ("--nthreads", str(threads))
            for process in (scheduler, *(start_worker(address, *count) for _ in range(workers))):
                stack.callback(process.wait)
                stack.callback(process.kill)
            return address

        yield started


def test_a_cluster_gives_the_same_bytes(plan, few_undisturbed, cluster_of, tmp_path, invoke):
    code, out, err = invoke(
        "campaign", "run", plan, store=tmp_path / "far", scheduler=cluster_of(2, 1)
    )
    assert code == 0, err
    assert "30 cases computed, 0 failed" in out
    assert "dashboard: http" in err
    assert tree(tmp_path / "far") == few_undisturbed


def test_workers_with_several_threads_give_the_same_bytes(
    plan, few_undisturbed, cluster_of, tmp_path
):
    """Two cases at a time in one process: nothing is shared between them."""
    campaign.run(campaign.read_plan(plan), tmp_path / "far", scheduler=cluster_of(1, 2))
    assert tree(tmp_path / "far") == few_undisturbed


SENSELESS = ("", "nonsense://x:1", "8786", "tcp://", "10.0.0.1", "tcp://10.0.0.1:99999")


@pytest.mark.parametrize("address", [*SENSELESS, "http://127.0.0.1:8787/status"])
def test_an_address_that_makes_no_sense(plan, tmp_path, address):
    with pytest.raises(rl.InputError, match="the address that `dask scheduler` prints") as caught:
        campaign.run(campaign.read_plan(plan), tmp_path / "store", scheduler=address)
    assert repr(address) in str(caught.value)
    assert ("dashboard" in str(caught.value)) == address.startswith("http")
    assert not list(tmp_path.iterdir())


@pytest.mark.parametrize("address", ["tcp://127.0.0.1:1", "tls://127.0.0.1:1", "127.0.0.1:1"])
def test_a_scheduler_that_does_not_answer(plan, tmp_path, address, monkeypatch):
    monkeypatch.setattr(cluster, "_ANSWER_WITHIN", 0.3)
    with pytest.raises(rl.ClusterError, match="no Dask scheduler answers at") as caught:
        campaign.run(campaign.read_plan(plan), tmp_path / "store", scheduler=address)
    assert "\n" not in str(caught.value)
    assert ("certificates" in str(caught.value)) == address.startswith("tls")
    assert dask.config.get("scheduler", None) is None  # the caller's Dask is left as it was
    assert not list(tmp_path.iterdir())  # no store, and nothing else


def test_a_server_that_is_silent(plan, tmp_path, monkeypatch):
    assert_is_no_scheduler(plan, tmp_path, monkeypatch, b"")


def test_a_server_that_says_what_dask_takes_for_the_size_of_a_message(plan, tmp_path, monkeypatch):
    assert_is_no_scheduler(plan, tmp_path, monkeypatch, b"HTTP/1.1 400 Bad Request\r\n\r\n")


def assert_is_no_scheduler(plan, tmp_path, monkeypatch, says):
    monkeypatch.setattr(cluster, "_ANSWER_WITHIN", 0.5)
    ended = threading.Event()

    def serve():
        connection, _ = server.accept()
        with connection:
            connection.sendall(says)
            ended.wait()

    with socket.create_server(("127.0.0.1", 0)) as server:
        thread = threading.Thread(target=serve)
        thread.start()
        address = f"tcp://127.0.0.1:{server.getsockname()[1]}"
        with pytest.raises(rl.ClusterError, match=f"no Dask scheduler answers at {address}"):
            campaign.run(campaign.read_plan(plan), tmp_path / "store", scheduler=address)
        ended.set()
        thread.join()


def test_a_scheduler_without_workers(plan, cluster_without_workers, tmp_path, monkeypatch):
    wait = Client.wait_for_workers

    def wait_shortly(client, count, timeout):
        wait(client, count, timeout=0.1)

    monkeypatch.setattr(Client, "wait_for_workers", wait_shortly)
    with pytest.raises(rl.ClusterError, match="has no workers; start some with"):
        campaign.run(
            campaign.read_plan(plan), tmp_path / "store", scheduler=cluster_without_workers
        )
    assert not (tmp_path / "store").exists()


def test_workers_of_another_version(plan, tmp_path, invoke):
    """Told before anything is computed, with the address of the worker."""
    fake = tmp_path / "fake"
    fake.mkdir()
    (fake / "sitecustomize.py").write_text(
        "import roughline._version\nroughline._version.__version__ = '0.0.9'\n"
    )
    scheduler, address = start_scheduler(tmp_path)
    worker = start_worker(address, env={**os.environ, "PYTHONPATH": str(fake)})
    try:
        code, _, err = invoke("campaign", "run", plan, store=tmp_path / "store", scheduler=address)
        assert code == 2
        last = err.splitlines()[-1]
        assert "a worker has roughline 0.0.9, and the campaign has" in last
        assert f"install version {rl.__version__} there" in last
        assert "Traceback" not in err
    finally:
        for process in (worker, scheduler):
            process.kill()
            process.wait()


def test_workers_without_roughline(plan, tmp_path, invoke):
    fake = tmp_path / "fake" / "roughline"
    fake.mkdir(parents=True)
    (fake / "__init__.py").write_text("")  # a package of that name with nothing in it
    scheduler, address = start_scheduler(tmp_path)
    worker = start_worker(address, env={**os.environ, "PYTHONPATH": str(fake.parent)})
    try:
        code, _, err = invoke("campaign", "run", plan, store=tmp_path / "store", scheduler=address)
        assert code == 2
        assert "has no roughline; install version" in err.splitlines()[-1]
        assert "Traceback" not in err
    finally:
        for process in (worker, scheduler):
            process.kill()
            process.wait()


def test_a_campaign_without_a_main_module_to_import():
    """The package itself starts no process and loads no cluster when it is imported."""
    script = "import sys, roughline.campaign; sys.exit('distributed' in sys.modules)"
    assert subprocess.run([sys.executable, "-c", script], check=False).returncode == 0


def test_workers_that_are_gone_for_good_are_replaced():
    """As happens to one that dies just while it starts again: Dask gives it up."""
    one = cluster.local(1)
    with dask.config.set({"distributed.deploy.lost-worker-timeout": "1s"}), one as here:
        assert here.cores() == 1
        here.client.retire_workers()
        deadline = time.monotonic() + patience()
        while here.cores():
            assert time.monotonic() < deadline, "the worker stays"
        while not here.cores():
            assert time.monotonic() < deadline, "no new worker"
            time.sleep(0.2)


@pytest.mark.parametrize("restarts", [0, 3])
def test_a_cluster_is_closed_when_its_workers_have_started(monkeypatch, restarts):
    """One that is closed while it starts sometimes never ends."""
    close, running = LocalCluster.close, []

    def recording_close(self, *arguments):
        states = [worker.status for worker in self.scheduler.workers.values()]
        running.append(states.count(Status.running))
        return close(self, *arguments)

    monkeypatch.setattr(LocalCluster, "close", recording_close)
    deaths = dask.config.set({"distributed.scheduler.allowed-failures": restarts})
    with deaths, cluster.local(1) as one:
        died = one.client.submit(os._exit, 9, pure=False)
        assert type(died.exception()).__name__ == "KilledWorker"
    assert running[0] == 1


@pytest.mark.parametrize("silent", [True, False])
def test_a_worker_that_is_closed_says_no_more(silent, capfd, monkeypatch):
    """Dask may close it twice, and its process ends with a traceback then."""

    def complain_at_the_end():
        def complain():
            sys.stderr.write("Traceback")

        multiprocessing.util.Finalize(None, complain, exitpriority=1)

    if not silent:
        monkeypatch.setattr(cluster, "_SILENT_WHEN_CLOSED", {})
    # what is forked writes to where the first of all wrote
    fresh = dask.config.set({"distributed.worker.multiprocessing-method": "spawn"})
    with fresh, cluster.local(1) as one:
        one.client.run(complain_at_the_end)
        assert "Traceback" not in capfd.readouterr().err
    assert ("Traceback" in capfd.readouterr().err) is not silent


def test_the_callers_dask_is_left_alone():
    with cluster.local(1) as workers:
        assert workers.cores() == 1
        assert dask.config.get("scheduler", None) is None
    assert dask.config.get("scheduler", None) is None
