"""roughline: the contact laboratory for rough surfaces.

The names in ``__init__.pyi`` load on first use, so that ``import roughline`` costs next to nothing.
"""

from importlib import import_module

from roughline.computing.notebook import filled_by

_LINES = __loader__.get_data(f"{__path__[0]}/__init__.pyi").decode().splitlines()
_WORDS = [line.split() for line in _LINES if line.startswith("from ")]
_HOMES = {name: home for _, home, _, name, *_ in _WORDS}

__all__ = [name for name in _HOMES if name != "plot"]  # which ``import *`` would load

filled_by(lambda: import_module("roughline.report.notebook"))
filled_by(lambda: import_module("roughline.plot.notebook"))


def __getattr__(name):
    if name not in _HOMES:
        from roughline.errors import InputError
        from roughline.errors.earlier import EARLIER

        if f"rl.{name}" in EARLIER:
            raise InputError(f"there is no rl.{name} any more; write {EARLIER[f'rl.{name}']}")
        raise AttributeError(f"module 'roughline' has no attribute {name!r}")
    if name == "plot":
        return import_module("roughline.plot")
    value = globals()[name] = getattr(import_module(_HOMES[name]), name)
    return value


def __dir__():
    return sorted(_HOMES)
