"""Tests of the lab, a package because a benchmark has the same name."""
