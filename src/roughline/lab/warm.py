"""Load and compile what tasks need, once, before processes are forked from this one."""

from __future__ import annotations

from functools import cache


@cache
def up() -> None:
    """Press a small surface and a line with one thread, and load what pictures need."""
    import roughline as rl

    rl.set_threads(1)  # many sessions share the cores
    spectrum = rl.SelfAffine(hurst=0.8, rms_height=1.0)
    for periodic in (False, True):
        rl.press(
            spectrum.surface(32, 0), E_star=1.0, forces=[0.1, 0.2], periodic=periodic, fields=True
        )
    rl.press(spectrum.line(64, 0), E_star=1.0, forces=[0.1])


up()
