"""All causes that leave answers open."""

from __future__ import annotations

from roughline.margins.cause import Causes
from roughline.margins.filling import FilledPoints
from roughline.margins.grid import FinerGrid
from roughline.margins.hardness import HardnessScatter
from roughline.margins.place import OtherPlaces
from roughline.margins.steps import StepsOfShear

HARDNESS = HardnessScatter()

causes = Causes([FinerGrid(), FilledPoints(), OtherPlaces(), StepsOfShear(), HARDNESS])
"""Those of every question; ``add`` adds one's own."""
