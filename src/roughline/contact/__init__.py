"""Pressing a body: loads, both models, the curve, what the grid leaves open."""
