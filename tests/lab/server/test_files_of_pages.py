"""Files that pages bring to the lab, and that it makes for them."""

import asyncio
import json
import re
import sys
from pathlib import Path

import pytest

from lab.server.serving import assert_tells_nothing, becomes, upload
from reference import patience
from roughline.lab.server.files import Files

pytestmark = pytest.mark.skipif(sys.platform == "win32", reason="signals of Unix")


async def test_uploads_lie_under_random_names_and_are_gone_when_the_page_says_so(here):
    async with here.page() as page:
        name = "<b>n\u00e4me</b>\n../../\x00 100%25.TXT"
        answer = await upload(here, page.token, b"1 2\n3 4\n", name)
        assert answer.code == 200
        said = json.loads(answer.body)
        assert "<" not in said["name"]
        assert "/" not in said["name"]
        assert said["name"].isprintable()
        (file,) = (here.folder / page.token).iterdir()
        assert file.read_bytes() == b"1 2\n3 4\n"
        assert re.fullmatch(r"[0-9a-f]{16}\.txt", file.name)
        assert file.parent.stat().st_mode & 0o077 == 0
        kept = 'it\'s #1, a & b "c" $x$ µ; `d`.txt'
        assert json.loads((await upload(here, page.token, b"1", kept)).body)["name"] == kept
        long = await upload(here, page.token, b"1", "n" * 5000)
        assert len(json.loads(long.body)["name"]) == 100
        folder = here.folder / page.token
        await page.forget()
        await becomes(lambda: not list(here.folder.glob(f"{page.token}*")))
        again = await upload(here, page.token, b"1 2\n3 4\n", name)
        assert json.loads(again.body)["digest"] == said["digest"] != ""
        await page.forget()
        await becomes(lambda: not folder.exists())
    assert (await upload(here, page.token, b"1", "late")).code == 404


async def test_uploads_that_are_too_large_or_of_nobody_are_refused(here):
    async with here.page() as page:
        assert (await upload(here, "nobody", b"1", "a")).code == 404
        assert (await upload(here, page.token, b"1", "a", origin="http://evil.example")).code == 403
        too_large = b" 413 ", b"larger than 1 MB"
        for header, content, refusal in (
            ("Content-Length: 1000001", b"x", too_large),
            (f"Content-Length: {'9' * 5000}", b"x", too_large),  # more than Python converts
            ("Transfer-Encoding: chunked", b"2\r\nab\r\n0\r\n\r\n", (b" 411 ",)),
        ):
            line = f"POST /upload?session={page.token}&name=a"
            reader, writer = await here.connected(line, header)
            writer.write(content)
            said = await asyncio.wait_for(reader.read(2000), patience())
            writer.close()
            assert_tells_nothing(said)
            assert all(each in said for each in refusal)
        folder = here.folder / page.token
        assert not folder.exists() or not list(folder.iterdir())


async def test_an_upload_that_is_broken_off_is_deleted(here):
    async with here.page() as page:
        line = f"POST /upload?session={page.token}&name=a"
        _, writer = await here.connected(line, "Content-Length: 900000")
        writer.write(b"x" * 300_000)
        folder = here.folder / page.token
        await becomes(lambda: folder.exists() and any(folder.iterdir()))
        writer.transport.abort()
        await becomes(lambda: not any(folder.iterdir()))


async def test_files_of_one_page_are_bounded(here):
    async with here.page() as page:
        sent = (upload(here, page.token, bytes(900_000), f"{i}") for i in range(8))
        codes = [answer.code for answer in await asyncio.gather(*sent)]
        assert set(codes) <= {200, 410}
        found = list((here.folder / page.token).iterdir())
        assert len(found) <= 3
        assert sum(file.stat().st_size for file in found) <= 3_000_000


async def test_results_are_given_to_their_page_under_a_policy_of_their_own(here):
    async with here.page() as page, here.page() as other:
        results = here.folder / page.token / "results"
        results.mkdir(parents=True)
        (results / "report.html").write_text("<script>alert(1)</script>")
        (results / "large.nc").write_bytes(bytes(5_000_000))
        (results / "link.txt").symlink_to("/etc/hostname")
        answer = await here.fetch(f"/results/{page.token}/report.html")
        assert answer.code == 200
        policy = answer.headers["Content-Security-Policy"]
        assert "default-src 'none'" in policy
        assert "script" not in policy
        assert policy.endswith("sandbox")
        saved = await here.fetch(f"/results/{page.token}/large.nc?save=1")
        assert len(saved.body) == 5_000_000
        assert saved.headers["Content-Disposition"] == 'attachment; filename="large.nc"'
        for token, name in (
            (other.token, "report.html"),
            ("x", "report.html"),
            (page.token, ".."),
            (page.token, "."),
            (page.token, "link.txt"),
            (page.token, "%2e%2e"),
            (page.token, "..%2f..%2fserver"),
            (page.token, "a" * 5000),
        ):
            assert (await here.fetch(f"/results/{token}/{name}")).code == 404, name
    assert here.log.read_text() == ""


def test_a_file_that_is_read_on_windows_is_forgotten_and_goes_with_the_page(tmp_path, monkeypatch):
    """There a file that is open cannot be deleted."""

    def refuses(path, **options):
        raise PermissionError(13, "used by another process", str(path))

    page = Files(tmp_path / "page")
    upload = page.new("a.txt", 1)
    upload.path.write_text("1")
    monkeypatch.setattr(Path, "unlink", refuses)
    page.forget(upload.key)
    assert not page.uploads
    assert upload.path.parent == page.folder
