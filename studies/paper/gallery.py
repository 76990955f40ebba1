"""Press the bodies of the paper's Figures 1 and 2 on its own grid, and keep what they show.

    python -m studies.paper.gallery

writes ``data/gallery.nc`` beside this file: topography and deflection on every sixteenth
point, and the share of each block of four by four cells that is in contact.
"""

import numpy as np
import xarray

from roughline._version import __version__
from roughline.campaign.export import write_netcdf
from roughline.paper.gallery import Gallery
from roughline.paper.plan import paper_plan
from studies.paper.data import FOLDER

_EVERY, _BLOCK = 16, 4


def main() -> None:
    """Press them all."""
    gallery = Gallery.of(paper_plan("full"))
    bodies = [gallery.bodies(each) for each in gallery.fractal_dimensions]
    places = ("fractal_dimension", "x", "y")
    blocks = ("fractal_dimension", "x_block", "y_block")
    shares = [_shares(body["contact"]) for body in bodies]
    variables = {
        "heights": (places, _single([body["heights"][::_EVERY, ::_EVERY] for body in bodies])),
        "displacement": (
            places,
            _single([body["displacement"][::_EVERY, ::_EVERY] for body in bodies]),
        ),
        # readers multiply the numbers of cells to shares
        "contact": (blocks, np.array(shares), {"scale_factor": 1 / _BLOCK**2}),
        "line_heights": (
            ("fractal_dimension", "s"),
            _single([body["line_heights"] for body in bodies]),
        ),
        "line_depth": ("fractal_dimension", np.array([body["line_depth"] for body in bodies])),
    }
    coordinates = {"fractal_dimension": np.array(gallery.fractal_dimensions)}
    attributes = {
        "n": gallery.n,
        "force_bar": gallery.force_bar,
        "seed": gallery.seed,
        "roughline_version": __version__,
        "contact": f"share of each block of {_BLOCK} x {_BLOCK} cells",
    }
    write_netcdf(xarray.Dataset(variables, coordinates, attributes), FOLDER / "gallery.nc")


def _shares(contact: np.ndarray) -> np.ndarray:
    """Count the cells in contact of each block."""
    side = contact.shape[0] // _BLOCK
    return contact.reshape(side, _BLOCK, side, _BLOCK).sum(axis=(1, 3)).astype(np.uint8)


def _single(values: list[np.ndarray]) -> np.ndarray:
    return np.array(values, dtype=np.float32)


if __name__ == "__main__":
    main()
