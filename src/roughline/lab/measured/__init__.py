"""My surface: a file of an instrument, prepared and pressed, and the answers that follow."""
