"""The study of the real contact area, with the shortest wave resolved."""
