"""Averages, bootstrap intervals, power laws, verdicts."""
