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
from roughline import campaign
from roughline.paper import plan as plans
from roughline.paper.gallery import gallery_in
from small_campaign import hear_interrupts, tree


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


def test_an_interrupt_keeps_what_is_done(tmp_path, invoke, only_drawn, monkeypatch):
    """Ctrl-C in the middle: exit code 130, no traceback, and the next call ends the work."""
    process = subprocess.Popen(
        [sys.executable, "-c", IN_SMALL, "paper", "--out", str(tmp_path / "out")],
        stderr=subprocess.PIPE,
        text=True,
        start_new_session=True,
        preexec_fn=hear_interrupts,
    )
    store = tmp_path / "out" / "results.zarr" / plans.ENSEMBLE_FULL / "case_status" / "c"
    deadline = time.monotonic() + 60
    while not any(store.rglob("*")) and time.monotonic() < deadline:
        time.sleep(0.05)
    os.killpg(process.pid, signal.SIGINT)
    _, errors = process.communicate(timeout=60)
    assert process.returncode == 130
    assert "what is done is kept" in errors
    assert "Traceback" not in errors
    assert sum(1 for path in store.rglob("*") if path.is_file()) >= 1
    only_drawn()
    monkeypatch.setattr(plans, "paper_plan", in_small)
    code, _, errors = invoke("paper", "--out", tmp_path / "out")
    assert code == 0, errors
    assert (tmp_path / "out" / "report.html").exists()


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
    plan = paper_plan(scale, seed)
    sizes = {"lines": (2**13, 10), "lines-of-surfaces": (2**13, 10), "surfaces": (64, 8)}
    ensembles = tuple(
        replace(
            each,
            fractal_dimensions=each.fractal_dimensions[::2],
            n=sizes[each.name][0],
            realisations=sizes[each.name][1],
            cutoff_ratio=None,
        )
        for each in plan.ensembles
    )
    return replace(plan, ensembles=ensembles)
