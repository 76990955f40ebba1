"""Single bodies of both models, as in the paper's Figures 1 and 2, kept in the store of a study."""

from __future__ import annotations

import json
from dataclasses import asdict, dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from roughline._version import __version__
from roughline.campaign.layout import codecs
from roughline.campaign.plan import Plan
from roughline.campaign.store import Store, damaged_or_foreign, opened, read_or_none
from roughline.campaign.writer import gather_metadata, locked
from roughline.contact.press import press
from roughline.errors import StoreError
from roughline.paper.plan import ENSEMBLE_FULL
from roughline.spectra.self_affine import SelfAffine

if TYPE_CHECKING:
    import xarray

_GROUP_NAME = "gallery"
_DONE_MARK = "gallery_done"  # attribute of the root
_DIMENSIONS = {
    "heights": ("fractal_dimension", "x", "y"),
    "contact": ("fractal_dimension", "x", "y"),
    "displacement": ("fractal_dimension", "x", "y"),
    "line_heights": ("fractal_dimension", "s"),
    "line_depth": ("fractal_dimension",),
}


@dataclass(frozen=True)
class Gallery:
    """A surface and a line of each fractal dimension; the surfaces share their phases."""

    fractal_dimensions: tuple[float, ...]
    n: int  # points along a side of the surfaces
    seed: int
    n_line: int = 2**12
    force_bar: float = 0.3  # on each body

    @classmethod
    def of(cls, plan: Plan, fractal_dimensions: tuple[float, ...] | None = None) -> Gallery:
        """Return the bodies for the paper's plan: those of the paper, or up to four of others."""
        surfaces = plan.ensemble(ENSEMBLE_FULL)
        rising = sorted(fractal_dimensions or (2.0, 7 / 3, 8 / 3, 3.0))
        places = {round(i * (len(rising) - 1) / 3) for i in range(4)}
        chosen = tuple(rising[place] for place in sorted(places))
        return cls(chosen, surfaces.n, surfaces.seed)

    def bodies(self, fractal_dimension: float) -> dict[str, NDArray[Any]]:
        """Press the surface and the line of one fractal dimension.

        Arrays are over h: heights, contact and displacement of shape (n, n), line_heights,
        line_depth.
        """
        spectrum = SelfAffine(fractal_dimension=fractal_dimension, rms_height=1.0)
        surface = spectrum.surface(self.n, self.seed)
        line = spectrum.line(self.n_line, self.seed)
        fields = press(surface, E_star=1.0, forces=[self.force_bar], fields=True).fields[0]
        assert fields is not None
        return {
            "heights": surface.heights,
            "contact": fields.contact,
            "displacement": fields.displacement,
            "line_heights": line.heights,
            "line_depth": press(line, E_star=1.0, forces=[self.force_bar]).depth[0],
        }

    def draw(self, path: Path) -> None:
        """Press the bodies that a store lacks, and keep them there."""
        with locked(path):
            root = opened(path, "r+")
            if root.attrs.get(_DONE_MARK, False):
                if self._is_complete_in(root, path):
                    return
                root.attrs[_DONE_MARK] = False
            bodies = [self.bodies(dimension) for dimension in self.fractal_dimensions]
            values = {name: np.array([body[name] for body in bodies]) for name in _DIMENSIONS}
            group = root.require_group(_GROUP_NAME)
            group.attrs.update(self._settings())
            for name, data in {**values, "fractal_dimension": self.fractal_dimensions}.items():
                group.create_array(
                    name,
                    data=np.array(data),
                    dimension_names=_DIMENSIONS.get(name, ("fractal_dimension",)),
                    overwrite=True,
                    **codecs(),
                )
            root.attrs[_DONE_MARK] = True
            gather_metadata(path)

    def _is_complete_in(self, root: Any, path: Path) -> bool:
        """Whether all of these bodies are in a store and can be read.

        Where there are others, these are drawn instead, as a study grows by fractal dimensions.
        """
        try:
            group, wanted = root[_GROUP_NAME], json.loads(json.dumps(self._settings()))
            differ = [key for key in wanted if group.attrs.get(key) != wanted[key]]
            if differ and differ != ["fractal_dimensions"]:
                raise StoreError(
                    f"{path} holds a gallery with other settings; choose another folder"
                )
            return not differ and all(read_or_none(group[x]) is not None for x in _DIMENSIONS)
        except (ValueError, KeyError, TypeError) as error:
            raise damaged_or_foreign(path) from error

    def _settings(self) -> dict[str, Any]:
        return asdict(self) | {"roughline_version": __version__}


def gallery_in(store: Store) -> xarray.Dataset | None:
    """Return the bodies that a store keeps, over fractal_dimension, x and y, or s."""
    import xarray  # here because it loads slowly

    if not opened(store.path, "r").attrs.get(_DONE_MARK, False):
        return None
    data = xarray.open_zarr(store.path, group=_GROUP_NAME, consolidated=False, chunks=None).load()
    return data[sorted(map(str, data))]  # Zarr lists them in another order every time
