"""Exact solutions, the judges of both models; nothing of ours is imported here."""
