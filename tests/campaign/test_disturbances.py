"""Nothing is lost: whatever happens to a campaign, it ends in the bytes of an undisturbed one."""

import contextlib
import os
import resource
import shutil
import signal
import subprocess
import sys
import time
from functools import partial

import psutil
import pytest
from distributed import Client

from roughline import campaign
from roughline.campaign.cluster import interrupts_held_back
from roughline.errors import ClusterError
from small_campaign import finish, hear_interrupts, run, start, tree

pytestmark = pytest.mark.skipif(not hasattr(os, "killpg"), reason="signals of POSIX")


@pytest.fixture
def plan(plan_file):
    return plan_file


@pytest.fixture
def resume(plan, undisturbed, two_workers):
    """Run a campaign to its end, and see that it has the bytes of an undisturbed one."""
    return partial(resumed, plan, undisturbed, two_workers)


def resumed(plan, undisturbed, address, store):
    summary = campaign.run(campaign.read_plan(plan), store, scheduler=address)
    assert not summary.failed.total()
    assert tree(store) == undisturbed
    return summary.done.total()


def wait_for_results(store, process, count=3):
    """Wait until some batches of surfaces are written."""
    chunks = store / "surfaces" / "case_status" / "c"
    deadline = time.monotonic() + 60
    while time.monotonic() < deadline and process.poll() is None:
        if sum(path.is_file() for path in chunks.rglob("*")) >= count:
            return
        time.sleep(0.02)
    pytest.fail(f"no results in time: {finish(process)}")


def workers_of(process):
    return [
        child
        for child in psutil.Process(process.pid).children(recursive=True)
        if "spawn_main" in " ".join(child.cmdline())
    ]


def test_workers_killed_and_another_campaign_on_the_same_store(plan, undisturbed, tmp_path, invoke):
    store = tmp_path / "store"
    process = start(plan, store)
    wait_for_results(store, process, 1)
    code, _, err = invoke("campaign", "run", plan, "--store", store)
    assert code == 2
    assert "is in use by another campaign: wait for it to end" in err
    for count in (2, 5):
        wait_for_results(store, process, count)
        workers_of(process)[0].kill()
    code, out, err = finish(process)
    assert code == 0, err
    assert "207 cases computed, 0 failed" in out
    assert tree(store) == undisturbed


def test_the_client_killed(plan, resume, tmp_path):
    store = tmp_path / "store"
    process = start(plan, store)
    wait_for_results(store, process)
    workers = workers_of(process)
    process.kill()
    finish(process)
    _, alive = psutil.wait_procs(workers, timeout=30)
    assert not alive, "workers outlive their client"
    assert resume(store) < 207, "what was done is computed again"


def test_the_scheduler_killed(plan, resume, tmp_path, dask_cluster):
    store = tmp_path / "store"
    scheduler, address = dask_cluster
    process = start(plan, store, "--scheduler", address)
    wait_for_results(store, process)
    scheduler.kill()
    code, _, err = finish(process)
    assert code == 2
    assert "the Dask scheduler is gone; what is done is kept" in err
    assert "Traceback" not in err
    resume(store)


@pytest.mark.parametrize("asked", ["wait_for_workers", "run", "ncores", "submit"])
def test_the_scheduler_killed_while_it_is_asked(plan, tmp_path, dask_cluster, monkeypatch, asked):
    scheduler, address = dask_cluster
    ask = getattr(Client, asked)

    def kill_and_ask(*args, **options):
        scheduler.kill()
        scheduler.wait()
        return ask(*args, **options)

    monkeypatch.setattr(Client, asked, kill_and_ask)
    with pytest.raises(ClusterError, match="the Dask scheduler is gone"):
        campaign.run(campaign.read_plan(plan), tmp_path / "store", scheduler=address)


def test_ctrl_c(plan, resume, tmp_path):
    store = tmp_path / "store"
    process = start(plan, store)
    wait_for_results(store, process)
    workers = workers_of(process)
    os.killpg(process.pid, signal.SIGINT)
    code, _, err = finish(process, timeout=20)
    assert code == 130
    assert "interrupted; what is done is kept in" in err
    assert "Traceback" not in err
    assert not psutil.wait_procs(workers, timeout=10)[1]
    resume(store)


def test_ctrl_c_in_a_script_ends_in_one_line(plan, tmp_path):
    store, script = tmp_path / "store", tmp_path / "study.py"
    script.write_text(
        "from roughline import campaign\n"
        'if __name__ == "__main__":\n'
        f"    campaign.run(campaign.read_plan({str(plan)!r}), {str(store)!r}, workers=1)\n"
    )
    process = subprocess.Popen(
        [sys.executable, str(script)],
        stderr=subprocess.PIPE,
        text=True,
        start_new_session=True,
        preexec_fn=hear_interrupts,
    )
    wait_for_results(store, process)
    os.killpg(process.pid, signal.SIGINT)
    _, _, err = finish(process, timeout=20)
    said = f"KeyboardInterrupt: interrupted; what is done is kept in {store}: run again to go on"
    assert err.splitlines()[-1] == said
    # the line of the script, the check of its arguments, and the call that it made
    assert err.count("File ") == 3, err


def test_interrupts_wait_for_what_must_be_whole():
    done = []

    @interrupts_held_back()
    def interrupted():
        signal.raise_signal(signal.SIGINT)
        done.append(1)

    before = signal.signal(signal.SIGINT, signal.default_int_handler)
    try:
        with pytest.raises(KeyboardInterrupt):
            interrupted()
        assert done == [1]
        signal.signal(signal.SIGINT, signal.SIG_IGN)  # as a shell's background jobs have it
        with interrupts_held_back():
            signal.raise_signal(signal.SIGINT)
        assert signal.getsignal(signal.SIGINT) is signal.SIG_IGN
    finally:
        signal.signal(signal.SIGINT, before)


def test_terminated(plan, resume, tmp_path):
    """What batch systems send when time is up."""
    store = tmp_path / "store"
    process = start(plan, store)
    wait_for_results(store, process)
    process.terminate()
    finish(process, timeout=20)
    resume(store)


def test_files_cut_off(finished, resume, tmp_path):
    """Any chunk, of values, of marks or of coordinates, cut to half or to nothing, or lost."""
    shutil.copytree(finished, tmp_path / "store")
    chunks = sorted(path for path in (tmp_path / "store").rglob("c/**/*") if path.is_file())
    assert len(chunks) > 90
    for i, path in enumerate(chunks[::2]):
        content = path.read_bytes()
        if i % 4 == 3:
            path.unlink()
        else:
            path.write_bytes([content[: len(content) // 2], b"", b"\xff" + content[1:]][i % 4])
    resume(tmp_path / "store")


def test_one_chunk_cut_off_costs_no_more_than_itself(finished, resume, tmp_path):
    store = tmp_path / "store"
    shutil.copytree(finished, store)
    chunk = next(path for path in (store / "surfaces/stiffness").rglob("c/**/*") if path.is_file())
    chunk.write_bytes(chunk.read_bytes()[:-1])
    assert 0 < resume(store) <= 30


def test_a_write_that_was_broken_off(finished, resume, tmp_path):
    """Leftovers of a killed writer, and values whose marks were not written."""
    store = tmp_path / "store"
    shutil.copytree(finished, store)
    (store / "surfaces" / "stiffness" / "c" / "0" / "0" / "0.abc.partial").write_bytes(b"half")
    shutil.rmtree(store / "surfaces" / "case_status" / "c" / "1")
    resume(store)


def test_a_disk_that_is_full(plan, resume, tmp_path):
    """A file system of its own, which somebody else fills up; room is made later."""
    disk = tmp_path / "disk"
    disk.mkdir()
    mount = ["mount", "-t", "tmpfs", "-o", "size=20m", "tmpfs", str(disk)]
    if subprocess.run(mount, capture_output=True, check=False).returncode:
        pytest.skip("no rights to mount a small disk")
    try:
        store = disk / "store"
        process = start(plan, store, "--workers", 1)
        wait_for_results(store, process)
        with contextlib.suppress(OSError), (disk / "filler").open("wb", buffering=0) as filler:
            while True:
                filler.write(bytes(4096))
        code, _, err = finish(process)
        assert code == 2
        assert "No space left on device" in err
        assert "what is done is kept" in err
        assert "Traceback" not in err
        (disk / "filler").unlink()
        resume(store)
    finally:
        subprocess.run(["umount", "-l", str(disk)], check=False)


def test_files_that_may_not_grow(few_plan_file, few_undisturbed, two_workers, tmp_path):
    """The same where no disk can be mounted: the system refuses to write on."""

    def limit():
        signal.signal(signal.SIGXFSZ, signal.SIG_IGN)
        resource.setrlimit(resource.RLIMIT_FSIZE, (1500, 1500))

    store = tmp_path / "store"
    code, _, err = run(few_plan_file, store, "--workers", 1, preexec_fn=limit)
    assert code == 2
    assert "cannot write to" in err
    assert "what is done is kept" in err
    resumed(few_plan_file, few_undisturbed, two_workers, store)


def test_a_script_without_a_guard(few_plan_file, tmp_path):
    script, store = tmp_path / "study.py", tmp_path / "store"
    run = f"campaign.run(campaign.read_plan({str(few_plan_file)!r}), {str(store)!r}, workers=1)\n"
    script.write_text(f"from roughline import campaign\n{run}")
    done = subprocess.run(
        [sys.executable, script], capture_output=True, text=True, timeout=60, check=False
    )
    assert done.returncode == 1
    assert done.stderr.count("Traceback") == 1, done.stderr
    last = done.stderr.splitlines()[-1]
    assert last.endswith('put what it does under `if __name__ == "__main__":`')
    assert not store.exists()
    script.write_text(f'from roughline import campaign\nif __name__ == "__main__":\n    {run}')
    done = subprocess.run(
        [sys.executable, script], capture_output=True, text=True, timeout=120, check=False
    )
    assert (done.returncode, done.stderr) == (0, "")


def test_a_prompt_and_a_notebook(few_plan_file, few_undisturbed, tmp_path):
    """No file to import, and inside a running event loop as in a notebook."""
    script = f"""
import asyncio
from roughline import campaign
async def cell():
    campaign.run(
        campaign.read_plan({str(few_plan_file)!r}), {str(tmp_path / "store")!r}, workers=1
    )
asyncio.run(cell())
"""
    command = [sys.executable, "-c", script]
    done = subprocess.run(command, capture_output=True, text=True, timeout=120, check=False)
    assert (done.returncode, done.stderr) == (0, "")
    assert tree(tmp_path / "store") == few_undisturbed
    done = subprocess.run(
        [sys.executable, "-"], input=script, capture_output=True, text=True, check=False
    )
    assert done.returncode == 1
    assert "cannot start workers, because they must import it: save it in a file" in done.stderr
