"""Analytical theories of rough contact, to lie beside the full model."""
