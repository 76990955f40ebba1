"""Surfaces and lines, their trend, missing points and preparation; two bodies as one."""
