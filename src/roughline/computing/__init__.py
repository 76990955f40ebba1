"""Transforms, compiled loops, memory: what every computation rests on."""
