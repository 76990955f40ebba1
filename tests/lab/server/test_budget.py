"""Memory and disk of the server: what all tasks and files together may take, and a full disk."""

import json
import subprocess
import sys
from contextlib import suppress

import pytest

import roughline as rl
from lab.server.serving import lab_here, run, running_lab, upload
from roughline.lab.server import budget
from roughline.lab.server.budget import largest_task_memory, limits_within
from roughline.lab.server.files import Disk, Files
from roughline.lab.server.settings import ServerSettings

pytestmark = pytest.mark.skipif(sys.platform == "win32", reason="signals of Unix")
GB = 1e9
HEIGHTS = b"1 2 4 1\n3 1 2 2\n5 4 6 2\n2 1 4 7\n"


@pytest.mark.parametrize("cores", [1, 2, 8, 64])
@pytest.mark.parametrize("memory", [1.0, 1.4, 2.5, 4.0, 9.4, 20.7, 60.0, 500.0])
@pytest.mark.parametrize("wished", [0.5, 4.0, 30.0])
def test_tasks_that_run_at_once_never_have_more_memory_than_there_is(
    cores, memory, wished, monkeypatch
):
    monkeypatch.setattr(budget, "available_cores", lambda: cores)
    quick, slow = limits_within(memory * GB, wished * GB, 600.0)
    both = sum(each.most * each.memory for each in (quick, slow))
    assert both < memory * GB
    assert both > 0.4 * memory * GB or (quick.most, slow.most) == (
        2 * cores + 2,
        max(20, cores + 1),
    )
    assert slow.memory == largest_task_memory(memory * GB, wished * GB) <= wished * GB
    assert slow.memory == wished * GB or slow.memory > 0.55 * memory * GB
    for each in (quick, slow):
        assert 1 <= each.count <= min(cores, each.most)
        assert each.memory > 0.2 * GB


def test_a_machine_without_memory_for_one_task_is_told_so():
    with pytest.raises(rl.InputError, match=r"needs 1.6 GB of free memory, and there are 0.67 GB"):
        largest_task_memory(0.1 * GB, 4 * GB)


def test_a_small_machine_starts_with_less_for_one_task(monkeypatch, capsys):
    from roughline.cli.lab import lab as start

    started = []
    monkeypatch.setattr(budget, "free_memory", lambda: 1.8 * GB)
    monkeypatch.setattr("roughline.lab.server.process.start_forking", lambda *warm, **named: None)
    monkeypatch.setattr(
        "roughline.lab.server.serve.serve",
        lambda site, settings, ready, interrupted: (started.append(settings), ready("http://x/")),
    )
    start(browser=False)
    said = capsys.readouterr().out
    assert "may take 647 MB of memory here, and not the 4000 MB of --max-memory" in said
    assert started[0].max_memory == pytest.approx(0.6467 * GB, rel=1e-3)
    monkeypatch.setattr(budget, "free_memory", lambda: 20 * GB)
    start(browser=False)
    assert "--max-memory" not in capsys.readouterr().out
    assert started[1].max_memory == 4 * GB


def test_all_files_of_all_pages_count(tmp_path):
    disk = Disk(tmp_path, 1000)
    (tmp_path / "page" / "results").mkdir(parents=True)
    (tmp_path / "page" / "results" / "report.pdf").write_bytes(bytes(100))
    (tmp_path / "page" / "body.pickle").write_bytes(bytes(200))
    (tmp_path / "gone").mkdir()
    (tmp_path / "gone" / "left.pickle").write_bytes(bytes(500))
    page = Files(tmp_path / "page", 1000)
    with page.new("coming.npy", 400).path.open("r+b") as coming:  # it counts as the whole
        coming.write(bytes(10))
    disk.look()
    assert disk.room([tmp_path / "page", tmp_path / "other"]) == 1000 - 100 - 200 - 400
    assert 0 < Disk(tmp_path, None).most <= 20 * GB
    with pytest.raises(rl.InputError, match="max_disk is -1"):
        ServerSettings(max_disk=-1)


@pytest.mark.parametrize("where", ["here", "in a process"])
def test_files_beyond_the_room_of_all_are_refused_before_they_come(tmp_path, where):
    async def scenario():
        async with lab.page() as other:
            await fill(other)
            # files of a page that is gone make room for those of others
            assert (await upload(lab, other.token, bytes(1_500_000), "b.npy")).code == 200

    async def fill(other):
        async with lab.page() as page:
            small = await upload(lab, page.token, HEIGHTS, "small.txt")
            assert small.code == 200
            assert (await upload(lab, page.token, bytes(1_500_000), "a.npy")).code == 200
            refused = await upload(lab, other.token, bytes(1_500_000), "b.npy")
            assert refused.code == 507
            assert refused.body.startswith(b"507: The lab has no room for this file now: close")
            assert (await upload(lab, other.token, HEIGHTS, "c.txt")).code == 200
            # what would be kept for the next question is left out where there is no room
            await upload(lab, other.token, bytes(400_000), "d.npy")
            said = {"file": json.loads(small.body)["file"], "unit": "um", "size": "1 mm"}
            await page.ask("measured.look", state=said)
            assert isinstance((await page.answer())[1], dict)
            await page.ask("explore.download", state={"n": "256"}, name="surface.nc")
            assert (await page.answer())[1].startswith("the lab has no room for the files of this")

    if where == "here":
        opened = lab_here(tmp_path, max_disk=2e6, max_upload=1.8e6)
    else:
        opened = running_lab("--max-disk", "2", "--max-upload", "1.8", temporary=tmp_path)
    with opened as lab:
        run(scenario)


@pytest.fixture
def small_disk(tmp_path):
    """A file system of 8 MB."""
    mount = subprocess.run(
        ["mount", "-t", "tmpfs", "-o", "size=8m", "tmpfs", str(tmp_path)],
        capture_output=True,
        check=False,
    )
    if mount.returncode:
        pytest.skip("only root may mount a small file system")
    try:
        yield tmp_path
    finally:
        subprocess.run(["umount", "--lazy", str(tmp_path)], check=False)


@pytest.mark.parametrize("where", ["here", "in a process"])
def test_a_full_disk_is_one_sentence_without_names(small_disk, where):
    async def scenario():
        async with lab.page() as page:
            await page.ask("explore.download", state={"n": "64"}, name="surface.nc")
            assert (await page.answer())[1]["file"] == "surface.nc"
            file = json.loads((await upload(lab, page.token, HEIGHTS, "m.txt")).body)["file"]
            with suppress(OSError), (small_disk / "others").open("wb", buffering=0) as others:
                while others.write(bytes(2**16)):
                    pass
            refused = await upload(lab, page.token, bytes(100_000), "late.npy")
            assert (refused.code, refused.body[:34]) == (507, b"507: The lab has no room for this ")
            for name in ("surface.nc", "curve.nc", "contact.png"):
                await page.ask("explore.download", state={"n": "64", "seed": "5"}, name=name)
                sentence = (await page.answer())[1]
                assert sentence.startswith("the lab has no room for the files of this now: close")
            await page.ask("measured.look", state={"file": file, "unit": "um", "size": "1 mm"})
            assert isinstance((await page.answer())[1], dict)
            (small_disk / "others").unlink()
            assert (await upload(lab, page.token, bytes(100_000), "late.npy")).code == 200

    if where == "here":
        opened = lab_here(small_disk, max_disk=1e9)
    else:
        opened = running_lab("--max-disk", "1000", temporary=small_disk)
    with opened as lab:
        run(scenario)
