"""Ctrl-C while a surface is pressed: the loads that were solved stay."""

import pickle

import numpy as np
import pytest

import roughline as rl

SURFACE = rl.SelfAffine(hurst=0.8, rms_height=1.0).surface(32, 7)
FORCES = [0.01, 0.03, 0.1, 0.3]


def stop_after(loads):
    """A progress callback during which Ctrl-C comes."""

    def progress(done, total):
        if done == loads:
            raise KeyboardInterrupt

    return progress


def pressed(**more):
    return rl.press(SURFACE, E_star=1.0, forces=FORCES, fields=True, **more)


@pytest.mark.parametrize("throw", [True, False])
def test_solved_loads_are_kept(throw):
    with pytest.raises(KeyboardInterrupt, match="2 of 4 loads were solved") as caught:
        pressed(progress=stop_after(2), throw=throw)
    assert isinstance(caught.value, rl.Interrupted)
    curve, whole = caught.value.curve, pressed()
    for name in ("depth", "force", "stiffness", "area_fraction", "residual"):
        assert getattr(curve, name)[:2].tolist() == getattr(whole, name)[:2].tolist()
        assert np.isnan(getattr(curve, name)[2:]).all()
    assert curve.status.tolist() == [0, 0, rl.Status.INTERRUPTED, rl.Status.INTERRUPTED]
    assert not curve.resolved[2:].any()
    assert curve.fields[1] is not None
    assert curve.fields[2:] == (None, None)


@pytest.mark.parametrize("step", ["overstated_cells", "share_at_border"])
def test_an_interruption_inside_a_load_loses_that_load_alone(step, monkeypatch):
    """Whether its contact is looked at when it comes, or its numbers are written already."""
    from roughline.contact import full

    calls = []

    def stopping(*arguments):
        calls.append(arguments)
        if len(calls) == 3:
            raise KeyboardInterrupt
        return original(*arguments)

    original = getattr(full, step)
    monkeypatch.setattr(full, step, stopping)
    with pytest.raises(rl.Interrupted) as caught:
        pressed(measures=[rl.MEAN_GAP])
    curve = caught.value.curve
    assert curve.converged.tolist() == [True, True, False, False]
    for numbers in (curve.force, curve.work, curve.residual, curve.measured["mean_gap"].values):
        assert np.isnan(numbers).tolist() == [False, False, True, True]
    assert curve.fields[2:] == (None, None)
    assert curve.residual_of[1] != ""
    assert curve.residual_of[2:] == ("", "")


def test_after_the_last_load_ctrl_c_is_still_heard():
    with pytest.raises(rl.Interrupted) as caught:
        pressed(progress=stop_after(4))
    assert caught.value.curve.converged.all()


def test_while_the_grid_error_is_estimated_the_curve_is_kept(monkeypatch):
    def stopped(*_):
        raise KeyboardInterrupt

    monkeypatch.setattr("roughline.contact.press.with_grid_error", stopped)
    with pytest.raises(rl.Interrupted) as caught:
        pressed(grid_error=True)
    assert caught.value.curve.converged.all()
    assert caught.value.curve.stiffness_error is None


def test_an_interrupted_curve_can_be_written(tmp_path):
    with pytest.raises(rl.Interrupted) as caught:
        pressed(progress=stop_after(1))
    caught.value.curve.write(tmp_path / "curve.nc")
    travelled = pickle.loads(pickle.dumps(caught.value))  # between processes
    assert travelled.curve.status.tolist() == caught.value.curve.status.tolist()
    data = caught.value.curve.to_dataset()
    assert "interrupted" in data.status.attrs["flag_meanings"]
    assert np.isnan(data.pressure.values[1:]).all()
