"""Which tests run: all, those that are short, or those that are long; and how long each takes.

That stands in ``durations.json`` and nowhere else; ``make durations`` writes it. A test is short if
it takes at most `SHORT`. Of a test function without such a case the shortest is its representative:
it counts as short, so that every function runs in `make test`. In a file with a walk, a test named
``test_walk...`` that goes through what the others look at one by one, the walk stands for those
that take longer than `WALKED`.
"""

import json
import time
from collections import Counter, defaultdict

import pytest

from reference import DURATIONS, seconds_here, slowness

SHORT = 0.1  # [s] on the machine of the durations
WALKED = 0.5  # [s] there
_TOGETHER = ("campaign/", "paper/", "lab/server/")  # folders whose tests share a cluster or a store
_EACH = 0.01  # that a test takes beside itself [s]
_SLOW = 1.5  # times as long as there, from which on it is said


def durations():
    """Return what each test takes without what it shares, by its node; empty without a file."""
    files = _file().get("tests", {})
    return {
        f"{file}::{test}": seconds
        for file, tests in files.items()
        for test, seconds in tests.items()
    }


def shared_by_files():
    """Return what it takes to make what the tests of a file share, by the file."""
    return _file().get("shared", {})


def _file():
    return json.loads(DURATIONS.read_text("utf-8")) if DURATIONS.is_file() else {}


def short(nodes, taken):
    """Return the nodes that are short, are new, or represent a function without short ones."""
    cases = defaultdict(list)
    for node in nodes:
        cases[node.partition("[")[0]].append(node)
    walked = {function.partition("::")[0] for function in cases if _is_walk(function)}
    chosen = set()
    for function, some in cases.items():
        quick = {node for node in some if taken.get(node, 0) <= SHORT}
        least = min(some, key=lambda node: (taken.get(node, 0), node))
        is_left = function.partition("::")[0] in walked and not _is_walk(function)
        if not quick and not (is_left and taken[least] > WALKED):
            quick = {least}
        chosen |= quick
    return chosen


def _is_walk(function):
    return "::test_walk" in function


def part(nodes, taken, number, of):
    """Return one of some parts that take about as long as each other, in whatever order."""
    sums, parts = [0.0] * of, [set() for _ in range(of)]
    for node in sorted(nodes, key=lambda node: (-taken.get(node, 0), node)):
        least = sums.index(min(sums))
        sums[least] += taken.get(node, 0) + _EACH
        parts[least].add(node)
    return parts[number - 1]


def group_of(node):
    """Return the name of the tests that stay in one process with this one."""
    file = node.partition("::")[0]
    return next((folder for folder in _TOGETHER if file.startswith(folder)), file)


def node_of(item):
    """Return the name of a test, from the folder of the tests on."""
    return item.nodeid.removeprefix("tests/")


def _group_of(item):
    return group_of(node_of(item))


def part_in(text):
    """Read a part, such as 3/12."""
    number, _, of = text.partition("/")
    if not (number.isdecimal() and of.isdecimal() and 1 <= int(number) <= int(of)):
        raise pytest.UsageError(f"--part {text}: give one of some parts, such as 3/12")
    return int(number), int(of)


def pytest_addoption(parser):
    """Take which tests run, and whether it is written how long each takes."""
    group = parser.getgroup("which tests run")
    group.addoption(
        "--tier",
        choices=["all", "short", "long"],
        default="all",
        help="short: what is short, and a representative of what is long; long: all others",
    )
    group.addoption(
        "--part", default="1/1", help="one of some parts of these that take as long, such as 3/12"
    )
    group.addoption(
        "--record", action="store_true", help="write how long each test takes to durations.json"
    )


def pytest_configure(config):
    """Choose tests by how long they take."""
    config.pluginmanager.register(Choice(config))
    if config.option.record:
        config.pluginmanager.register(Record(config))


@pytest.hookimpl(optionalhook=True)
def pytest_xdist_make_scheduler(config, log):
    """Keep the tests of a file in one process, and those of a folder that share what costs much.

    pytest-xdist's own groups are lost from pytest 9.2 on, which lets no test be renamed.
    """
    from xdist.scheduler import LoadScopeScheduling

    class Groups(LoadScopeScheduling):
        def _split_scope(self, nodeid):
            return group_of(nodeid.removeprefix("tests/"))

    config.option.loadscopereorder = False  # what takes longest goes first
    return Groups(config, log)


class Choice:
    """The tests that run, those that take longest first, and a word on those that do not."""

    def __init__(self, config):
        self._config, self._taken = config, durations()
        self._part = part_in(config.option.part)
        self._told = {"all": 0, "left out": 0, "new": 0}

    @pytest.hookimpl(trylast=True)
    def pytest_collection_modifyitems(self, items):
        nodes = {node_of(item) for item in items}
        tier, wanted = self._config.option.tier, nodes
        if tier != "all" and self._taken:
            quick = short(nodes, self._taken)
            wanted = quick if tier == "short" else nodes - quick
        wanted = part(wanted, self._taken, *self._part)
        self._config.hook.pytest_deselected(
            items=[item for item in items if node_of(item) not in wanted]
        )
        self._told = {
            "all": len(nodes),
            "left out": len(nodes - wanted),
            "new": len(wanted - set(self._taken)),
        }
        sums = Counter()
        for file, seconds in shared_by_files().items():
            sums[group_of(file)] += seconds
        for node in sorted(wanted):  # sums of every process are the same to the last bit
            sums[group_of(node)] += self._taken.get(node, 0)
        chosen = [item for item in items if node_of(item) in wanted]
        items[:] = sorted(chosen, key=lambda item: (-sums[_group_of(item)], _group_of(item)))

    def pytest_sessionfinish(self):
        if hasattr(self._config, "workeroutput"):
            self._config.workeroutput["told"] = self._told

    @pytest.hookimpl(optionalhook=True)
    def pytest_testnodedown(self, node):
        self._told = getattr(node, "workeroutput", {}).get("told", self._told)

    def pytest_terminal_summary(self, terminalreporter):
        for line in self._lines(terminalreporter.stats.get("skipped", [])):
            terminalreporter.write_line(line)

    def _lines(self, skipped):
        told, tier = self._told, self._config.option.tier
        name = DURATIONS.name
        if not self._taken:
            yield f"{name} is missing, so that all tests ran: `make durations` writes it"
        elif told["new"]:
            yield f"{told['new']} tests ran that are not in {name}: `make durations` adds them"
        if told["left out"] and tier != "all":
            yield (
                f"left out: {told['left out']} of {told['all']} tests, which are "
                f"{'long' if tier == 'short' else 'short, or in other parts'}; `make full` runs all"
            )
        reasons = Counter(each.longrepr[2].removeprefix("Skipped: ") for each in skipped)
        for reason, count in reasons.most_common():
            yield f"left out: {count} tests: {reason}"
        if self._taken and slowness() > _SLOW:
            yield f"this machine takes {slowness():.1f} times as long as that of {name}"


class Record:
    """What each test takes: without what it shares, of which each file has the sum.

    Since every function runs in `make test`, what tests share is made there anyway. What depends on
    parameters is not: it counts for each test that has them.
    """

    def __init__(self, config):
        self._config = config
        self._made, self._new, self._within = {}, {}, []
        self._taken, self._shared = Counter(), Counter()
        self._skipped, self._collected = set(), []

    @pytest.hookimpl(tryfirst=True)
    def pytest_collection_modifyitems(self, items):
        self._collected = [node_of(item) for item in items]  # those that are not chosen, too

    @pytest.hookimpl(wrapper=True)
    def pytest_fixture_setup(self, fixturedef):
        began = time.perf_counter()
        self._within.append(0.0)
        try:
            return (yield)
        finally:
            whole = time.perf_counter() - began
            own = whole - self._within.pop()
            if self._within:  # one that another asked for
                self._within[-1] += whole
            if fixturedef.scope != "function":
                self._made[fixturedef] = self._new[fixturedef] = own

    @pytest.hookimpl(wrapper=True)
    def pytest_runtest_makereport(self, item, call):
        report = yield
        if call.when == "teardown":
            used = {name: each[-1] for name, each in item._fixtureinfo.name2fixturedefs.items()}
            varied = [each for name, each in used.items() if _is_varied(name, used)]
            report.user_properties += [
                ("made", sum(self._new.values())),
                ("varied", sum(self._made.get(each, 0.0) for each in varied)),
                ("made and varied", sum(self._new.get(each, 0.0) for each in varied)),
            ]
            self._new.clear()
        return report

    def pytest_runtest_logreport(self, report):
        node = report.nodeid.removeprefix("tests/")
        if report.skipped:
            self._skipped.add(node)
        told = dict(report.user_properties)
        made, varied = told.get("made", 0.0), told.get("varied", 0.0)
        self._taken[node] += report.duration - made + varied
        self._shared[node.partition("::")[0]] += made - told.get("made and varied", 0.0)

    def pytest_sessionfinish(self):
        if hasattr(self._config, "workeroutput"):
            self._config.workeroutput["collected"] = self._collected
            return
        ran = set(self._taken) - self._skipped
        write({node: self._taken[node] for node in ran}, self._shared, self._collected)

    @pytest.hookimpl(optionalhook=True)
    def pytest_testnodedown(self, node):
        self._collected = getattr(node, "workeroutput", {}).get("collected", self._collected)


def _is_varied(name, used):
    """Whether a fixture depends on parameters, itself or by what it rests on."""
    made = used.get(name)
    if made is None or made.scope == "function":
        return False
    return made.params is not None or any(_is_varied(each, used) for each in made.argnames)


def write(taken, shared, collected):
    """Write what tests took, in seconds of the machine that the file was first written on.

    What was known stays, but for tests that are gone from the files that were collected.
    """
    factor = 1 / slowness()
    files = {node.partition("::")[0] for node in collected}
    known = {
        node: seconds
        for node, seconds in durations().items()
        if node in collected or node.partition("::")[0] not in files
    }
    known |= {node: round(max(0.0, seconds) * factor, 2) for node, seconds in taken.items()}
    tests = defaultdict(dict)
    for node in sorted(known):
        file, _, test = node.partition("::")
        tests[file][test] = known[node]
    made = {file: seconds for file, seconds in shared_by_files().items() if file not in files}
    made |= {file: round(seconds * factor, 2) for file, seconds in shared.items() if file in files}
    written = {
        "reference": round(seconds_here() * factor, 4),
        "shared": {file: made[file] for file in sorted(made) if made[file]},
        "tests": tests,
    }
    DURATIONS.write_text(f"{json.dumps(written, indent=0)}\n", "utf-8")
