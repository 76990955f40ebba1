"""What all tasks together may take of the memory, and how many of them run at once."""

from __future__ import annotations

from dataclasses import dataclass

from roughline.computing.cores import available_cores
from roughline.computing.memory import free_memory
from roughline.errors import InputError

LEAST_MEMORY = 500_000_000  # of a task that is not quick [bytes]
_USABLE = 0.9  # of the memory that is free when the server starts
_SERVER_BYTES = 500_000_000  # of the server itself and what all processes share [bytes]
_PROCESS_BYTES = 100_000_000  # of each process, beside its task [bytes]
_QUICK_SECONDS, _QUICK_MEMORY = 20.0, 1_000_000_000
_QUICK_SHARE = 1 / 3  # of the memory, where it is scarce
_MOST_SLOW = 20  # processes for tasks that take long, unless there are more cores


@dataclass(frozen=True)
class LaneLimits:
    """What a lane and one task in it may take."""

    count: int  # processes that work side by side; one that takes long lets others start beside it
    most: int  # processes in all
    per_session: int  # processes that work for one page
    seconds: float  # time of a task [s]
    memory: float  # memory of a task, beside the program [bytes]


def memory_for_tasks() -> float:
    """Memory that all tasks together may take, of what is free now. [bytes]"""
    return _USABLE * free_memory() - _SERVER_BYTES


def largest_task_memory(memory: float, wished: float) -> float:
    """Memory of the largest task: what is wished, or less if all together have no more. [bytes]"""
    least_quick = min(_QUICK_MEMORY + _PROCESS_BYTES, _QUICK_SHARE * memory)
    most = memory - least_quick - _PROCESS_BYTES
    if most < LEAST_MEMORY:
        needed = (LEAST_MEMORY + _PROCESS_BYTES) / (1 - _QUICK_SHARE) + _SERVER_BYTES
        raise InputError(
            f"the lab needs {needed / _USABLE / 1e9:.2g} GB of free memory, and there are "
            f"{max(0.0, memory + _SERVER_BYTES) / _USABLE / 1e9:.2g} GB: close other programs"
        )
    return min(wished, most)


def limits_within(
    memory: float, max_memory: float, seconds: float
) -> tuple[LaneLimits, LaneLimits]:
    """Processes for quick tasks, and for the others, whose tasks never take more than a budget."""
    cores = available_cores()
    slow_memory = largest_task_memory(memory, max_memory)
    left = memory - slow_memory - 2 * _PROCESS_BYTES
    quick_memory = min(_QUICK_MEMORY, left)
    left -= quick_memory
    counts = {"quick": 1, "slow": 1}
    needed = {"quick": quick_memory + _PROCESS_BYTES, "slow": slow_memory + _PROCESS_BYTES}
    most = {"quick": 2 * cores + 2, "slow": max(_MOST_SLOW, cores + 1)}
    for name in ("slow", "quick", "quick") * max(most.values()):
        if counts[name] < most[name] and needed[name] <= left:
            counts[name] += 1
            left -= needed[name]
    quick, slow = counts["quick"], counts["slow"]
    return (
        LaneLimits(min(cores, quick), quick, cores, _QUICK_SECONDS, quick_memory),
        LaneLimits(min(cores, slow), slow, 2, seconds, slow_memory),
    )
