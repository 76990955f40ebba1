"""Explore: generated surfaces under both models, as sliders move."""
