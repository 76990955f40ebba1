"""The table of formats knows who reads what."""

from SurfaceTopography.IO import readers

from roughline.topography.files.formats import FORMATS
from roughline.topography.files.instrument import _READ_HERE


def test_each_format_stands_once_and_is_that_of_a_reader():
    names = [each.name for each in FORMATS]
    assert len(names) == len(set(names))
    known = {reader.format() for reader in readers}
    assert {each.reader for each in FORMATS if each.reader} <= known - set(_READ_HERE)
    assert {each.name.lower() for each in FORMATS if not each.reader} >= set(_READ_HERE)
    assert all(suffix.startswith(".") for each in FORMATS for suffix in each.suffixes)
