"""Histories of load of small bodies that yield, on dense matrices."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from halfspace.dense_contact import Body, DenseContact

_AT_HARDNESS = 1e-9  # a node so near, over H, bears H: after reloading it does to rounding


@dataclass(frozen=True)
class State:
    """What one load leaves; fields are flat."""

    depth: float
    force: float
    pressure: np.ndarray
    displacement: np.ndarray
    contact: np.ndarray
    plastic: np.ndarray
    indentation: np.ndarray
    stiffness: float
    unloading_stiffness: float
    work: float
    dissipated_work: float


class History:
    """Loads one after another; each starts from the surface that the last one left.

    The hardness is one for all nodes, or an array over them.
    """

    def __init__(self, body: Body, hardness: float | np.ndarray):
        self.body, self.hardness = body, hardness
        self._dense = DenseContact(body)
        self.K = self._dense.K
        self.separation = body.separation
        self.indentation = np.zeros(self.separation.size)

    def press(self, force: float) -> State:
        """Solve the contact under a force, and keep its indentations."""
        before = self.separation + self.indentation
        if force > 0:
            depth, pressure = self._dense.under_force(before, force, 0.0, self.hardness)
        else:
            depth, pressure = float(before.min()), np.zeros(before.size)
        displacement = self.K @ pressure
        plastic = pressure >= (1 - _AT_HARDNESS) * self.hardness
        overlap = np.maximum(depth - displacement - before, 0.0)
        self.indentation = self.indentation + np.where(plastic, overlap, 0.0)
        contact = pressure > 0
        cell = self.body.cell
        dissipated = cell * float((self.hardness * self.indentation).sum())
        return State(
            depth=depth,
            force=cell * float(pressure.sum()),
            pressure=pressure,
            displacement=displacement,
            contact=contact,
            plastic=plastic,
            indentation=self.indentation,
            stiffness=self._dense.stiffness(contact & ~plastic),
            unloading_stiffness=self._dense.stiffness(contact),
            work=dissipated + cell * float(pressure @ displacement) / 2,
            dissipated_work=dissipated,
        )
