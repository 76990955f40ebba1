"""Files that may not grow, as on a full disk: the system refuses to write on."""

import contextlib
import resource
import signal


def shorten_files(size):
    """Let this process write files of so many bytes at most; it is told, and goes on."""
    signal.signal(signal.SIGXFSZ, signal.SIG_IGN)
    resource.setrlimit(resource.RLIMIT_FSIZE, (size, resource.getrlimit(resource.RLIMIT_FSIZE)[1]))


@contextlib.contextmanager
def short_files(size):
    """Write such files within a context."""
    heard, limit = signal.getsignal(signal.SIGXFSZ), resource.getrlimit(resource.RLIMIT_FSIZE)
    shorten_files(size)
    try:
        yield
    finally:
        resource.setrlimit(resource.RLIMIT_FSIZE, limit)
        signal.signal(signal.SIGXFSZ, heard)
