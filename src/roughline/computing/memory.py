"""The memory that is free, and the refusal of what needs more."""

from __future__ import annotations

import sys
from collections.abc import Iterator
from contextlib import suppress
from dataclasses import dataclass
from pathlib import Path

import psutil

from roughline.errors import InputError

_USABLE_SHARE = 0.95  # of the memory that is free
_FREE_IN_GROUPS = 2**24  # what control groups always have: to look takes a millisecond [bytes]
_PROCESS_GROUPS = Path("/proc/self/cgroup")  # its control groups, where Linux has them
_GROUPS = Path("/sys/fs/cgroup")
_NAMES = {
    "v1": ("memory.limit_in_bytes", "memory.usage_in_bytes", "total_inactive_file"),
    "v2": ("memory.max", "memory.current", "inactive_file"),
}
"""Of the files with the limit and the use of a group, and of the files that it can drop."""


@dataclass(frozen=True)
class _Limit:
    """What this process may take."""

    memory: int  # in addition to what it held when it was limited [bytes]
    most: int  # in all, as `_held` counts [bytes]


_limit: _Limit | None = None


def free_memory() -> int:
    """Memory that is free on this machine, and in the control groups of this process. [bytes]"""
    return max(0, min([psutil.virtual_memory().available, *_free_in_groups()]))


def limit_process(memory: int) -> None:
    """Let this process take no more memory than it has now and so much in addition.

    What is known to need more is refused. Where the system can, it refuses the rest itself.
    """
    global _limit
    _limit = _Limit(memory, _held() + memory)
    if sys.platform == "linux":
        import resource

        resource.setrlimit(resource.RLIMIT_AS, (_limit.most, _limit.most))


def fits_into_memory(needed: int) -> bool:
    """Return whether this process may take so many bytes of memory."""
    if needed <= _FREE_IN_GROUPS and _limit is None:
        return needed <= _USABLE_SHARE * psutil.virtual_memory().available
    usable = free_memory()
    if _limit is not None:
        usable = min(usable, _limit.most - _held())
    return needed <= _USABLE_SHARE * usable


def refuse_beyond_memory(needed: int, what: str, advice: str) -> None:
    """Refuse work that needs more memory than is free, or than this process may take."""
    if fits_into_memory(needed):
        return
    if _limit is None:
        found = f"and {free_memory() / 1e9:.3g} GB is free"
    elif needed > _USABLE_SHARE * _limit.memory:
        found = f"more than one computation may have here, {_limit.memory / 1e9:.3g} GB"
    else:
        found = "more than is free here just now"
    raise InputError(f"{what} needs about {needed / 1e9:.3g} GB of memory, {found}: {advice}")


def _held() -> int:
    """What this process holds, as the system counts it that limits it. [bytes]"""
    held = psutil.Process().memory_info()
    return int(held.vms if sys.platform == "linux" else held.rss)


def _free_in_groups() -> Iterator[int]:
    """What is free in each control group that limits the memory of this process. [bytes]"""
    for version, folder in _groups():
        with suppress(OSError, ValueError):  # of a group without a limit, which says "max"
            limit, use, droppable = _NAMES[version]
            most = int((folder / limit).read_text())
            stated = dict(map(str.split, (folder / "memory.stat").read_text().splitlines()))
            yield most - int((folder / use).read_text()) + int(stated.get(droppable, 0))


def _groups() -> Iterator[tuple[str, Path]]:
    """Folders of the control groups that this process is in, from its own to the root."""
    lines: list[str] = []
    with suppress(OSError):  # not on Linux
        lines = _PROCESS_GROUPS.read_text().splitlines()
    for line in lines:
        number, controllers, path = line.split(":", 2)
        inner = Path(path.lstrip("/"))
        if "memory" in controllers.split(","):
            version, root = "v1", _GROUPS / "memory"
        elif number == "0" and not controllers:
            version, root = "v2", _GROUPS
        else:
            continue
        for each in (inner, *inner.parents):  # of a container, those outside are not seen
            if (root / each).is_dir():
                yield version, root / each
