"""A lab of its own process, and the pages that a headless browser opens of it."""

import contextlib
import re
import selectors
import shutil
import signal
import subprocess
import sys
import time
from urllib.parse import urlsplit

from reference import patience

WANTED = (
    "no Chromium: install Debian's (apt-get install chromium), or `playwright install chromium`"
)
NO_LINE = r"ERR_|WebSocket|Failed to load"  # what a browser says of a line that drops
_ARGUMENTS = ("--no-sandbox", "--disable-gpu")  # root has no sandbox, and pictures must not differ
_OWN = ("data:", "blob:", "about:")


def chromium_of(playwright):
    """Return the path of a Chromium, of the system or Playwright's own; None if there is none."""
    for name in ("chromium", "chromium-browser"):
        if path := shutil.which(name):
            return path
    own = playwright.chromium.executable_path
    return own if shutil.which(own) else None


def launched(playwright):
    """Start a headless Chromium."""
    return playwright.chromium.launch(
        executable_path=chromium_of(playwright), args=list(_ARGUMENTS), headless=True
    )


class Chromium:
    """A headless Chromium that is started when it is asked for, and stays.

    Meanwhile Playwright's loop runs in this thread, so that no test can run one of its own.
    """

    def __init__(self):
        self._playwright = self._browser = None

    def started(self):
        """Return it; None where there is none to start."""
        if self._browser is not None and self._browser.is_connected():
            return self._browser
        self.close()
        from playwright.sync_api import sync_playwright  # which is not everywhere

        self._playwright = sync_playwright().start()
        if chromium_of(self._playwright) is None:
            self.close()
            return None
        self._browser = launched(self._playwright)
        return self._browser

    def close(self):
        """Close it, if it is open; it can be started again."""
        if self._playwright is not None:
            self._playwright.stop()
        self._playwright = self._browser = None


class RunningLab:
    """A lab on a free port of this machine.

    Attributes
    ----------
    address : str
        Of its page, with the token.
    process : Popen
        Its server.
    seconds_to_open : float
        From its start until it said its address. [s]
    """

    def __init__(self, log, *arguments, program=("-m", "roughline"), **options):
        self._log = log.open("w+b")
        command = [sys.executable, *program, "lab", "--no-browser", "--port", "0", *arguments]
        started = time.perf_counter()
        self.process = subprocess.Popen(
            command, stdout=subprocess.PIPE, stderr=self._log, **options
        )
        line = _first_line(self.process.stdout)
        self.seconds_to_open = time.perf_counter() - started
        found = re.search(rb"http://\S+", line)
        if found is None:
            self.process.kill()
            self.close()
            raise TimeoutError(f"the lab does not start: {line!r} {log.read_text()}")
        self.address = found[0].decode()

    def close(self, stop=signal.SIGINT):
        """Stop it by Ctrl-C; returns its exit code, and what it wrote to the terminal as errors."""
        with contextlib.suppress(ProcessLookupError):
            self.process.send_signal(stop)
        try:
            code = self.process.wait(patience())
        finally:
            self.process.kill()
            self.process.wait()
            self.process.stdout.close()
        self._log.seek(0)
        said = self._log.read().decode(errors="replace")
        self._log.close()
        return code, said


def _first_line(stream):
    """Return the first line of a stream, or what came of it in time."""
    with selectors.DefaultSelector() as ready:
        ready.register(stream, selectors.EVENT_READ)
        return stream.readline() if ready.select(patience()) else b""


class Pages:
    """Pages of a lab, each with a browser profile of its own, and what they complain of.

    Attributes
    ----------
    address : str
        Of the page, without the token; each profile is logged in.
    complaints : list of str
        Warnings and errors on the console, errors of scripts, refusals of the content security
        policy, and requests that leave the machine.
    """

    def __init__(self, browser, address):
        self._browser, self._opened = browser, address
        self._host = urlsplit(address).netloc
        self.address = f"{urlsplit(address).scheme}://{self._host}/"
        self._contexts = []
        self.complaints = []

    def open(self, query="", *, width=1600, height=1100, theme="light", **context):
        """Open a page of the lab; `query` is what follows its address."""
        page = self.blank(width=width, height=height, theme=theme, **context)
        page.goto(self.address + query)
        return page

    def blank(self, *, width=1600, height=1100, theme="light", **context):
        """Open an empty page, which is listened to."""
        made = self._browser.new_context(
            viewport={"width": width, "height": height},
            color_scheme=theme,
            accept_downloads=True,
            **context,
        )
        made.set_default_timeout(1000 * patience())
        made.request.get(self._opened)  # which logs its pages in
        self._contexts.append(made)
        made.on("console", self._console)
        made.on("weberror", lambda told: self.complaints.append(f"of a script: {told.error}"))
        made.on("request", lambda request: self._request(request.url))
        made.on("page", lambda page: page.on("websocket", lambda each: self._request(each.url)))
        return made.new_page()

    def close(self):
        """Close all of them."""
        while self._contexts:
            self._contexts.pop().close()

    @contextlib.contextmanager
    def expecting(self, pattern):
        """Let complaints pass that match a pattern; one at least must come."""
        before, self.complaints = self.complaints, []
        yield
        end = time.monotonic() + patience()
        while not any(re.search(pattern, each) for each in self.complaints):
            assert time.monotonic() < end, self.complaints
            self._contexts[-1].pages[0].wait_for_timeout(20)  # in which a page may tell
        came, self.complaints = self.complaints, before
        self.complaints += [each for each in came if not re.search(pattern, each)]

    def _console(self, message):
        if message.type in ("warning", "error"):
            self.complaints.append(f"console: {message.text} ({message.location.get('url')})")

    def _request(self, url):
        if not url.startswith(_OWN) and urlsplit(url).netloc != self._host:
            self.complaints.append(f"a request leaves for {url}")
