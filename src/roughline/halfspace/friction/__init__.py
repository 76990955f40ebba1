"""Friction with history: stick, slip, and what a path of loads leaves."""
