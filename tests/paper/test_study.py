"""The paper's study on its way: its gallery, and an interrupt."""

import os
import shutil
import signal
import subprocess
import sys
import time
from dataclasses import replace
from pathlib import Path

import pytest

import roughline as rl
from reference import patience
from roughline import campaign
from roughline.paper import plan as plans
from roughline.paper.gallery import gallery_in
from small_campaign import hear_interrupts, tree, with_first_results


def test_the_gallery_is_kept_and_drawn_once(finished, small_plan, small_gallery, tmp_path):
    gallery = gallery_in(campaign.Store(finished))
    assert gallery.heights.shape == (2, 24, 24)
    assert gallery.fractal_dimension.values == pytest.approx([2.0, 3.0])
    spectrum = rl.SelfAffine(fractal_dimension=3.0, rms_height=1.0)
    assert (gallery.heights.values[1] == spectrum.surface(24, small_gallery.seed).heights).all()
    before = tree(finished)
    campaign.run(small_plan, finished)
    small_gallery.draw(finished)
    assert tree(finished) == before
    with pytest.raises(rl.StoreError, match="a gallery with other settings"):
        replace(small_gallery, force_bar=0.1).draw(finished)
    # of other fractal dimensions, as a study grows by them, it is drawn again
    shutil.copytree(finished, tmp_path / "grown")
    replace(small_gallery, fractal_dimensions=(2.5,)).draw(tmp_path / "grown")
    drawn = gallery_in(campaign.Store(tmp_path / "grown"))
    assert drawn.heights.shape == (1, 24, 24)
    assert drawn.fractal_dimension.values == pytest.approx([2.5])
    # a damaged one is drawn again
    (tmp_path / "hurt").mkdir()
    chunk = next(path for path in (finished / "gallery" / "contact").rglob("c/**/*"))
    content = {path: path.read_bytes() for path in chunk.parent.rglob("*") if path.is_file()}
    for path in content:
        path.write_bytes(b"")
    small_gallery.draw(finished)
    assert tree(finished) == before


@pytest.fixture(params=["here", "there"])
def interrupted(request, invoke, two_workers, monkeypatch):
    """Interrupt a study at its first surfaces; how it ended, and what its command is given."""

    def here(out):
        """Of some small bodies and few resamples, in this process."""
        request.getfixturevalue("few_resamples")
        own = ("--out", out, "--scheduler", two_workers)
        monkeypatch.setattr(plans, "paper_plan", tiny)
        before = signal.signal(signal.SIGINT, signal.default_int_handler)
        with_first_results(monkeypatch, lambda: signal.raise_signal(signal.SIGINT), "surfaces")
        code, _, errors = invoke("paper", *own)
        signal.signal(signal.SIGINT, before)
        return code, errors, own

    def there(out):
        """In a process of its own, anywhere in a batch."""
        process = subprocess.Popen(
            [sys.executable, "-c", IN_SMALL, "paper", "--out", str(out)],
            stderr=subprocess.PIPE,
            text=True,
            start_new_session=True,
            preexec_fn=hear_interrupts,
        )
        deadline = time.monotonic() + patience()
        while not any(surfaces_in(out)) and time.monotonic() < deadline:
            time.sleep(0.05)
        os.killpg(process.pid, signal.SIGINT)
        _, errors = process.communicate(timeout=patience())
        monkeypatch.setattr(plans, "paper_plan", in_small)
        return process.returncode, errors, ("--out", out)

    return {"here": here, "there": there}[request.param]


def surfaces_in(out):
    """Marks of surfaces that are done."""
    return (out / "results.zarr" / plans.ENSEMBLE_FULL / "case_status" / "c").rglob("*")


def test_an_interrupt_keeps_what_is_done(interrupted, tmp_path, invoke, only_drawn):
    """Ctrl-C in the middle: exit code 130, no traceback, and the next call ends the work."""
    out = tmp_path / "out"
    code, errors, own = interrupted(out)
    assert code == 130
    assert "what is done is kept" in errors
    assert "Traceback" not in errors
    assert any(path.is_file() for path in surfaces_in(out))
    only_drawn()
    code, _, errors = invoke("paper", *own)
    assert code == 0, errors
    assert (out / "report.html").exists()


IN_SMALL = f"""
import sys
sys.path.insert(0, {str(Path(__file__).parents[1])!r})
from paper.test_study import in_small, plans
plans.paper_plan = in_small
from roughline.cli import main
main()
"""
paper_plan = plans.paper_plan


def in_small(scale, seed):
    """The paper's plan on grids so small that it takes some seconds."""
    sizes = {"lines": (2**13, 10), "lines-of-surfaces": (2**13, 10), "surfaces": (64, 8)}
    return cut(paper_plan(scale, seed), sizes, step=2)


def tiny(scale, seed):
    """The paper's plan on grids so small that it takes less than a second."""
    sizes = {"lines": (2**8, 4), "lines-of-surfaces": (2**8, 4), "surfaces": (16, 4)}
    return cut(paper_plan(scale, seed), sizes, step=5)


def cut(plan, sizes, step):
    ensembles = tuple(
        replace(
            each,
            fractal_dimensions=each.fractal_dimensions[::step],
            n=sizes[each.name][0],
            realisations=sizes[each.name][1],
            cutoff_ratio=None,
        )
        for each in plan.ensembles
    )
    return replace(plan, ensembles=ensembles)
