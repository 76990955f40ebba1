"""Analytical theories of rough contact, to be compared with the full model."""
