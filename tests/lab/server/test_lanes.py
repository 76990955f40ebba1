"""Lanes of processes: what is served, replaced, stopped and survived."""

import asyncio
import sys
import threading
from contextlib import asynccontextmanager

import psutil
import pytest

from lab.server import doings
from lab.server.serving import alive_still, becomes
from reference import patience
from roughline.lab.server import lanes
from roughline.lab.server import process as processes
from roughline.lab.server.lanes import Lane, Request
from roughline.lab.server.tasks import without_paths
from roughline.lab.tasks import warm_up

pytestmark = pytest.mark.skipif(sys.platform == "win32", reason="signals of Unix")
LONG = 3600.0  # which nothing here takes [s]
COUNT, MEMORY = 2, 1e9  # of processes, and of each [bytes]
SESSION = {
    "folder": "/tmp/roughline-lab-1/3F9r-token",
    "names": {"/tmp/roughline-lab-1/3F9r-token/0123.txt": "my file.txt"},
}


class Asker:
    """Asks a lane, and keeps what comes back."""

    def __init__(self, lane):
        self.lane, self.outcomes, self.steps = lane, {}, {}

    def ask(self, task, slot="slot", session="session", name=None, **arguments):
        """Ask for a task of :mod:`doings`."""
        name = name or slot
        self.lane.submit(
            Request(
                session,
                slot,
                doings.place_of(task),
                {"session": SESSION, **arguments},
                lambda outcome: self.outcomes.setdefault(name, outcome),
                lambda *steps: self.steps.setdefault(name, []).append(steps),
            )
        )

    async def of(self, name):
        """The outcome of a question, when it is there."""
        await becomes(lambda: name in self.outcomes)
        return self.outcomes[name]

    async def begun(self, name):
        """Wait until a question is being answered."""
        await becomes(lambda: name in self.steps)


def pids(lane):
    """Numbers of the processes of a lane in the system."""
    busy = [request.process for request in lane._served if request.process is not None]
    running = [each._process for each in (*lane._idle, *busy)]
    return [process.pid for process in running if process is not None]


@pytest.fixture(scope="module", autouse=True)
def _doings():
    """Let processes do the tasks of :mod:`doings`, forked from one that has loaded the lab."""
    processes.start_forking(warm_up, preloaded="roughline.lab.warm")
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(processes, "_serve", doings.serve)
        yield


@asynccontextmanager
async def laned(*, lasting, count=COUNT, memory=MEMORY):
    """Who asks a lane, of which nothing is left then."""
    lane = Lane(count, memory, lasting=lasting)
    try:
        async with asyncio.timeout(patience()):
            yield Asker(lane)
    finally:
        left = pids(lane)
        await lane.close()
    await becomes(lambda: not any(psutil.pid_exists(pid) for pid in left))


@pytest.mark.parametrize("lasting", [True, False])
async def test_what_reads_no_file_shares_processes_until_they_are_renewed(lasting):
    async with laned(lasting=lasting) as asker:

        async def used(name, task="echo"):
            asker.ask(task, slot=name, say=name)
            said, pid = (await asker.of(name)).answer.split()
            assert said == name.encode()
            return int(pid)

        shared = set()
        for number in range(6):
            shared.add(pid := await used(str(number)))
            await becomes(lambda pid=pid: pid in pids(asker.lane))  # it stands by again
        assert len(shared) <= COUNT
        asker.lane.renew()
        assert await used("renewed") not in shared
        if not lasting:
            assert len({await used(f"read{number}", "read") for number in range(6)}) == 6


@pytest.mark.parametrize(
    ("task", "sentence", "at"),
    [
        ("fail", "for a reason that the lab does not know", ""),
        ("refuse", "cannot read my file.txt", ""),
        ("refuse_at", "too rough", "h"),
        ("die", "ended unexpectedly", ""),
        ("take_memory", "more memory than one page may have", ""),
        ("need_memory", "more than one computation may have here, 1 GB: take less", ""),
        ("fail_to_open", "could not be read or written (No such file or directory): ask", ""),
        ("cannot be sent", "ended unexpectedly", ""),
    ],
)
async def test_what_goes_wrong_is_one_sentence_and_the_next_question_is_answered(
    task, sentence, at
):
    for lasting in (True, False):
        async with laned(lasting=lasting) as asker:
            asker.ask(task, bytes=3_000_000_000 if task in vars(doings) else lambda: None)
            outcome = await asker.of("slot")
            assert outcome.answer is None
            assert sentence in outcome.error
            assert outcome.at == at
            assert "/" not in outcome.error
            asker.ask("echo", slot="next", say="next")
            assert (await asker.of("next")).answer.startswith(b"next")


async def test_progress_is_told_until_the_answer():
    async with laned(lasting=False) as asker:
        asker.ask("sleep", seconds=0.1)
        assert (await asker.of("slot")).answer == b"slept"
        assert asker.steps["slot"][-1] == (100, 100)


async def test_the_latest_question_wins_and_those_replaced_leave_nothing_behind():
    async with laned(lasting=False) as asker:
        asker.ask("echo", name="first", say="")
        await asker.of("first")
        await asker.lane.prepare()
        me = psutil.Process()
        before, threads_before = me.num_fds(), threading.active_count()
        for number in range(100):
            asker.ask("sleep", name=f"replaced {number}", seconds=LONG)
            await asyncio.sleep(0.005)
        asker.ask("echo", name="last", say="last")
        assert (await asker.of("last")).answer.startswith(b"last")
        assert list(asker.outcomes) == ["first", "last"]
        await becomes(lambda: len(pids(asker.lane)) <= 2 and not asker.lane._served)
        await becomes(lambda: me.num_fds() <= before + 8)
        assert threading.active_count() <= threads_before + 2 * COUNT + 2


async def test_a_lasting_process_answers_while_a_slider_moves(tmp_path):
    """The one that runs and the last one are answered; those between are replaced."""
    async with laned(lasting=True) as asker:
        asker.ask("last", name="first", until=str(tmp_path / "end"))
        await asker.begun("first")
        for number in range(20):
            asker.ask("echo", name=number, say=number)
        (tmp_path / "end").touch()
        await asker.of(19)
        assert list(asker.outcomes) == ["first", 19]


@pytest.mark.parametrize("lasting", [True, False])
async def test_a_withdrawn_question_is_not_answered_and_a_new_one_in_its_place_is(
    lasting, tmp_path
):
    async with laned(lasting=lasting) as asker:
        asker.ask("last", name="withdrawn", until=str(tmp_path / "first"))
        await asker.begun("withdrawn")
        asker.lane.withdraw("session", "slot")
        asker.ask("last", name="new", until=str(tmp_path / "second"))
        await asker.begun("new")
        (tmp_path / "first").touch()
        await becomes(lambda: len(asker.lane._served) == 1)
        (tmp_path / "second").touch()
        assert (await asker.of("new")).answer == b"lasted"
        assert list(asker.outcomes) == ["new"]


async def test_a_stopped_task_frees_its_core(tmp_path):
    async with laned(lasting=False) as asker:
        mark = tmp_path / "mark"
        asker.ask("compute", mark=str(mark))
        await becomes(lambda: mark.exists() and mark.read_text())
        pid = int(mark.read_text())
        asker.lane.withdraw("session")
        await becomes(lambda: not psutil.pid_exists(pid))
        assert not asker.outcomes


async def test_the_process_that_forks_has_one_thread():
    """A fork waits for the threads of the transforms, which may not end."""
    if not processes._FORKS:
        pytest.skip("nothing forks here")
    from multiprocessing import forkserver

    async with laned(lasting=False) as asker:
        await asker.lane.prepare()
        asker.ask("echo", say="alive")
        await asker.of("slot")
        assert psutil.Process(forkserver._forkserver._forkserver_pid).num_threads() == 1


@pytest.mark.parametrize("lasting", [True, False])
async def test_a_question_in_the_place_of_one_that_waits_keeps_its_turn(lasting):
    async with laned(lasting=lasting, count=1) as asker:
        asker.ask("echo", name="first", session="a", say="first")
        for name, session in (("replaced", "b"), ("last", "c"), ("new", "b")):
            asker.ask("echo", name=name, session=session, say=name)
        await asker.of("last")
        assert list(asker.outcomes) == ["first", "new", "last"]


@pytest.mark.parametrize("lasting", [True, False])
@pytest.mark.parametrize("lost", ["those that stand by", "the one that forks"])
async def test_the_loss_of_processes_is_survived(lasting, lost):
    from multiprocessing import forkserver

    async with laned(lasting=lasting) as asker:
        await asker.lane.prepare()
        before = killed = [psutil.Process(pid) for pid in pids(asker.lane)]
        if lost == "the one that forks":  # with which those that it forked end
            killed = [psutil.Process(forkserver._forkserver._forkserver_pid)]
        for each in killed:
            each.kill()
        await becomes(lambda: not any(map(alive_still, killed)))
        for number in range(4):
            asker.ask("echo", slot=f"{number}", say="alive")
            assert (await asker.of(f"{number}")).answer.startswith(b"alive")
        await asker.lane.prepare()
        await becomes(lambda: not any(map(alive_still, before)) and len(pids(asker.lane)) == COUNT)


async def test_an_answer_is_read_to_its_end_while_its_request_is_withdrawn():
    class Slow:
        """A connection from which an answer is read slowly."""

        def __init__(self, connection):
            self.connection, self.was_closed = connection, None

        def __getattr__(self, name):
            return getattr(self.connection, name)

        def recv(self):
            said = self.connection.recv()
            begun.set()
            assert stopped.wait(patience())
            self.was_closed = self.connection.closed
            return said

    begun, stopped = threading.Event(), threading.Event()

    async with laned(lasting=False) as asker:
        asker.ask("sleep", seconds=LONG)
        await asker.begun("slot")
        (request,) = asker.lane._served
        slow = request.process._connection = Slow(request.process._connection)
        assert await asyncio.to_thread(begun.wait, patience())
        process = psutil.Process(request.process._process.pid)
        withdrawn = asker.lane.withdraw("session")
        await becomes(lambda: not alive_still(process))
        stopped.set()
        await asyncio.gather(*withdrawn)
        assert slow.was_closed is False
        assert slow.connection.closed
        assert not psutil.pid_exists(process.pid)
        assert not asker.outcomes


async def test_no_process_to_be_had_is_one_sentence(monkeypatch):
    told = []

    def refuse(*arguments, **options):
        raise BlockingIOError(11, "no more processes")

    async with laned(lasting=False) as asker:
        monkeypatch.setattr(processes.Process, "_begin", refuse)
        monkeypatch.setattr(lanes._log, "exception", lambda *_: told.append(str(sys.exception())))
        asker.ask("echo", say="alive")
        assert "ended unexpectedly" in (await asker.of("slot")).error
        monkeypatch.undo()
        asker.ask("echo", slot="next", say="alive")
        assert (await asker.of("next")).answer.startswith(b"alive")
    assert len(told) == 1
    assert "no more processes" in told[0]


async def test_without_forking_processes_are_spawned(monkeypatch):
    import multiprocessing

    monkeypatch.setattr(processes, "_CONTEXT", multiprocessing.get_context("spawn"))

    async with laned(lasting=True, count=1, memory=2e9) as asker:
        asker.ask("echo", say="spawned")
        assert (await asker.of("slot")).answer.startswith(b"spawned")


def test_names_stand_for_paths_in_sentences():
    arguments = {"session": {"names": {"/tmp/lab/abc/0123.txt": "mine.txt"}}}
    said = without_paths("cannot read /tmp/lab/abc/0123.txt: 0123.txt is empty", arguments)
    assert said == "cannot read mine.txt: mine.txt is empty"
    arguments = {"session": {"names": {r"C:\lab\abc\0123.txt": "mine.txt"}}}
    assert without_paths("0123.txt is empty", arguments) == "mine.txt is empty"
