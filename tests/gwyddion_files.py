"""Files of GWY, written as Gwyddion writes them."""

import struct

import numpy as np

CODES = {float: "d", int: "i", str: "s"}


def component(name, value):
    """A component as Gwyddion writes it."""
    if isinstance(value, tuple):
        return name.encode() + b"\0o" + obj(*value)
    if isinstance(value, np.ndarray):
        return name.encode() + b"\0D" + struct.pack("<I", value.size) + value.T.tobytes("C")
    packed = (
        value.encode() + b"\0"
        if isinstance(value, str)
        else struct.pack("<" + CODES[type(value)], value)
    )
    return name.encode() + b"\0" + CODES[type(value)].encode() + packed


def obj(name, components):
    """An object with its components."""
    inside = b"".join(component(*each) for each in components.items())
    return name.encode() + b"\0" + struct.pack("<I", len(inside)) + inside


def field(heights, xy="m", z="m", sides=(2.4e-6, 4e-6), **others):
    """A channel or a mask; a unit that is None is left out."""
    stated = {"xres": heights.shape[0], "yres": heights.shape[1]}
    stated |= {"xreal": sides[0], "yreal": sides[1], "data": heights}
    for key, unit in (("si_unit_xy", xy), ("si_unit_z", z)):
        if unit is not None:
            stated[key] = ("GwySIUnit", {"unitstr": unit})
    return ("GwyDataField", stated | others)


def gwy(**components):
    """The bytes of a file, of components whose names have _ for each slash."""
    named = {"/" + name.replace("_", "/"): each for name, each in components.items()}
    return b"GWYP" + obj("GwyContainer", named)
