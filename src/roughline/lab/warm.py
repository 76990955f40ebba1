"""Load and compile what tasks need, once, before processes are forked from this one."""

from __future__ import annotations

import gc
from functools import cache


@cache
def up() -> None:
    """Do small tasks of the view "Explore" with one thread: they load and compile everything.

    The transforms are left without threads of their own: each fork would wait until these have
    ended, and now and then for ever.
    """
    import ducc0

    import roughline as rl
    from roughline.lab.explore import pictures

    rl.set_threads(1)  # many sessions share the cores
    for special in (
        *({}, {"boundary": "periodic"}),
        *({"hardness_bar": "0.5"}, {"fluid": "x"}, {"w": "1"}, {"t": "0.05"}, {"mu": "0.3"}),
    ):
        arguments = {"state": {"n": "64", **special}, "session": {}}
        for task in (pictures.coarse, pictures.full):
            task(arguments, lambda done, total: None)
    ducc0.misc.resize_thread_pool(1)
    gc.freeze()  # what is loaded stays shared with the processes that are forked


up()
