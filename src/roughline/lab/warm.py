"""Load and compile what tasks need, once, before processes are forked from this one."""

from __future__ import annotations

from functools import cache
from importlib import import_module

_LOADED = ("explore.pictures", "explore.code", "shading")  # of what is asked while a slider moves


@cache
def up() -> None:
    """Press a small surface and a line with one thread, and load what pictures need."""
    from roughline.computing.fft import set_threads
    from roughline.contact.press import press
    from roughline.spectra.self_affine import SelfAffine

    set_threads(1)  # many sessions share the cores
    spectrum = SelfAffine(hurst=0.8, rms_height=1.0)
    for periodic in (False, True):
        press(
            spectrum.surface(32, 0), E_star=1.0, forces=[0.1, 0.2], periodic=periodic, fields=True
        )
    press(spectrum.line(64, 0), E_star=1.0, forces=[0.1])
    for name in _LOADED:
        import_module(f"roughline.lab.{name}")
    import_module("matplotlib.colors")


up()
