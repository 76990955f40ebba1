"""How the server is set up, checked before it starts."""

from __future__ import annotations

import os
import shlex
import stat
from dataclasses import dataclass, field
from ipaddress import IPv4Network, IPv6Network, ip_address, ip_network
from pathlib import Path

from roughline.errors import InputError
from roughline.errors.checks import between, positive, refuse
from roughline.errors.words import called
from roughline.lab.server.budget import LEAST_MEMORY, memory_for_tasks

LEAST_POINTS = 64  # fewest points along a side that a limit may leave
_LONGEST_PASSWORD = 1000  # [bytes]


@dataclass(frozen=True)
class ServerSettings:
    """What the server listens to, and what a session may take."""

    # address to listen to; another than that of this machine itself needs a password
    host: str = "127.0.0.1"
    port: int = 5107  # 0 takes a free one
    password: str | None = None  # asked of every browser; None takes a new token instead
    # proxies that other machines come through, which are believed who comes; if there are any,
    # nobody comes another way
    proxies: tuple[IPv4Network | IPv6Network, ...] = ()
    max_upload: float = 200_000_000  # largest file that is taken [bytes]
    max_points: int = 1024  # largest number of points along a side in the view "Explore"
    max_seconds: float = 600.0  # longest time of one task [s]
    max_memory: float = 4_000_000_000  # most memory of one task, beside the program [bytes]
    # most memory of all tasks together [bytes]
    memory: float = field(default_factory=memory_for_tasks)
    # Most that the files of all sessions may take together; None takes half of what is free, at
    # most 20 GB. [bytes]
    max_disk: float | None = None
    max_sessions: int = 100  # most pages that are open at once

    def __post_init__(self) -> None:
        if not self.host:
            raise InputError("host is empty; give an address, such as 127.0.0.1")
        protect = f"put a password into a file and give it too ({called('password_file')})"
        if not self.is_local and not self.password:
            refuse("host", self.host, f"it lets other machines in: {protect}")
        if self.proxies and not self.password:
            needed = f"through a proxy other machines get in: {protect}"
            refuse("behind_proxy", self.names_of_proxies, needed)
        here = [ip_address("127.0.0.1"), ip_address("::1")]
        if self.proxies and self.is_local and not any(a in p for a in here for p in self.proxies):
            needed = f"proxies on other machines do not reach {self.host}: give an address that"
            needed = f"{needed} they reach too ({called('host')})"
            refuse("behind_proxy", self.names_of_proxies, needed)
        if self.password is not None and len(self.password) < 8:
            raise InputError("the password has fewer than 8 characters; take a longer one")
        between("port", self.port, 0, 65535, "0 (any free one) to 65535 is allowed")
        for name in ("upload", "points", "seconds", "memory", "sessions", "disk"):
            if (limit := getattr(self, f"max_{name}")) is not None:
                positive(f"max_{name}", limit)
        if self.max_points < LEAST_POINTS:
            refuse("max_points", self.max_points, f"at least {LEAST_POINTS} points are needed")
        if self.max_memory < LEAST_MEMORY:
            raise InputError(
                f"{self.max_memory / 1e6:g} MB of memory is too little: give a "
                f"{called('max_memory')} of at least {LEAST_MEMORY / 1e6:g} MB"
            )

    @property
    def lets_others_in(self) -> bool:
        """Whether other machines can reach it, directly or through a proxy."""
        return not self.is_local or bool(self.proxies)

    @property
    def names_of_proxies(self) -> str:
        """The proxies as one writes them."""
        named = (each[0] if each.num_addresses == 1 else each for each in self.proxies)
        return ",".join(map(str, named))

    @property
    def is_local(self) -> bool:
        """Whether it listens to this machine only."""
        try:
            return ip_address(self.host).is_loopback
        except ValueError:
            return self.host == "localhost"


def networks_in(text: str) -> tuple[IPv4Network | IPv6Network, ...]:
    """Read addresses and networks of proxies, separated by commas."""
    needed = "addresses or networks are needed, such as 127.0.0.1 or 10.0.0.0/8,fd00::/8"
    try:
        networks = tuple(ip_network(each.strip(), strict=False) for each in text.split(","))
    except ValueError:
        refuse("behind_proxy", text, needed)
    if any(each.prefixlen == 0 for each in networks):
        refuse("behind_proxy", text, "this trusts everybody: name the proxies, such as 127.0.0.1")
    return networks


def password_in(file: Path) -> str:
    """Read a password: the first line of a file that only its owner may read."""
    password = wrong = ""
    try:
        wrong, start = _checked_start(file)
        first = (start.splitlines() or [b""])[0].strip()
        if len(first) > _LONGEST_PASSWORD:
            wrong = f"at most {_LONGEST_PASSWORD} bytes are a password"
        password = first.decode().strip()
    except (OSError, UnicodeDecodeError) as error:
        why = getattr(error, "strerror", None) or "it is no text"
        wrong = f"it cannot be read ({why}): give a file whose first line is the password"
    if wrong or not password:
        wrong = wrong or "it has no password in its first line: write one there"
        refuse("password_file", str(file), wrong)
    return password


def _checked_start(file: Path) -> tuple[str, bytes]:
    """What is wrong with a file, and else its start.

    It is no file, which is not waited for, or others may read or change it; Windows does not say
    who may.
    """
    modes = os.O_RDONLY | getattr(os, "O_NONBLOCK", 0) | getattr(os, "O_BINARY", 0)
    descriptor = os.open(file, modes)
    try:
        found = os.fstat(descriptor)
        if not stat.S_ISREG(found.st_mode):
            return "it is no file: give one whose first line is the password", b""
        if os.name == "posix" and found.st_uid not in (0, os.geteuid()):
            return "it belongs to somebody else: give a file of your own", b""
        if os.name == "posix" and found.st_mode & 0o077:
            return f"others may read or change it: chmod 600 {shlex.quote(str(file))}", b""
        return "", os.read(descriptor, _LONGEST_PASSWORD + 1)
    finally:
        os.close(descriptor)
