"""The memory that is free: of the machine, of control groups, and of a process with a limit."""

from types import SimpleNamespace

import pytest

import roughline as rl
from roughline.computing import memory


@pytest.fixture
def machine(tmp_path, monkeypatch):
    """A machine with 20 GB that are free, and no control groups yet."""
    free = SimpleNamespace(available=20e9)
    monkeypatch.setattr(memory.psutil, "virtual_memory", lambda: free)
    monkeypatch.setattr(memory, "_PROCESS_GROUPS", tmp_path / "cgroup")
    monkeypatch.setattr(memory, "_GROUPS", tmp_path / "groups")
    return tmp_path


def group(folder, *, names, limit, use, droppable, stat):
    folder.mkdir(parents=True, exist_ok=True)
    (folder / names[0]).write_text(f"{limit}\n")
    (folder / names[1]).write_text(f"{use}\n")
    (folder / "memory.stat").write_text(f"anon 7\n{stat} {droppable}\n")


def test_a_container_may_take_what_its_control_group_leaves(machine):
    assert memory.free_memory() == 20e9
    new = {"names": ("memory.max", "memory.current"), "stat": "inactive_file"}
    (machine / "cgroup").write_text("0::/outer/inner\n")
    group(machine / "groups/outer/inner", limit="max", use=10, droppable=0, **new)
    assert memory.free_memory() == 20e9
    group(machine / "groups/outer", limit=int(3e9), use=int(2e9), droppable=int(5e8), **new)
    assert memory.free_memory() == 1.5e9
    group(machine / "groups/outer", limit=int(3e9), use=int(4e9), droppable=0, **new)
    assert memory.free_memory() == 0
    with pytest.raises(rl.InputError, match="needs about 1 GB of memory, and 0 GB is free: rest"):
        memory.refuse_beyond_memory(10**9, "this", "rest")


def test_control_groups_of_older_systems_count_too(machine):
    old = {
        "names": ("memory.limit_in_bytes", "memory.usage_in_bytes"),
        "stat": "total_inactive_file",
    }
    (machine / "cgroup").write_text("4:cpu,memory:/docker/not/seen/inside\n0::/\n")
    group(machine / "groups/memory", limit=int(2e9), use=int(1e9), droppable=int(2e8), **old)
    assert memory.free_memory() == 1.2e9


def test_a_process_with_a_limit_tells_it_and_nothing_of_the_machine(machine, monkeypatch):
    monkeypatch.setattr(memory, "_held", lambda: 3e9)
    monkeypatch.setattr(memory, "_limit", memory._Limit(int(4e9), int(6e9)))
    assert memory.fits_into_memory(int(2.8e9))  # 1 GB of the 4 GB is held already
    for needed, found in (
        (162e9, "about 162 GB of memory, more than one computation may have here, 4 GB: rest"),
        (3.5e9, "about 3.5 GB of memory, more than is free here just now: rest"),
    ):
        with pytest.raises(rl.InputError, match=found):
            memory.refuse_beyond_memory(int(needed), "this", "rest")
