"""How the lab starts, refuses to, and ends."""

import asyncio
import gc
import json
import os
import signal
import socket
import subprocess
import sys

import psutil
import pytest

from lab.server.serving import alive_still, running_lab, upload, wait_until
from reference import patience
from roughline.lab.server.process import noted_interrupts

pytestmark = pytest.mark.skipif(sys.platform == "win32", reason="signals of Unix")
LEFT_SOCKETS = pytest.mark.filterwarnings(  # Tornado leaves those that it cannot bind unclosed
    "ignore:Exception ignored in. <socket:pytest.PytestUnraisableExceptionWarning",
    "ignore:unclosed <socket:ResourceWarning",
)


def stopped_with_pages_open(lab, stop):
    """Stop a lab by a signal while it computes for a page."""

    async def scenario():
        async with lab.page() as page:
            await upload(lab, page.token, b"1 2\n", "a.txt")
            await page.ask("explore.curve", state={"n": "512"})
            said = json.loads(await page.heard())  # what follows within a moment is not told
            assert 0 < said["done"] < said["total"]
            children = psutil.Process(lab.process.pid).children(recursive=True)
            lab.process.send_signal(stop)
            while await page.heard() is not None:
                pass
        lab.process.wait(patience())
        wait_until(lambda: not any(child.is_running() for child in children))

    asyncio.run(scenario())
    assert lab.process.returncode == 0
    assert lab.process.stdout.read() == b"The lab is closed.\n"
    for word in ("Task was", "never retrieved", "KeyboardInterrupt", "ignored", "tornado"):
        assert word not in lab.log.read_text()
    assert not list(lab.temporary.glob(f"roughline-lab-{lab.process.pid}-*"))


@pytest.mark.parametrize("stop", [signal.SIGINT, signal.SIGTERM], ids=["ctrl_c", "SIGTERM"])
def test_what_a_killed_server_leaves_is_removed_by_the_next_which_stops_with_pages_open(
    tmp_path, stop
):
    with running_lab(temporary=tmp_path, closes=False) as lab:
        children = psutil.Process(lab.process.pid).children(recursive=True)
        left = lab.folder
    wait_until(lambda: not any(alive_still(child) for child in children))
    assert left.is_dir()
    others = tmp_path / "roughline-lab-mine"
    others.mkdir()
    (tmp_path / "roughline-lab-999999-linked").symlink_to(others)
    with running_lab(temporary=tmp_path) as lab:
        assert not left.exists()
        stopped_with_pages_open(lab, stop)
    assert others.is_dir()


@LEFT_SOCKETS
@pytest.mark.parametrize(
    ("options", "said"),
    [
        (("--host", ""), '--host is ""; give a value'),
        (("--host", "192.0.2.1"), "cannot listen on 192.0.2.1"),
        (("--host", "no.such.invalid"), "no address of this machine"),
        (("--port", "70000"), "--port is 70000"),
        (("--address", "lab.example.org"), '--address is "lab.example.org"; the address of the'),
    ],
)
def test_options_that_make_no_sense_are_one_line(invoke, options, said):
    assert_one_line(invoke, options, said)


def assert_one_line(invoke, options, *said):
    code, out, errors = invoke("lab", "--no-browser", *options)
    gc.collect()
    assert code == 2
    assert out == ""
    assert all(each in errors for each in said)
    assert errors.count("\n") == 1


@LEFT_SOCKETS
def test_a_port_that_is_taken_is_one_line(invoke):
    with socket.create_server(("127.0.0.1", 0)) as taken:
        port = str(taken.getsockname()[1])
        assert_one_line(invoke, ("--port", port), f"port {port} (", "another --port")


@pytest.mark.parametrize("moment", ["forking", "folder"])
def test_ctrl_c_before_it_is_up_ends_it_quietly(moment, tmp_path):
    """In a terminal it reaches all processes of the lab at once."""
    command = [sys.executable, "-m", "roughline", "lab", "--no-browser", "--port", "0"]
    with subprocess.Popen(
        command,
        stdout=subprocess.PIPE,
        stderr=subprocess.STDOUT,
        text=True,
        env=os.environ | {"TMPDIR": str(tmp_path), "PYTHONFAULTHANDLER": "1"},
        start_new_session=True,
    ) as process:
        if moment == "forking":
            wait_until(psutil.Process(process.pid).children)
        else:
            wait_until(lambda: list(tmp_path.glob("roughline-lab-*")))
        os.killpg(process.pid, signal.SIGINT)
        try:
            said = process.communicate(timeout=patience())[0]
        except subprocess.TimeoutExpired:
            process.send_signal(signal.SIGABRT)  # it says where it waits
            pytest.fail(process.communicate(timeout=patience())[0])
    assert "KeyboardInterrupt" not in said
    assert "Task" not in said
    assert not list(tmp_path.glob("roughline-lab-*"))


def test_ctrl_c_while_modules_are_loaded_is_not_lost():
    """Python ignores what is raised in the calls that it makes itself then."""
    before = signal.getsignal(signal.SIGINT)
    with noted_interrupts() as interrupted:
        assert not interrupted()
        signal.raise_signal(signal.SIGINT)
        assert interrupted()
    assert signal.getsignal(signal.SIGINT) is before
