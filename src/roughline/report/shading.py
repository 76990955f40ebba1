"""A topography as an image, lit from the upper left."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

if TYPE_CHECKING:
    from roughline.topography.body import Surface

_LIGHT_DIRECTION = (315.0, 45.0)  # direction and height of the light [degree]
_RELIEF_SLOPE = 0.35  # rms, to which a surface is scaled for the light, so that smooth ones show


def shaded(surface: Surface) -> NDArray[np.uint32]:
    """Return red, green, blue and opacity of every point in one number, as BokehJS reads them.

    Colours are heights, as in the reports; the light shows slopes. Shape (nx, ny), as the heights.
    """
    from matplotlib import colormaps  # here because it loads slowly
    from matplotlib.colors import LightSource

    slope = surface.rms_slope
    light: Any = LightSource(*_LIGHT_DIRECTION)
    colours = light.shade(
        surface.heights.T,  # rows run along x, from the top downwards
        colormaps["cividis"],
        blend_mode="soft",
        vert_exag=_RELIEF_SLOPE / slope if slope else 1.0,
        dx=surface.spacing[0],
        dy=surface.spacing[1],
    )
    return (255 * colours).astype(np.uint8).view(np.uint32)[..., 0].T
