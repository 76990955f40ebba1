"""What the server writes as errors stays small, whatever comes, and tells what it left out."""

import subprocess
import sys
from pathlib import Path

import pytest

pytestmark = pytest.mark.skipif(sys.platform == "win32", reason="files and shells of Unix")

PROGRAM = """
import asyncio, logging, os, random, subprocess, sys, traceback
from roughline.lab.server.bounded_log import bounded_log

def fails(what):
    raise ValueError(what)

async def floods():
    loop = asyncio.get_running_loop()
    for _ in range(200):
        loop.call_soon(fails, random.random())
        asyncio.ensure_future(forgotten())
    await asyncio.sleep(0.05)

async def forgotten():
    fails(os.urandom(8).hex())

with bounded_log():
    for number in range(1000):
        logging.getLogger("tornado.general").error("no room for page %d", number)
    asyncio.run(floods())
    subprocess.run([sys.executable, "-c", "import sys; [print('child', file=sys.stderr)"
                    " for _ in range(100)]; sys.stderr.write('half a line')"])
    logging.error("something else")
    for _ in range(20_000):
        print(random.choice("abc") * random.randrange(500), os.urandom(99), file=sys.stderr)
        os.write(2, os.urandom(50))
print("afterwards", file=sys.stderr)
fails("at the end")
"""


def test_floods_of_errors_are_cut_short_and_counted():
    done = subprocess.run([sys.executable, "-c", PROGRAM], capture_output=True, check=False)
    said = done.stderr.decode(errors="replace")
    assert done.returncode == 1
    assert 10_000 < len(done.stderr) < 250_000
    assert said.count("no room for page") == 5
    assert said.count("Exception in callback fails") == 5
    assert said.count("Task exception was never retrieved") == 5
    assert said.count("in forgotten") == 5
    assert said.count("child\n") == 5
    assert "half a line" in said
    assert "something else\n" in said
    assert "… more than 200 kB within an hour: no more of it\n" in said
    assert said.endswith("ValueError: at the end\n")
    assert said.count("afterwards") == 1


@pytest.mark.parametrize("errors", [None, "/dev/full", "closed"])
def test_what_is_left_out_is_counted_and_a_log_that_takes_nothing_stops_nothing(errors, tmp_path):
    if errors == "/dev/full" and not Path(errors).exists():
        pytest.skip("no such file here")
    lines = (
        "import sys",
        "from roughline.lab.server.bounded_log import bounded_log",
        "with bounded_log():",
        "    for number in range(20_000):",
        "        print('page', number, file=sys.stderr)",
        "print('done')",
    )
    log = Path("/dev/full" if errors == "/dev/full" else tmp_path / "errors.txt")
    command = [sys.executable, "-c", "\n".join(lines)]
    if errors == "closed":
        command = ["sh", "-c", 'exec "$@" 2>&-', "sh", *command]
    with log.open("wb") as written:
        done = subprocess.run(command, stdout=subprocess.PIPE, stderr=written, check=True)
    assert done.stdout.endswith(b"done\n")
    if errors is None:
        *first, last = log.read_text(encoding="utf-8").splitlines()
        assert first == [f"page {number}" for number in range(5)]
        assert last == "… and 19995 more like this: page #"
