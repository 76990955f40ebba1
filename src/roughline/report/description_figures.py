"""A description in files: the heights as the file has them, the roughness, the prepared body."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING

from roughline.plot.style import save, styled
from roughline.report.contact_figures import roughness_figure
from roughline.report.folder import make_folder
from roughline.report.measured_figures import measured_figure
from roughline.topography.files.netcdf import write

if TYPE_CHECKING:
    from roughline.assessment.description import Description


def write_description(description: Description, out: Path) -> list[Path]:
    """Write figures of the file and of the roughness, and the prepared body.

    Parameters
    ----------
    description : Description
        Of a topography.
    out : Path
        Folder; made if it does not exist.

    Raises
    ------
    StoreError
        If the folder cannot be written.
    """
    make_folder(out)
    body, parameters = description.body, description.roughness
    files: list[Path] = []
    with styled():
        if description.missing.count or description.obstacles:
            figure = measured_figure(description.piece, description.missing)
            files += save(figure, out, "file")
        if body is not None and parameters is not None:
            files += save(roughness_figure(body, parameters), out, "roughness")
    if body is not None:
        write(body, out / "prepared.nc")
        files.append(out / "prepared.nc")
    return files
