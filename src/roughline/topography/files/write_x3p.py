"""Surfaces in the X3P files of ISO 5436-2, which the programs of instruments read."""

from __future__ import annotations

import hashlib
import zipfile
from pathlib import Path

from roughline.topography.body import Surface
from roughline.topography.files.in_metres import heights_in_metres, sides_in_metres

_MAIN = """\
<?xml version="1.0" encoding="UTF-8"?>
<p:ISO5436_2 xmlns:p="http://www.opengps.eu/2008/ISO5436_2" \
xmlns:xsi="http://www.w3.org/2001/XMLSchema-instance" \
xsi:schemaLocation="http://www.opengps.eu/2008/ISO5436_2 \
http://www.opengps.eu/2008/ISO5436_2/ISO5436_2.xsd">
  <Record1>
    <Revision>ISO5436 - 2000</Revision>
    <FeatureType>SUR</FeatureType>
    <Axes>
      <CX>
        <AxisType>I</AxisType>
        <DataType>D</DataType>
        <Increment>{dx!r}</Increment>
        <Offset>0</Offset>
      </CX>
      <CY>
        <AxisType>I</AxisType>
        <DataType>D</DataType>
        <Increment>{dy!r}</Increment>
        <Offset>0</Offset>
      </CY>
      <CZ>
        <AxisType>A</AxisType>
        <DataType>D</DataType>
        <Increment>1</Increment>
        <Offset>0</Offset>
      </CZ>
    </Axes>
  </Record1>
  <Record3>
    <MatrixDimension>
      <SizeX>{nx}</SizeX>
      <SizeY>{ny}</SizeY>
      <SizeZ>1</SizeZ>
    </MatrixDimension>
    <DataLink>
      <PointDataLink>bindata/data.bin</PointDataLink>
      <MD5ChecksumPointData>{checksum}</MD5ChecksumPointData>
    </DataLink>
  </Record3>
  <Record4>
    <ChecksumFile>md5checksum.hex</ChecksumFile>
  </Record4>
</p:ISO5436_2>
"""
_NO_DATE = (
    1980,
    1,
    1,
    0,
    0,
    0,
)  # the first that an archive can state, so that bytes depend on none


def write_x3p(surface: Surface, path: Path) -> None:
    """Write the heights in double precision and the steps of the grid, in metres.

    Heights are stored row by row, x fastest. Record 2, the instrument and its date, may be absent
    and is: nothing was measured here.
    """
    (nx, ny), (lx, ly) = surface.shape, sides_in_metres(surface)
    heights = heights_in_metres(surface).T.astype("<f8").tobytes()
    main = _MAIN.format(dx=lx / nx, dy=ly / ny, nx=nx, ny=ny, checksum=_md5(heights).upper())
    parts = {
        "main.xml": main.encode(),
        "bindata/data.bin": heights,
        "md5checksum.hex": f"{_md5(main.encode())} *main.xml\n".encode(),
    }
    with zipfile.ZipFile(path, "w", zipfile.ZIP_DEFLATED) as archive:
        for name, content in parts.items():
            part = zipfile.ZipInfo(name, _NO_DATE)
            part.compress_type = zipfile.ZIP_DEFLATED
            archive.writestr(part, content)


def _md5(content: bytes) -> str:
    return hashlib.md5(content, usedforsecurity=False).hexdigest()
