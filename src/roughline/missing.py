"""Heights that an instrument could not measure: counted, bounded and filled."""

from __future__ import annotations

import warnings
from dataclasses import dataclass
from typing import Any, Literal

import numpy as np
from numpy.typing import NDArray

from roughline.errors import InputError

Filling = Literal["harmonic", "nearest"]


@dataclass(frozen=True)
class Missing:
    """How missing points are filled, and how many are too many.

    Parameters
    ----------
    method : {"harmonic", "nearest"}
        The solution of Laplace's equation between the known heights, or the nearest known height.
    most : float
        Largest share of missing points. [1]

    Raises
    ------
    InputError
        If the method is unknown or the share is none.
    """

    method: Filling = "harmonic"
    most: float = 0.1

    def __post_init__(self) -> None:
        if self.method not in ("harmonic", "nearest"):
            raise InputError(
                f'missing is {self.method!r}; points are filled "harmonic" or "nearest"'
            )
        if not 0 <= self.most < 1:
            raise InputError(f"most_missing is {self.most}; a share from 0 to below 1 is needed")

    @property
    def other(self) -> Filling:
        """The other method, to see what the choice does."""
        return "nearest" if self.method == "harmonic" else "harmonic"

    def completed(
        self, heights: Any, name: str
    ) -> tuple[NDArray[np.float64], dict[str, str | int | float]]:
        """Return the heights with all points known, and how many were not, for the settings.

        Parameters
        ----------
        heights : array or masked array, shape (nx, ny) or (n,)
            Heights; unknown ones are masked or not finite.
        name : str
            Whose they are, for the message.

        Raises
        ------
        InputError
            If more than the largest share is missing.
        """
        unknown = int(np.count_nonzero(np.ma.getmaskarray(heights)))
        if not unknown and not np.isfinite(np.ma.getdata(heights)).all():
            heights = np.ma.masked_invalid(heights, copy=False)
            unknown = int(np.count_nonzero(np.ma.getmaskarray(heights)))
        settings: dict[str, str | int | float] = {}
        if unknown:
            heights = self.filled(heights, name)
            settings = {
                "missing_points": unknown,
                "missing_share": unknown / heights.size,
                "filled": self.method,
            }
        return np.array(heights, dtype=np.float64, copy=None), settings

    def filled(self, heights: np.ma.MaskedArray[Any, Any], name: str) -> NDArray[np.float64]:
        """Return masked heights with all points known; as :meth:`completed`, without the count."""
        mask = np.ma.getmaskarray(heights)
        unknown = int(np.count_nonzero(mask))
        if unknown > self.most * mask.size or unknown == mask.size:
            raise InputError(
                f"{name} has {unknown} missing points of {mask.size} ({unknown / mask.size:.0%}); "
                f"up to {self.most:.0%} are filled: crop it to where points are known, or allow "
                "more (most_missing; command line: --max-missing)"
            )
        if heights.ndim == 1:
            at = np.arange(mask.size)
            return np.interp(at, at[~mask], np.ma.getdata(heights)[~mask])
        return _nearest(heights, mask) if self.method == "nearest" else _harmonic(heights)


class Marking(Missing):
    """Marks missing points instead of filling them, however many they are."""

    def completed(
        self, heights: Any, name: str
    ) -> tuple[NDArray[np.float64], dict[str, str | int | float]]:
        """Return 1 where a height is missing and 0 elsewhere, and how often that is."""
        mask = np.ma.getmaskarray(np.ma.masked_invalid(heights, copy=False))
        return mask.astype(np.float64), {"marked": int(np.count_nonzero(mask))}


def _nearest(heights: Any, mask: NDArray[np.bool_]) -> NDArray[np.float64]:
    from scipy import ndimage

    indices = ndimage.distance_transform_edt(mask, return_distances=False, return_indices=True)
    return np.asarray(np.ma.getdata(heights)[tuple(indices)], dtype=np.float64)


def _harmonic(heights: Any) -> NDArray[np.float64]:
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", ImportWarning)
        from SurfaceTopography import Topography

    surface = Topography(heights, heights.shape)  # sizes do not matter
    return np.asarray(surface.interpolate_undefined_data_with_harmonic_function().heights())
