"""Explore as a page asks it, without a page: of a small surface, which the library presses too."""

import re

import numpy as np

import roughline as rl
from lab.unpacked import unpacked
from roughline.lab.explore import downloads
from roughline.lab.explore.reading import read_state

LENGTH, E_STAR, HEIGHT = 1e-3, 110e9, 1e-6
SCALE = E_STAR * HEIGHT * LENGTH
SMALL = {"n": "64", "D_f": "2.4", "seed": "3", "F": "0.2", "cutoff": "0.0625"}
YIELDING = {**SMALL, "hardness_bar": "0.3"}
HARDNESS = 0.3 * E_STAR * read_state(SMALL).surface(64).rms_slope
COATED = {**SMALL, "t": "0.05", "E_l": "0.2", "nu_l": "0.45"}
LAYERED = rl.Layered(
    young=0.2 * E_STAR * (1 - 0.45**2),
    poisson=0.45,
    thickness=0.05 * LENGTH,
    base_young=E_STAR * (1 - 0.3**2),
    base_poisson=0.3,
)
SHEARED = {**SMALL, "mu": "0.3", "Q": "0.15"}
STICKS = {"n": "64", "D_f": "2.2", "seed": "7", "F": "0.08", "w": "1", "h0": "0.5"}
LAW = rl.Dugdale(work_of_adhesion=E_STAR * HEIGHT**2 / LENGTH, range=0.5 * HEIGHT)


def arguments(state, folder=None, **others):
    session = {"folder": str(folder), "names": {}}
    return {"state": state, "session": session, **others}


def answer(task, state, **others):
    return unpacked(task(arguments(state, **others), lambda done, total: None))


def loads(header, panel, *names):
    """Return forces and values of a panel, of some series, by rising force."""
    found = [header["panels"][panel]["series"][name] for name in names or ("curve", "unsure")]
    columns = [np.concatenate([each[axis] for each in found]) for axis in ("x", "y")]
    order = np.argsort(columns[0])
    return columns[0][order], columns[1][order]


def said(header):
    """Return what stands in the answer strip, by key."""
    return {item["key"]: item for item in header["strip"]}


def numbers_in(text):
    """Return the numbers of a text."""
    return [float(each) for each in re.findall(r"-?\d+\.?\d*", text)]


def saved(name, state, tmp_path, **others):
    """Save a file as the page does, and return where it is."""
    header, _ = answer(downloads.download, state, folder=tmp_path, name=name, **others)
    return tmp_path / "results" / header["file"]
