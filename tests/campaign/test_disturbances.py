"""Nothing is lost: whatever happens to a campaign, it ends in the bytes of an undisturbed one.

Small campaigns run in this process where that is not the one that is killed, and are disturbed
between two of their batches; larger ones run in a process of their own.
"""

import contextlib
import os
import shutil
import signal
import subprocess
import sys
import time
import traceback
from functools import partial
from math import prod

import psutil
import pytest
from distributed import Client

from reference import patience
from roughline import campaign
from roughline.campaign.cluster import interrupts_held_back
from roughline.campaign.cost import chunk_shape
from roughline.errors import ClusterError
from short_files import short_files, shorten_files
from small_campaign import HELD, finish, hear_interrupts, run, start, tree, with_first_results

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


def cases_of(plan):
    return campaign.read_plan(plan).cases


def wait_for_results(store, process, count=3, ensemble="surfaces"):
    """Wait until some batches are written."""
    chunks = store / ensemble / "case_status" / "c"
    deadline = time.monotonic() + patience()
    while time.monotonic() < deadline and process.poll() is None:
        if sum(path.is_file() for path in chunks.rglob("*")) >= count:
            return
        time.sleep(0.02)
    pytest.fail(f"no results in time: {finish(process)}")


def workers_of(process):
    """Workers of a campaign in a process, which are started by it or forked from one that is."""
    children = psutil.Process(process).children(recursive=True)
    return [child for child in children if is_worker(child, process)]


def is_worker(child, process):
    try:
        command = " ".join(child.cmdline())
        return "spawn_main" in command or ("forkserver" in command and child.ppid() != process)
    except psutil.Error:  # it has just ended
        return False


def kill_a_worker(process):
    deadline = time.monotonic() + patience()
    while not (found := workers_of(process)):
        assert time.monotonic() < deadline, "no worker"
        time.sleep(0.02)
    found[0].kill()


@pytest.fixture
def disturbed(size, plan, invoke, monkeypatch, tmp_path):
    """Run a campaign that is disturbed on its way; its exit code, output and errors."""

    def here(store, disturb, *arguments, at):
        with_first_results(monkeypatch, lambda: disturb(os.getpid()))
        return invoke("campaign", "run", plan, "--store", store, *arguments)

    def there(store, disturb, *arguments, at):
        process = start(plan, store, *arguments, until=tmp_path / "the end")
        for count in at:
            wait_for_results(store, process, count)
            disturb(process.pid)
        (tmp_path / "the end").touch()
        return finish(process)

    return here if size == "few" else there


@pytest.fixture
def begun(size, plan, tmp_path):
    """Start a campaign in a process of its own and wait for results; more are still to come."""

    def with_some_results(store):
        is_small = size == "few"
        process = start(plan, store, *["--workers", 1] * is_small, until=tmp_path / "the end")
        wait_for_results(store, process, *([1, "lines"] if is_small else []))
        return process

    return with_some_results


@pytest.fixture
def interrupts():
    """Hear Ctrl-C, whatever process runs the tests."""
    before = signal.signal(signal.SIGINT, signal.default_int_handler)
    yield
    signal.signal(signal.SIGINT, before)


def test_workers_killed_and_another_campaign_on_the_same_store(
    size, plan, undisturbed, disturbed, tmp_path, invoke
):
    store = tmp_path / "store"

    def disturb(process):
        code, _, err = invoke("campaign", "run", plan, "--store", store)
        assert code == 2
        assert "is in use by another campaign: wait for it to end" in err
        kill_a_worker(process)

    workers = "--workers", 2 if size == "many" else 1  # one of them may wait for the end
    code, out, err = disturbed(store, disturb, *workers, at=(2, 5))
    assert code == 0, err
    assert f"{cases_of(plan)} cases computed, 0 failed" in out
    assert tree(store) == undisturbed


@pytest.mark.parametrize("number", ["SIGKILL", "SIGTERM", "ctrl_c"])
def test_the_client_stopped(plan, resume, begun, tmp_path, number):
    """At once, as batch systems do when time is up, or by Ctrl-C, which its workers get, too."""
    store = tmp_path / "store"
    process = begun(store)
    workers = workers_of(process.pid)
    assert workers
    if number == "ctrl_c":
        os.killpg(process.pid, signal.SIGINT)
        (tmp_path / "the end").touch()
    else:
        process.send_signal(getattr(signal, number))
    code, _, err = finish(process)
    if number == "ctrl_c":
        assert code == 130
        assert "interrupted; what is done is kept in" in err
        assert "Traceback" not in err
    _, alive = psutil.wait_procs(workers, timeout=patience())
    assert not alive, "workers outlive their client"
    done = resume(store)
    assert number == "ctrl_c" or done < cases_of(plan), "what was done is computed again"


@pytest.fixture
def soon_given_up(monkeypatch):
    """Try only shortly to find a scheduler again that is gone, and close patiently."""
    again, close = Client._reconnect, Client.close

    async def shortly(client):
        client._timeout = 0.1
        await again(client)

    # whose own patience is twice that with which it connects
    monkeypatch.setattr(Client, "close", lambda client: close(client, timeout=patience()))
    monkeypatch.setattr(Client, "_reconnect", shortly)


@pytest.mark.usefixtures("soon_given_up")
def test_the_scheduler_killed(resume, disturbed, tmp_path, dask_cluster):
    store = tmp_path / "store"
    scheduler, address = dask_cluster

    def kill(_):
        scheduler.kill()
        scheduler.wait()

    code, _, err = disturbed(store, kill, "--scheduler", address, at=(3,))
    assert code == 2
    assert "the Dask scheduler is gone; what is done is kept" in err
    assert "Traceback" not in err
    resume(store)


@pytest.mark.usefixtures("soon_given_up")
@pytest.mark.parametrize("asked", ["wait_for_workers", "run", "ncores", "submit"])
def test_the_scheduler_killed_while_it_is_asked(
    few_plan_file, tmp_path, dask_cluster, monkeypatch, asked
):
    scheduler, address = dask_cluster
    ask = getattr(Client, asked)

    def kill_and_ask(*args, **options):
        scheduler.kill()
        scheduler.wait()
        return ask(*args, **options)

    monkeypatch.setattr(Client, asked, kill_and_ask)
    with pytest.raises(ClusterError, match="the Dask scheduler is gone"):
        campaign.run(campaign.read_plan(few_plan_file), tmp_path / "store", scheduler=address)


SCRIPT = """{held}
from roughline import campaign
if __name__ == "__main__":
    campaign.run(campaign.read_plan({plan!r}), {store!r}, workers=1)
"""


@pytest.mark.usefixtures("interrupts")
@pytest.mark.parametrize("where", ["here", "there"])
def test_ctrl_c_in_a_script_ends_in_one_line(
    few_plan_file, many_plan_file, two_workers, tmp_path, where
):
    store = tmp_path / "store"
    if where == "here":
        err = interrupted_here(few_plan_file, store, two_workers)
    else:
        err = interrupted_there(many_plan_file, store, tmp_path / "study.py")
    said = f"KeyboardInterrupt: interrupted; what is done is kept in {store}: run again to go on"
    assert err.splitlines()[-1] == said
    # the line of the script, the check of its arguments, and the call that it made
    assert err.count("File ") == 3, err


def interrupted_here(plan, store, address):
    def interrupt(name, done, failed, total):
        if done:
            signal.raise_signal(signal.SIGINT)

    with pytest.raises(KeyboardInterrupt) as caught:
        campaign.run(campaign.read_plan(plan), store, scheduler=address, progress=interrupt)
    return "".join(traceback.format_exception(caught.value))


def interrupted_there(plan, store, script):
    end = script.with_name("the end")
    text = SCRIPT.format(held=HELD.format(end=str(end)), plan=str(plan), store=str(store))
    script.write_text(text)
    process = subprocess.Popen(
        [sys.executable, str(script)],
        stderr=subprocess.PIPE,
        text=True,
        start_new_session=True,
        preexec_fn=hear_interrupts,
    )
    wait_for_results(store, process)
    os.killpg(process.pid, signal.SIGINT)
    end.touch()
    return finish(process)[2]


@pytest.mark.usefixtures("interrupts")
def test_interrupts_wait_for_what_must_be_whole():
    done = []

    @interrupts_held_back()
    def interrupted():
        signal.raise_signal(signal.SIGINT)
        done.append(1)

    with pytest.raises(KeyboardInterrupt):
        interrupted()
    assert done == [1]
    signal.signal(signal.SIGINT, signal.SIG_IGN)  # as a shell's background jobs have it
    with interrupts_held_back():
        signal.raise_signal(signal.SIGINT)
    assert signal.getsignal(signal.SIGINT) is signal.SIG_IGN


def test_files_cut_off(size, finished, resume, tmp_path):
    """Any chunk, of values, of marks or of coordinates, cut to half or to nothing, or lost."""
    shutil.copytree(finished, tmp_path / "store")
    chunks = sorted(path for path in (tmp_path / "store").rglob("c/**/*") if path.is_file())
    assert len(chunks) > {"few": 20, "many": 90}[size]
    for i, path in enumerate(chunks[::2]):
        content = path.read_bytes()
        if i % 4 == 3:
            path.unlink()
        else:
            path.write_bytes([content[: len(content) // 2], b"", b"\xff" + content[1:]][i % 4])
    resume(tmp_path / "store")


def test_one_chunk_cut_off_costs_no_more_than_itself(plan, finished, resume, tmp_path):
    store = tmp_path / "store"
    surfaces = campaign.read_plan(plan).ensemble("surfaces")
    shutil.copytree(finished, store)
    chunk = next(path for path in (store / "surfaces/stiffness").rglob("c/**/*") if path.is_file())
    chunk.write_bytes(chunk.read_bytes()[:-1])
    assert 0 < resume(store) <= prod(chunk_shape(surfaces)) < 30


def test_a_write_that_was_broken_off(finished, resume, tmp_path):
    """Leftovers of a killed writer, and values whose marks were not written."""
    store = tmp_path / "store"
    shutil.copytree(finished, store)
    (store / "surfaces" / "stiffness" / "c" / "0" / "0" / "0.abc.partial").write_bytes(b"half")
    shutil.rmtree(sorted((store / "surfaces" / "case_status" / "c").iterdir())[-1])
    resume(store)


def test_a_disk_that_is_full(resume, disturbed, tmp_path):
    """A file system of its own, which somebody else fills up; room is made later."""
    disk = tmp_path / "disk"
    disk.mkdir()
    mount = ["mount", "-t", "tmpfs", "-o", "size=20m", "tmpfs", str(disk)]
    if subprocess.run(mount, capture_output=True, check=False).returncode:
        pytest.skip("no rights to mount a small disk")

    def fill(_):
        with contextlib.suppress(OSError), (disk / "filler").open("wb", buffering=0) as filler:
            while True:
                filler.write(bytes(4096))

    try:
        store = disk / "store"
        code, _, err = disturbed(store, fill, "--workers", 1, at=(3,))
        assert code == 2
        assert "No space left on device" in err
        assert "what is done is kept" in err
        assert "Traceback" not in err
        (disk / "filler").unlink()
        resume(store)
    finally:
        subprocess.run(["umount", "-l", str(disk)], check=False)


@pytest.mark.parametrize("where", ["here", "there"])
def test_files_that_may_not_grow(
    few_plan_file, few_undisturbed, two_workers, invoke, tmp_path, where
):
    """The same where no disk can be mounted: the system refuses to write on."""
    store = tmp_path / "store"
    if where == "here":
        with short_files(1500):
            code, _, err = invoke(
                "campaign", "run", few_plan_file, store=store, scheduler=two_workers
            )
    else:
        code, _, err = run(
            few_plan_file, store, "--workers", 1, preexec_fn=partial(shorten_files, 1500)
        )
    assert code == 2
    assert "cannot write to" in err
    assert "what is done is kept" in err
    resumed(few_plan_file, few_undisturbed, two_workers, store)


def test_a_script_without_a_guard(few_plan_file, tmp_path):
    script, store = tmp_path / "study.py", tmp_path / "store"
    guarded = SCRIPT.format(held="", plan=str(few_plan_file), store=str(store))
    script.write_text(guarded.replace('__name__ == "__main__"', "True"))
    done = ended([sys.executable, script])
    assert done.returncode == 1
    assert done.stderr.count("Traceback") == 1, done.stderr
    last = done.stderr.splitlines()[-1]
    assert last.endswith('put what it does under `if __name__ == "__main__":`')
    assert not store.exists()


CELL = """
import asyncio
from roughline import campaign
async def cell():
    campaign.run(campaign.read_plan({plan!r}), {store!r}, workers=1)
asyncio.run(cell())
"""


@pytest.mark.parametrize("where", ["cell", "script"])
def test_a_notebook_and_a_script_with_a_guard(few_plan_file, few_undisturbed, tmp_path, where):
    """Without a file to import, inside a running event loop; and from a file that is imported."""
    texts = {"cell": CELL, "script": SCRIPT}
    text = texts[where].format(held="", plan=str(few_plan_file), store=str(tmp_path / "store"))
    (tmp_path / "study.py").write_text(text)
    done = ended([sys.executable, *(["-c", text] if where == "cell" else [tmp_path / "study.py"])])
    assert (done.returncode, done.stderr) == (0, "")
    assert tree(tmp_path / "store") == few_undisturbed


def test_a_program_from_standard_input_is_refused(few_plan_file, tmp_path):
    text = CELL.format(plan=str(few_plan_file), store=str(tmp_path / "store"))
    done = ended([sys.executable, "-"], input=text)
    assert done.returncode == 1
    assert "cannot start workers, because they must import it: save it in a file" in done.stderr


def ended(command, **options):
    return subprocess.run(
        command, capture_output=True, text=True, timeout=patience(), check=False, **options
    )
