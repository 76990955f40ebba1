"""The paper: its figures from the published study, with windows and averages to choose."""
