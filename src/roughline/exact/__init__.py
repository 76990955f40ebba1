"""Exact solutions, to test both models; nothing else of roughline is imported here."""
