"""What leaves answers open: a file for each cause, and how they add up."""
