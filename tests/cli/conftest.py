"""What tests of commands share."""

import pytest


@pytest.fixture
def few_loads(monkeypatch):
    """Let the curve of a report have few loads, each of which takes as long as the others."""
    monkeypatch.setattr("roughline.assessment.loads._CURVE_LOADS", 3)
