"""The fluid between two bodies: what the gap lets through."""
